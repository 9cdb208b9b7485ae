// The program itself: flags, signals, exit codes, log.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/server/raw_client.h"

namespace subdivd::server::testing {
namespace {

using Clock = std::chrono::steady_clock;
const std::string kProgram = std::string(SUBDIVD_BINARY_DIR) + "/subdivd";

// Standard output comes through a pipe, standard error goes to a file.
class Program {
 public:
  explicit Program(std::vector<std::string> arguments, std::string error_path = {})
      : error_path_(std::move(error_path)) {
    remove_ = error_path_.empty();
    if (remove_)
      error_path_ = ::testing::TempDir() + "subdivd_stderr_" + std::to_string(::getpid()) + "_" +
                    ::testing::UnitTest::GetInstance()->current_test_info()->name();
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return;
    arguments.insert(arguments.begin(), kProgram);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ == 0) {
      const int errors = ::open(error_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      ::dup2(ends[1], STDOUT_FILENO);
      ::dup2(errors, STDERR_FILENO);
      ::execv(kProgram.c_str(), argv.data());
      ::_exit(127);
    }
    ::close(ends[1]);
    out_ = ends[0];
  }
  ~Program() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
    ::close(out_);
    if (remove_) ::unlink(error_path_.c_str());
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  // Up to the first line's end; everything when the program ends first.
  std::string first_line() {
    std::string line;
    char c = 0;
    pollfd entry{out_, POLLIN, 0};
    while (::poll(&entry, 1, 30'000) > 0 && ::read(out_, &c, 1) == 1 && c != '\n') line += c;
    return line;
  }
  int port() {
    const std::string line = first_line();
    return std::atoi(line.substr(line.rfind(':') + 1).c_str());
  }
  void signal(int number) const { ::kill(pid_, number); }
  // The exit code; -1 when it does not end in time, 1000 + signal when a signal ended it.
  int exit_code(std::chrono::seconds patience = std::chrono::seconds(30)) {
    const auto deadline = Clock::now() + patience;
    int status = 0;
    while (::waitpid(pid_, &status, WNOHANG) == 0) {
      if (Clock::now() > deadline) return -1;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }
  std::string errors() const {
    std::ifstream file(error_path_);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }

 private:
  std::string error_path_;
  bool remove_ = true;
  pid_t pid_ = -1;
  int out_ = -1;
};

TEST(Daemon, prints_where_it_listens_and_answers_there) {
  Program program({"--port", "0"});
  EXPECT_EQ(ask(program.port(), get("/readyz")).status, 200);
}
TEST(Daemon, ends_with_0_on_sigterm) {
  Program program({"--port", "0"});
  ASSERT_GT(program.port(), 0);
  program.signal(SIGTERM);
  EXPECT_EQ(program.exit_code(), 0);
}
TEST(Daemon, ends_with_0_on_sigint) {
  Program program({"--port", "0"});
  ASSERT_GT(program.port(), 0);
  program.signal(SIGINT);
  EXPECT_EQ(program.exit_code(), 0);
}
TEST(Daemon, finishes_a_request_in_flight_before_it_ends) {
  Program program({"--port", "0"});
  const int port = program.port();
  const std::string body = R"({"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2]})";
  const std::string request = post("/v1/refine?level=1", body);
  RawClient client(port);
  client.send(request.substr(0, request.size() - 10));
  ASSERT_EQ(ask(port, get("/livez")).status, 200);  // the half request is being read by now
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  program.signal(SIGTERM);
  int readiness = 200;
  for (int i = 0; i < 400 && readiness == 200; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    readiness = ask(port, get("/readyz")).status;
  }
  EXPECT_EQ(readiness, 503);
  client.send(request.substr(request.size() - 10));
  EXPECT_EQ(client.receive().status, 200);
  EXPECT_EQ(program.exit_code(), 0);
}
TEST(Daemon, ends_when_the_time_for_draining_is_over) {
  Program program({"--port", "0", "--drain-seconds", "0.2"});
  RawClient client(program.port());
  client.send("POST /v1/refine HTTP/1.1\r\nHost: a\r\nContent-Length: 10\r\n\r\n");
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  program.signal(SIGTERM);
  EXPECT_EQ(program.exit_code(std::chrono::seconds(10)), 0);
}
TEST(Daemon, refuses_bad_flags_with_2) {
  Program program({"--port", "nonsense"});
  EXPECT_EQ(program.exit_code(), 2);
  EXPECT_NE(program.errors().find("--port (SUBDIVD_PORT) must be 0 to 65535"), std::string::npos);
}
TEST(Daemon, ends_with_1_when_the_port_is_taken) {
  Program first({"--port", "0"});
  Program second({"--port", std::to_string(first.port())});
  EXPECT_EQ(second.exit_code(), 1);
  EXPECT_NE(second.errors().find("cannot listen"), std::string::npos);
}
TEST(Daemon, prints_its_version) {
  Program program({"--version"});
  EXPECT_EQ(program.first_line(), std::string("subdivd ") + SUBDIVD_VERSION);
}
TEST(Daemon, health_check_tells_a_living_daemon_from_a_dead_one) {
  Program daemon({"--port", "0"});
  const std::string url = "http://127.0.0.1:" + std::to_string(daemon.port());
  EXPECT_EQ(Program({"--health-check", url + "/livez"}).exit_code(), 0);
  EXPECT_EQ(Program({"--health-check", url + "/nowhere"}).exit_code(), 1);
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.exit_code(), 0);
  EXPECT_EQ(Program({"--health-check", url + "/livez"}).exit_code(), 1);
}
TEST(Daemon, health_check_refuses_nonsense) {
  EXPECT_EQ(Program({"--health-check", "nonsense"}).exit_code(), 1);
}
TEST(Daemon, logs_one_escaped_line_per_request) {
  Program program({"--port", "0"});
  const int port = program.port();
  ask(port, get("/a%0aFAKE", "X-Evil: %0d%0aFAKE\r\n"));
  program.signal(SIGTERM);
  EXPECT_EQ(program.exit_code(), 0);
  const std::string log = program.errors();
  EXPECT_NE(log.find(R"(target="/a%0aFAKE" status=404)"), std::string::npos) << log;
  EXPECT_EQ(log.find("\nFAKE"), std::string::npos) << log;
}
// A pipe that nobody reads holds 64 KiB: the log of some 500 requests.
TEST(Daemon, serves_and_ends_while_the_reader_of_its_log_stalls) {
  const std::string path = ::testing::TempDir() + "subdivd_stalled_log_" + std::to_string(::getpid());
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const int reader = ::open(path.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  Program program({"--port", "0"}, path);
  RawClient client(program.port());
  const std::string target = "/" + std::string(300, 'x');
  for (int i = 0; i < 900; ++i) {
    client.send(get(target));
    ASSERT_EQ(client.receive().status, 404) << "request " << i;
  }
  program.signal(SIGTERM);
  EXPECT_EQ(program.exit_code(std::chrono::seconds(10)), 0);
  ::close(reader);
  ::unlink(path.c_str());
}
TEST(Daemon, is_not_ended_by_signals_that_mean_no_end) {
  Program program({"--port", "0"});
  const int port = program.port();
  for (const int signal : {SIGHUP, SIGUSR1, SIGUSR2}) {
    program.signal(signal);
    EXPECT_EQ(ask(port, get("/livez")).status, 200) << signal;
  }
  program.signal(SIGTERM);
  EXPECT_EQ(program.exit_code(), 0);
}
TEST(Daemon, tells_on_sigusr1_that_nothing_is_taken) {
  Program program({"--port", "0", "--max-memory-bytes", "64MiB"});
  const int port = program.port();
  const std::string body = R"({"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2]})";
  for (int i = 0; i < 20; ++i) EXPECT_EQ(ask(port, post("/v1/refine?level=5", body)).status, 200);
  // The client has its answer a moment before the daemon has done with the request.
  std::string log;
  const auto deadline = Clock::now() + std::chrono::seconds(30);
  while (log.find(" busy=0 ") == std::string::npos && Clock::now() < deadline) {
    program.signal(SIGUSR1);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    log = program.errors();
  }
  const auto value = [&](const std::string& name) {
    const std::size_t at = log.rfind(" " + name + "=");
    return at == std::string::npos ? -1 : std::atoll(log.c_str() + at + name.size() + 2);
  };
  EXPECT_GT(value("memory_total"), 0) << log;
  EXPECT_EQ(value("memory_free"), value("memory_total")) << log;
  EXPECT_EQ(value("places_free"), value("places_total")) << log;
  EXPECT_EQ(value("waiting"), 0) << log;
}
TEST(Daemon, survives_a_log_that_cannot_be_written) {
  Program program({"--port", "0"}, "/dev/full");
  const int port = program.port();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(ask(port, get("/livez")).status, 200);
  program.signal(SIGTERM);
  EXPECT_EQ(program.exit_code(), 0);
}

}  // namespace
}  // namespace subdivd::server::testing

#include "tests/soak/daemon.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "tests/soak/connection.h"

namespace subdivd::soak {
namespace {

constexpr int kStartMilliseconds = 30'000;
constexpr std::size_t kMostComplaints = 20;

std::string first_line(int fd) {
  std::string line;
  char c = 0;
  pollfd entry{fd, POLLIN, 0};
  while (::poll(&entry, 1, kStartMilliseconds) > 0 && ::read(fd, &c, 1) == 1 && c != '\n') line += c;
  return line;
}

bool becomes_ready(int port) {
  const Clock::time_point deadline = Clock::now() + milliseconds(kStartMilliseconds);
  while (Clock::now() < deadline) {
    Connection connection(port);
    if (connection.send("GET /readyz HTTP/1.1\r\nHost: soak\r\nConnection: close\r\n\r\n") &&
        connection.receive().status == 200)
      return true;
    std::this_thread::sleep_for(milliseconds(50));
  }
  return false;
}

// "VmRSS:   1234 kB" and the like; 0 when the line is not there.
std::uint64_t status_number(const std::string& status, const std::string& name, int base = 10) {
  const std::size_t at = status.find("\n" + name + ":");
  return at == std::string::npos ? 0 : std::strtoull(status.c_str() + at + name.size() + 2, nullptr, base);
}

std::string process_folder(pid_t pid) { return "/proc/" + std::to_string(pid); }

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

std::optional<Counters> counters_in(std::string_view line) {
  constexpr std::string_view kMark = " state ";
  const std::size_t at = line.find(kMark);
  if (at == std::string_view::npos) return std::nullopt;
  std::istringstream words(std::string(line.substr(at + kMark.size())));
  Counters counters;
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) return std::nullopt;
    std::uint64_t value = 0;
    const char* end = word.data() + word.size();
    if (std::from_chars(word.data() + equals + 1, end, value).ptr == end)
      counters[word.substr(0, equals)] = value;
  }
  if (!counters.contains("memory_total")) return std::nullopt;
  return counters;
}

Daemon::Daemon(const std::string& program, std::vector<std::string> flags) {
  flags.insert(flags.begin(), {program, "--host", "127.0.0.1", "--port", "0"});
  std::vector<char*> argv;
  for (std::string& flag : flags) argv.push_back(flag.data());
  argv.push_back(nullptr);
  int out[2], log[2];
  if (::pipe2(out, O_CLOEXEC) != 0 || ::pipe2(log, O_CLOEXEC) != 0) return;
  pid_ = ::fork();
  if (pid_ == 0) {
    ::dup2(out[1], STDOUT_FILENO);
    ::dup2(log[1], STDERR_FILENO);
    ::execv(program.c_str(), argv.data());
    ::_exit(127);
  }
  ::close(out[1]);
  ::close(log[1]);
  out_ = out[0];
  log_ = log[0];
  drain_ = std::thread([this] { drain_log(); });
  const std::string line = first_line(out_);
  const int port = std::atoi(line.c_str() + line.rfind(':') + 1);
  if (port > 0 && becomes_ready(port)) port_ = port;
}

Daemon::~Daemon() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  if (drain_.joinable()) drain_.join();
  if (out_ >= 0) ::close(out_);
  if (log_ >= 0) ::close(log_);
}

void Daemon::drain_log() {
  std::array<char, 65536> piece{};
  std::string rest;
  for (ssize_t got = 0; (got = ::read(log_, piece.data(), piece.size())) > 0;) {
    rest.append(piece.data(), static_cast<std::size_t>(got));
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = rest.find('\n', begin)) != std::string::npos; begin = end + 1)
      take_line(rest.substr(begin, end - begin));
    rest.erase(0, begin);
  }
}

void Daemon::take_line(std::string line) {
  if (line.find(" method=") != std::string::npos) return;
  auto counters = counters_in(line);
  const std::lock_guard lock(mutex_);
  if (counters) {
    report_ = std::move(counters);
    reported_.notify_all();
    return;
  }
  if (complaints_.size() == kMostComplaints) complaints_.erase(complaints_.begin());
  complaints_.push_back(std::move(line));
}

// A thread that waits for a signal shows it as not blocked while it waits; the others do block it.
bool Daemon::handles_sigusr1() const {
  std::uint64_t handled = 0;
  std::error_code fault;
  for (const auto& task : std::filesystem::directory_iterator(process_folder(pid_) + "/task", fault)) {
    const std::string status = text_of(task.path() / "status");
    for (const char* mask : {"SigBlk", "SigIgn", "SigCgt"}) handled |= status_number(status, mask, 16);
  }
  return (handled >> (SIGUSR1 - 1) & 1) != 0;
}

std::optional<Counters> Daemon::counters() {
  if (!alive() || !handles_sigusr1()) return std::nullopt;
  std::unique_lock lock(mutex_);
  report_.reset();
  ::kill(pid_, SIGUSR1);
  reported_.wait_for(lock, std::chrono::seconds(5), [&] { return report_.has_value(); });
  return report_;
}

std::vector<std::string> Daemon::complaints() {
  const std::lock_guard lock(mutex_);
  return complaints_;
}

Footprint Daemon::footprint() const {
  Footprint footprint;
  const std::string status = text_of(process_folder(pid_) + "/status");
  footprint.resident = status_number(status, "VmRSS") * 1024;
  footprint.peak_resident = status_number(status, "VmHWM") * 1024;
  footprint.threads = status_number(status, "Threads");
  std::error_code fault;
  for (auto entry = std::filesystem::directory_iterator(process_folder(pid_) + "/fd", fault);
       !fault && entry != std::filesystem::directory_iterator(); entry.increment(fault))
    ++footprint.descriptors;
  return footprint;
}

int Daemon::ended(int status) {
  pid_ = -1;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  return exit_code_;
}

bool Daemon::alive() {
  int status = 0;
  if (pid_ > 0 && ::waitpid(pid_, &status, WNOHANG) == pid_) ended(status);
  return pid_ > 0;
}

int Daemon::stop(std::chrono::seconds patience) {
  if (!alive()) return exit_code_;
  ::kill(pid_, SIGTERM);
  const Clock::time_point deadline = Clock::now() + patience;
  while (alive()) {
    if (Clock::now() > deadline) return -1;
    std::this_thread::sleep_for(milliseconds(5));
  }
  return exit_code_;
}

}  // namespace subdivd::soak

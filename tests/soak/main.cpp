// The daemon under mixed traffic at saturation for as long as one likes, and whether anything of it stays
// behind.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/soak/daemon.h"
#include "tests/soak/requests.h"
#include "tests/soak/tally.h"
#include "tests/soak/traffic.h"
#include "tests/soak/verdict.h"

namespace subdivd::soak {
namespace {

struct Settings {
  double minutes = 1;
  std::int64_t requests = 0;  // instead of minutes: so many ordinary ones, and nothing else
  std::string memory;         // --max-memory-bytes of the daemon
  std::size_t clients = 16;   // well-behaved; half as many misbehave
  std::uint64_t seed = 0;
  std::string program, sources;
  std::vector<std::string> daemon_flags;
};

constexpr std::size_t kCrowd = 80, kRequestsInCrowd = 4;
constexpr std::chrono::seconds kMostForRequests{1800}, kEndPatience{5};

// Well-behaved and bad clients as threads, until the traffic stops.
class Clients {
 public:
  Clients(const Settings& settings, Traffic& traffic)
      : traffic_(traffic),
        good_(good_requests(settings.sources)),
        refused_(refused_requests(settings.sources)) {
    const bool ordinary = settings.requests > 0;
    for (std::size_t i = 0; i < settings.clients; ++i)
      threads_.emplace_back([this, ordinary, seed = settings.seed + i] {
        behave_well(traffic_, good_, refused_, ordinary ? 0 : 5, seed);
      });
    for (std::size_t i = 0; !ordinary && i < settings.clients / 2; ++i)
      threads_.emplace_back([this, &settings, seed = settings.seed + 1000 + i] {
        BadClient(traffic_, settings.sources, seed).misbehave();
      });
  }
  ~Clients() {
    traffic_.stop = true;
    for (std::thread& thread : threads_) thread.join();
  }
  Clients(const Clients&) = delete;
  Clients& operator=(const Clients&) = delete;

 private:
  Traffic& traffic_;
  const Mix good_, refused_;
  std::vector<std::thread> threads_;
};

// Every request once: what is wrong with one of them is told without traffic around it.
void ask_each_once(const Settings& settings, Traffic& traffic) {
  std::vector<Request> all = good_requests(settings.sources);
  if (settings.requests == 0)
    for (Request& request : refused_requests(settings.sources)) all.push_back(std::move(request));
  for (const Request& request : all) {
    Connection connection(traffic.port);
    exchange(traffic, connection, request);
  }
}

// More than there are places and waiting room: some are turned away, and told so properly.
void crowd(Traffic& traffic) {
  const std::string request = post("/v1/refine?level=4&normals=true", sheet_json(20, 20));
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < kCrowd; ++i)
    threads.emplace_back([&] {
      for (std::size_t k = 0; k < kRequestsInCrowd; ++k) {
        Connection connection(traffic.port);
        connection.send(request);
        const Answer answer = connection.receive();
        traffic.tally.answered("in a crowd", answer, {200, 503});
        if (answer.status == 200) traffic.tally.compare("in a crowd", Request::identity_of(request), answer);
        if (answer.status == 503 && !answer.retry_after)
          traffic.tally.fault("in a crowd: 503 without Retry-After");
        if (answer.status == 503 && answer.beginning.find("\"overloaded\"") == std::string::npos)
          traffic.tally.fault("in a crowd: 503 for another reason: " + answer.beginning);
      }
    });
  for (std::thread& thread : threads) thread.join();
}

// Lets the clients work, and looks at the daemon meanwhile.
std::vector<Sample> observe(const Settings& settings, Daemon& daemon, const Traffic& traffic) {
  std::vector<Sample> samples;
  const Clock::time_point start = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  const double most = settings.requests > 0 ? kMostForRequests.count() : settings.minutes * 60;
  while (daemon.alive() && seconds() < most && traffic.requests_left > 0) {
    samples.push_back({seconds(), daemon.footprint(), daemon.counters()});
    std::this_thread::sleep_for(milliseconds(500));
  }
  return samples;
}

std::vector<std::string> daemon_flags(const Settings& settings) {
  std::vector<std::string> flags = {"--log-level", "info"};
  if (!settings.memory.empty()) flags.insert(flags.end(), {"--max-memory-bytes", settings.memory});
  if (settings.requests == 0)
    flags.insert(flags.end(), {"--max-concurrent", "2", "--max-waiting", "32", "--deadline-seconds", "5"});
  flags.insert(flags.end(), settings.daemon_flags.begin(), settings.daemon_flags.end());
  return flags;
}

std::uint64_t bytes_of(const std::string& size) {
  if (size.empty()) return std::uint64_t{4} << 30;  // the daemon's default
  char* unit = nullptr;
  const std::uint64_t number = std::strtoull(size.c_str(), &unit, 10);
  const std::string word = unit;
  return number << (word == "GiB" ? 30 : word == "MiB" ? 20 : word == "KiB" ? 10 : 0);
}

void print_beginning(const Settings& settings, const std::vector<std::string>& flags) {
  std::printf("soak: seed %llu, %zu clients, daemon", static_cast<unsigned long long>(settings.seed),
              settings.clients);
  for (const std::string& flag : flags) std::printf(" %s", flag.c_str());
  std::printf("\n");
  std::fflush(stdout);
}

void judge(const Settings& settings, Daemon& daemon, Traffic& traffic, const std::vector<Sample>& samples,
           const Rest& start, Verdict& verdict) {
  const Rest end = settle(daemon, &start);
  verdict.check("the daemon lives", daemon.alive(), "");
  judge_counters(verdict, start, end);
  judge_kernel(verdict, start, end);
  judge_memory(verdict, samples, start, end);
  judge_peak(verdict, bytes_of(settings.memory), start, end);
  Connection last(traffic.port);
  last.send(post("/v1/refine?level=1", kTetrahedron));
  verdict.check("a last request is answered", last.receive().status == 200, "");
  last.close();
  const int code = daemon.stop(kEndPatience);
  verdict.check("SIGTERM ends it with exit code 0", code == 0, "exit code " + std::to_string(code));
  if (settings.requests > 0)
    verdict.check("all requests were sent", traffic.requests_left <= 0, std::to_string(settings.requests));
  verdict.check("every answer was the expected one", traffic.tally.fault_count() == 0,
                std::to_string(traffic.tally.fault_count()) + " of " + std::to_string(traffic.tally.total()) +
                    " were not");
}

bool run(const Settings& settings) {
  const std::vector<std::string> flags = daemon_flags(settings);
  print_beginning(settings, flags);
  Daemon daemon(settings.program, flags);
  if (daemon.port() == 0) {
    std::printf("the daemon did not start: %s\n", settings.program.c_str());
    return false;
  }
  Tally tally;
  Traffic traffic{.port = daemon.port(), .tally = tally};
  ask_each_once(settings, traffic);
  const Rest start = settle(daemon, nullptr);
  if (settings.requests > 0) traffic.requests_left = settings.requests;
  const Clock::time_point began = Clock::now();
  std::vector<Sample> samples;
  {
    const Clients clients(settings, traffic);
    samples = observe(settings, daemon, traffic);
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
  const double per_second = static_cast<double>(tally.total()) / seconds;
  if (settings.requests == 0) crowd(traffic);
  Verdict verdict;
  judge(settings, daemon, traffic, samples, start, verdict);

  tally.print();
  std::printf("\n");
  print_samples(samples);
  std::printf("\n%zu requests in %.0f s, %.0f a second\n\n", tally.total(), seconds, per_second);
  for (const std::string& line : daemon.complaints()) std::printf("log: %s\n", line.c_str());
  verdict.print();
  return verdict.good();
}

std::string from_environment(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : otherwise;
}

}  // namespace
}  // namespace subdivd::soak

int main(int argc, char** argv) {
  subdivd::soak::Settings settings;
  settings.program = subdivd::soak::from_environment("SUBDIVD_DAEMON", SUBDIVD_BINARY_DIR "/subdivd");
  settings.sources = subdivd::soak::from_environment("SUBDIVD_SOURCE_DIR", SUBDIVD_SOURCE_DIR);
  CLI::App app("Mixed traffic at saturation; what was taken must be given back");
  app.add_option("--minutes", settings.minutes, "How long; 1")->check(CLI::Range(0.05, 1440.0));
  app.add_option("--requests", settings.requests,
                 "Instead: so many ordinary requests, all of which must be answered 200");
  app.add_option("--memory", settings.memory, "The daemon's --max-memory-bytes; mixed traffic: 256MiB");
  app.add_option("--clients", settings.clients, "Well-behaved clients; 16")->check(CLI::Range(1, 256));
  app.add_option("--seed", settings.seed, "Of all random numbers; by default from the clock");
  app.add_option("--daemon", settings.program, "The program");
  app.add_option("daemon_flags", settings.daemon_flags, "After --: more flags for the daemon");
  CLI11_PARSE(app, argc, argv);
  if (settings.requests == 0 && settings.memory.empty()) settings.memory = "256MiB";
  if (settings.seed == 0)
    settings.seed = static_cast<std::uint64_t>(std::chrono::system_clock::now().time_since_epoch().count());
  return subdivd::soak::run(settings) ? 0 : 1;
}

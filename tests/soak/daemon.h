#pragma once
// The daemon in a process of its own: its life, its log, and what the kernel and it itself tell of its state.

#include <sys/types.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace subdivd::soak {

// What `state` says in the log when SIGUSR1 comes: key=value words.
using Counters = std::map<std::string, std::uint64_t>;
std::optional<Counters> counters_in(std::string_view log_line);

// From /proc. Memory in bytes.
struct Footprint {
  std::uint64_t resident = 0, peak_resident = 0;
  std::size_t threads = 0, descriptors = 0;
};

class Daemon {
 public:
  // Starts it on a free port of loopback and waits until /readyz says 200; port() is 0 when it does not.
  Daemon(const std::string& program, std::vector<std::string> flags);
  ~Daemon();
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  int port() const { return port_; }
  bool alive();
  Footprint footprint() const;
  // Nothing when the daemon does not handle SIGUSR1 (which would kill it) or does not answer within 5 s.
  std::optional<Counters> counters();
  // SIGTERM. The exit code; -1 when it does not end in time, 1000 + signal when a signal ended it.
  int stop(std::chrono::seconds patience);
  // The last lines that are no access lines: failures are told there.
  std::vector<std::string> complaints();

 private:
  void drain_log();
  void take_line(std::string line);
  bool handles_sigusr1() const;
  int ended(int status);

  pid_t pid_ = -1;
  int out_ = -1, log_ = -1, port_ = 0;
  int exit_code_ = -1;
  std::thread drain_;
  std::mutex mutex_;
  std::condition_variable reported_;
  std::optional<Counters> report_;
  std::vector<std::string> complaints_;
};

}  // namespace subdivd::soak

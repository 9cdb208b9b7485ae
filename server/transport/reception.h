#pragma once
// One thread that holds every connection nobody works on: new ones that have sent nothing, those whose head
// is not complete, idle ones that are kept alive, and those that have had their last answer. None of them
// costs more than a descriptor and a few hundred bytes, so thousands may come and wait.

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "core/base/result.h"
#include "server/transport/census.h"
#include "server/transport/connection.h"
#include "server/transport/lanes.h"
#include "server/transport/listener.h"
#include "server/transport/quota.h"

namespace subdivd::server {

class Reception {
 public:
  struct Limits {
    std::size_t connections = 0;
    std::chrono::milliseconds silence{};  // before the first byte
    std::chrono::milliseconds head{};     // from a head's first byte to its last
    std::chrono::milliseconds idle{};     // between two requests
  };

  // Complete requests go to `lanes`; heads are paid for from `memory`.
  Reception(Lanes& lanes, Quota& memory, Census& census) : lanes_(lanes), memory_(memory), census_(census) {}
  ~Reception() { stop(); }
  Reception(const Reception&) = delete;
  Reception& operator=(const Reception&) = delete;

  // Throws std::system_error when the system has no thread.
  Result<void> start(const std::string& host, int port, const Limits& limits);
  int port() const { return listener_ ? listener_->port() : 0; }

  // From any thread: a connection that has been answered, and may send its next request ...
  void await_request(Connections one, bool head_begun);
  // ... or may only read its last answer. Our side has ended; it is closed when the client's has, or soon.
  void await_end(Connections one);

  void begin_drain();  // closes what is idle
  void stop();         // closes everything, joins

  struct Counts {
    std::size_t silent = 0, heads = 0, idle = 0, lingering = 0;
  };
  Counts counts() const;

 private:
  using Phase = Connection::Phase;

  void run();
  int milliseconds_to_wait();
  void wake() const;

  void accept_some();
  void listen(bool on);
  void admit(int fd);
  bool make_room();

  void attend(Connection& connection);
  Connection::Progress read_head(Connection& connection);
  void close_overdue();
  bool end_waiting(Connection& connection);
  void end_head(Connection& connection);
  void close_idle();

  void add(Connections one, Phase phase);
  void move(Connection& connection, Phase phase);
  bool arm(Connection& connection);
  void disarm(Connection& connection);
  Connections take(Connection& connection);
  Connection* front(Phase phase) const;
  std::chrono::milliseconds patience(Phase phase) const;
  Connections& list(Phase phase) { return lists_[static_cast<std::size_t>(phase)]; }
  const Connections& list(Phase phase) const { return lists_[static_cast<std::size_t>(phase)]; }

  Lanes& lanes_;
  Quota& memory_;
  Census& census_;
  Limits limits_;
  std::unique_ptr<Listener> listener_;
  int epoll_ = -1, wake_ = -1;
  bool listening_ = false;
  std::atomic<bool> draining_ = false;

  // Only the thread takes connections out of the lists, so it may look at those within without the lock.
  mutable std::mutex mutex_;
  std::array<Connections, 4> lists_;  // by phase; the longest waiting first
  Clock::time_point sleeps_until_{};
  bool stopped_ = false;

  std::thread thread_;
};

}  // namespace subdivd::server

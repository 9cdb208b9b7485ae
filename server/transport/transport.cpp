#include "server/transport/transport.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "server/transport/census.h"
#include "server/transport/descriptors.h"
#include "server/transport/lanes.h"
#include "server/transport/reception.h"
#include "server/transport/watcher.h"
#include "server/transport/worker.h"

namespace subdivd::server {
namespace {

constexpr std::chrono::milliseconds kPoll{5};
// A health answer fits into the kernel's buffer; who has left that full of earlier ones is no prober.
constexpr std::chrono::milliseconds kHealthPatience{20};
// A client that sends one request after the other is spared the way through the reception.
constexpr std::chrono::milliseconds kStay{1};

}  // namespace

class Transport::Impl {
 public:
  Impl(TransportOptions options, Service& service, RequestMemory& memory)
      : options_(std::move(options)),
        lanes_(service, options_.queue_timeout),
        context_{service,
                 watcher_,
                 memory,
                 lanes_.demand(),
                 draining_,
                 {std::min(options_.max_body_bytes, memory.most_body()), options_.read_timeout},
                 options_.idle_timeout,
                 options_.max_requests_per_connection},
        reception_(lanes_, memory.heads, census_) {}

  ~Impl() {
    end();
    join();
  }

  Result<void> start() {
    max_connections_ = allow_connections(options_.max_connections);
    try {
      add_worker(Lane::health, kHealthPatience);
      for (std::size_t i = 0; i < options_.threads; ++i) add_worker(Lane::general, options_.read_timeout);
      return reception_.start(options_.host, options_.port,
                              {max_connections_, options_.idle_timeout, options_.read_timeout,
                               options_.idle_timeout + options_.idle_grace});
    } catch (const std::system_error&) {
      end();
      join();
      return Error{.code = ErrorCode::internal,
                   .message = "the system refuses to start so many threads",
                   .predicted = 0,
                   .allowed = options_.threads};
    }
  }

  int port() const { return reception_.port(); }

  void begin_drain() {
    draining_ = true;
    reception_.begin_drain();
  }

  bool wait_until_idle(std::chrono::milliseconds patience) {
    const Clock::time_point deadline = Clock::now() + patience;
    for (;;) {
      if (!census_.wait_until_no_request(deadline)) return false;
      if (reception_.counts().lingering == 0) return true;
      if (Clock::now() >= deadline) return false;
      std::this_thread::sleep_for(kPoll);
    }
  }

  bool stop(std::chrono::milliseconds patience) {
    end();
    {
      std::unique_lock lock(mutex_);
      if (!ended_.wait_for(lock, patience, [this] { return running_ == 0; })) return false;
    }
    join();
    return true;
  }

  State state() const {
    const Reception::Counts counts = reception_.counts();
    State state;
    state.connections = census_.connections();
    state.max_connections = max_connections_;
    state.silent = counts.silent;
    state.idle = counts.idle;
    state.lingering = counts.lingering;
    state.requests = census_.requests();
    state.heads = counts.heads;
    state.waiting = lanes_.waiting();
    const std::lock_guard lock(mutex_);
    state.threads = running_;
    return state;
  }

 private:
  void end() {
    draining_ = true;
    reception_.stop();
    lanes_.close();
    watcher_.cut_all();
  }

  void join() {
    for (std::thread& worker : workers_) worker.join();
    workers_.clear();
  }

  void add_worker(Lane lane, std::chrono::milliseconds patience) {
    workers_.reserve(workers_.size() + 1);  // a thread that has no place in the list could not be joined
    count_thread(1);  // from here on, not from when it first runs: it is there, and stop() must wait for it
    try {
      workers_.emplace_back([this, lane, patience] { work(lane, patience); });
    } catch (const std::system_error&) {
      count_thread(-1);
      throw;
    }
  }

  void work(Lane lane, std::chrono::milliseconds patience) {
    {
      Worker worker(context_, patience);
      for (;;) {
        Connections one = lanes_.pop(lane);
        if (one.empty()) break;
        serve(worker, lane, std::move(one));
      }
    }
    count_thread(-1);
  }

  void count_thread(int change) {
    const std::lock_guard lock(mutex_);
    running_ += static_cast<std::size_t>(change);
    if (running_ == 0) ended_.notify_all();
  }

  void serve(Worker& worker, Lane lane, Connections one) {
    Connection& connection = *one.front();
    for (;;) {
      const Worker::After after = worker.answer(connection);
      const Census::Counted counted = std::move(connection.turn().counted);  // until the reception has it
      connection.end_turn();
      if (after == Worker::After::close) return;
      if (after == Worker::After::linger) return reception_.await_end(std::move(one));
      switch (next_head(connection, lane)) {
        case Connection::Progress::closed:
          return;
        case Connection::Progress::nothing:
          return reception_.await_request(std::move(one), false);
        case Connection::Progress::begun:
          return reception_.await_request(std::move(one), true);
        case Connection::Progress::complete:
          // Whoever waits already has waited longer.
          if (lane == Lane::health || lanes_.others_wait(lane)) return lanes_.push(std::move(one));
      }
    }
  }

  Connection::Progress next_head(Connection& connection, Lane lane) {
    ClientSocket& socket = connection.socket();
    try {
      if (lane == Lane::general && socket.buffered().empty() && lanes_.has_spare_thread(lane))
        socket.wait_readable(Clock::now() + kStay);
      return connection.read_head();
    } catch (const std::bad_alloc&) {
      socket.write_now(kBareOverloaded);
      return Connection::Progress::closed;
    }
  }

  const TransportOptions options_;
  std::size_t max_connections_ = 0;
  Census census_;  // outlives every connection
  Watcher watcher_;
  std::atomic<bool> draining_ = false;
  Lanes lanes_;
  const WorkerContext context_;
  Reception reception_;
  mutable std::mutex mutex_;
  std::condition_variable ended_;
  std::size_t running_ = 0;  // threads
  std::vector<std::thread> workers_;
};

Transport::Transport(TransportOptions options, Service& service, RequestMemory& memory)
    : impl_(std::make_unique<Impl>(std::move(options), service, memory)) {}
Transport::~Transport() = default;
Result<void> Transport::start() { return impl_->start(); }
int Transport::port() const { return impl_->port(); }
void Transport::begin_drain() { impl_->begin_drain(); }
bool Transport::wait_until_idle(std::chrono::milliseconds patience) {
  return impl_->wait_until_idle(patience);
}
bool Transport::stop(std::chrono::milliseconds patience) { return impl_->stop(patience); }
Transport::State Transport::state() const { return impl_->state(); }

}  // namespace subdivd::server

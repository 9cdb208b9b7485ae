#include "server/transport/transport.h"

#include <unistd.h>

#include <atomic>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "server/transport/connection.h"
#include "server/transport/engine.h"
#include "server/transport/listener.h"
#include "server/transport/work_queue.h"

namespace subdivd::server {
namespace {

constexpr std::size_t kWaitingConnections = 1024;
constexpr std::chrono::milliseconds kPoll{20};

}  // namespace

class Transport::Impl {
 public:
  Impl(TransportOptions options, Service& service, Quota& memory)
      : options_(std::move(options)),
        context_{
            options_, service, watcher_, memory, busy_, draining_, [this] { return !waiting_.empty(); }} {}

  ~Impl() { stop(); }

  Result<void> start() {
    auto listener = Listener::open(options_.host, options_.port);
    if (!listener) return std::move(listener).error();
    listener_ = std::move(listener).value();
    try {
      for (std::size_t i = 0; i < options_.threads; ++i) workers_.emplace_back([this] { work(); });
      acceptor_ = std::thread([this] { accept(); });
    } catch (const std::system_error&) {
      stop();
      return Error{
          ErrorCode::internal, "the system refuses to start so many threads", {}, 0, options_.threads};
    }
    return {};
  }

  int port() const { return listener_ ? listener_->port() : 0; }
  void begin_drain() { draining_ = true; }

  bool wait_until_idle(std::chrono::milliseconds patience) {
    const Clock::time_point deadline = Clock::now() + patience;
    for (;;) {
      if (!busy_.wait_until_zero(deadline)) return false;
      if (waiting_.empty()) return true;
      if (Clock::now() >= deadline) return false;
      std::this_thread::sleep_for(kPoll);
    }
  }

  void stop() {
    if (!listener_) return;
    draining_ = true;
    listener_->stop();
    waiting_.close();
    if (acceptor_.joinable()) acceptor_.join();
    ended_ = true;
    watcher_.cut_all();
    for (std::thread& worker : workers_) worker.join();
    workers_.clear();
  }

 private:
  void accept() {
    for (;;) {
      const int fd = listener_->accept();
      if (fd < 0) return;
      if (!waiting_.push(fd)) ::close(fd);
    }
  }

  void work() {
    Engine engine;
    while (const std::optional<int> fd = waiting_.pop()) {
      if (ended_) {
        ::close(*fd);
        continue;
      }
      try {
        Connection(*fd, engine, context_).serve();
      } catch (...) {  // out of memory while reading a head: this connection ends, the others do not
      }
    }
  }

  const TransportOptions options_;
  Watcher watcher_;
  BusyCount busy_;
  WorkQueue waiting_{kWaitingConnections};
  std::atomic<bool> draining_ = false, ended_ = false;
  const ConnectionContext context_;
  std::unique_ptr<Listener> listener_;
  std::vector<std::thread> workers_;
  std::thread acceptor_;
};

Transport::Transport(TransportOptions options, Service& service, Quota& memory)
    : impl_(std::make_unique<Impl>(std::move(options), service, memory)) {}
Transport::~Transport() = default;
Result<void> Transport::start() { return impl_->start(); }
int Transport::port() const { return impl_->port(); }
void Transport::begin_drain() { impl_->begin_drain(); }
bool Transport::wait_until_idle(std::chrono::milliseconds patience) {
  return impl_->wait_until_idle(patience);
}
void Transport::stop() { impl_->stop(); }

}  // namespace subdivd::server

#pragma once
// The life of one connection: head, judgement, body, answer, and again while it is kept alive.

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "server/transport/client_socket.h"
#include "server/transport/engine.h"
#include "server/transport/head.h"
#include "server/transport/quota.h"
#include "server/transport/service.h"
#include "server/transport/transport.h"
#include "server/transport/watcher.h"

namespace subdivd::server {

// How many requests are being read, answered or sent.
class BusyCount {
 public:
  void enter() {
    const std::lock_guard lock(mutex_);
    ++count_;
  }
  void leave() {
    const std::lock_guard lock(mutex_);
    --count_;
    changed_.notify_all();
  }
  bool wait_until_zero(Clock::time_point deadline) {
    std::unique_lock lock(mutex_);
    return changed_.wait_until(lock, deadline, [this] { return count_ == 0; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int count_ = 0;
};

// What all connections share.
struct ConnectionContext {
  const TransportOptions& options;
  Service& service;
  Watcher& watcher;
  Quota& memory;
  BusyCount& busy;
  const std::atomic<bool>& draining;
  std::function<bool()> others_wait;  // are there connections without a thread?
};

class Connection {
 public:
  Connection(int fd, Engine& engine, const ConnectionContext& context);
  void serve();

 private:
  enum class ReadHead { complete, refused, closed };

  struct Turn {  // one request
    Request request;
    Head head;
    std::optional<Response> early;  // what the head alone earned it
    bool body_left = false;         // does the wire still hold some of the request?
  };

  bool wait_for_request(bool first);
  bool serve_one(bool last);  // false: the connection ends
  bool begin(Turn& turn);
  ReadHead read_head(std::string& text, Refusal& refusal);
  std::optional<Refusal> understand(const std::string& text, Head& head, Request& request) const;
  std::optional<Refusal> read_body(const BodyReader& reader, Turn& turn, Quota::Lease& lease) const;
  Response answer_with_body(const BodyReader& reader, Turn& turn);

  // The service's answers, whatever it throws.
  std::optional<Response> screen_safely(const Request& request);
  Response answer_safely(Request& request);
  Response refuse_safely(const Request& request, const Refusal& refusal);
  void record_safely(const Exchange& exchange);

  Engine& engine_;
  const ConnectionContext& context_;
  ClientSocket socket_;
  Watcher::Entry entry_;
};

}  // namespace subdivd::server

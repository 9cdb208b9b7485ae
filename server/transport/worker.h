#pragma once
// What one thread does with a connection whose request is complete: judge, read the body, answer, send.

#include <atomic>
#include <chrono>
#include <optional>

#include "server/transport/body.h"
#include "server/transport/connection.h"
#include "server/transport/engine.h"
#include "server/transport/quota.h"
#include "server/transport/service.h"
#include "server/transport/watcher.h"

namespace subdivd::server {

// What all workers share.
struct WorkerContext {
  Service& service;
  Watcher& watcher;
  RequestMemory& memory;
  ThreadDemand& demand;
  const std::atomic<bool>& draining;
  BodyLimits body;
  std::chrono::milliseconds idle_timeout{};
  std::size_t max_requests_per_connection = 0;
};

class Worker {
 public:
  enum class After {
    keep,    // another request may follow
    linger,  // nothing may follow, but the client has sent more than was read, or may be sending it
    close
  };

  // `patience` for clients that read slowly, see TransferTime.
  Worker(const WorkerContext& context, std::chrono::milliseconds patience);

  // Answers the connection's turn, which stays as it is until its owner ends it. Never throws: whatever
  // happens becomes an answer, or the end of the connection.
  After answer(Connection& connection);

 private:
  After exchange(Connection& connection);
  Response respond(Connection& connection, BodyBuffer& buffer, bool& body_left);

  // The service's answers, whatever it throws.
  std::optional<Response> screen_safely(const Request& request);
  Response answer_safely(const Turn& turn, Request& request, BodyBuffer& buffer);
  Response refuse_safely(const Request& request, const Refusal& refusal);
  void record_safely(const Exchange& exchange);

  const WorkerContext& context_;
  const std::chrono::milliseconds patience_;
  Engine engine_;
  Watcher::Post post_;
};

}  // namespace subdivd::server

#pragma once
// The daemon's ear: listens, reads requests within limits, lets a Service answer, sends. All of cpp-httplib
// is behind this header; README.md says what is done about its holes and where.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "server/transport/request_memory.h"
#include "server/transport/service.h"

namespace subdivd::server {

struct TransportOptions {
  std::string host = "127.0.0.1";
  int port = 0;                                     // 0: any free one, see Transport::port()
  std::size_t threads = 128;                        // requests read, answered and sent at once
  std::size_t max_connections = 0;                  // 0: as many as descriptors allow, 10,000 at most
  std::uint64_t max_body_bytes = 256u << 20;        // of one request; memory.most_body() at most
  std::chrono::milliseconds read_timeout{30'000};   // see TransferTime
  std::chrono::milliseconds idle_timeout{75'000};   // between two requests of one connection, as announced
  std::chrono::milliseconds idle_grace{5'000};      // more than was announced: for requests on their way
  std::chrono::milliseconds queue_timeout{10'000};  // how long a complete request may wait for a thread
  std::size_t max_requests_per_connection = 1'000;
};

class Transport {
 public:
  // `service` and `memory`, from which heads and bodies are buffered, must outlive the transport.
  Transport(TransportOptions options, Service& service, RequestMemory& memory);
  ~Transport();  // as stop(), but waits for as long as it takes
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  // Binds and serves from threads of its own. Fails when the address cannot be had.
  Result<void> start();
  int port() const;

  // Every response from now on ends its connection; idle connections are closed. New connections are still
  // accepted, so that the service can say no in its own words.
  void begin_drain();
  // Waits until no request is being read, answered or sent; false when that takes longer than `patience`.
  bool wait_until_idle(std::chrono::milliseconds patience);
  // Cancels whatever still runs, closes all connections and joins all threads. False when a request goes on
  // for longer than `patience` although it was cancelled: then threads still run, and the process should end
  // by _exit. May be called again.
  bool stop(std::chrono::milliseconds patience = std::chrono::milliseconds(10'000));

  struct State {
    std::size_t connections = 0, max_connections = 0;
    std::size_t silent = 0, idle = 0;  // that have not yet sent a byte; that are between two requests
    std::size_t lingering = 0;         // that only read their last answer
    std::size_t requests = 0;          // being read, waiting, answered or sent; among them:
    std::size_t heads = 0;             // whose head is not complete
    std::size_t waiting = 0;           // that wait for a thread
    std::size_t threads = 0;
  };
  State state() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace subdivd::server

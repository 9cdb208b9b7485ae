#pragma once
// The daemon's ear: listens, reads requests within limits, lets a Service answer, sends. All of cpp-httplib
// is behind this header; README.md says what is done about its holes and where.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "server/transport/quota.h"
#include "server/transport/service.h"

namespace subdivd::server {

struct TransportOptions {
  std::string host = "127.0.0.1";
  int port = 0;                                    // 0: any free one, see Transport::port()
  std::size_t threads = 64;                        // connections served at once; others wait their turn
  std::uint64_t max_body_bytes = 256u << 20;       // of one request
  std::chrono::milliseconds read_timeout{30'000};  // see Pace (client_socket.h)
  std::chrono::milliseconds idle_timeout{2'000};   // between two requests of one connection
  std::size_t max_requests_per_connection = 1'000;
};

class Transport {
 public:
  // `service` and `memory`, from which bodies are buffered, must outlive the transport.
  Transport(TransportOptions options, Service& service, Quota& memory);
  ~Transport();  // as stop() with no patience
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
  // Cancels whatever still runs, closes all connections and joins all threads.
  void stop();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace subdivd::server

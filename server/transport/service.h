#pragma once
// What the transport asks of whoever answers: four questions and a record. All are called from many threads.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/transport/message.h"

namespace subdivd::server {

// A request that the transport itself turns down. `code` is a public problem code.
struct Refusal {
  int status = 400;
  std::string_view code;
  std::string detail;           // one sentence: what was wrong, what would be right
  std::uint64_t predicted = 0;  // with allowed: the size that was announced and the one that may come
  std::uint64_t allowed = 0;
};

// One request and what became of it.
struct Exchange {
  const Request& request;  // of an unreadable request only the peer is known
  int status = 0;
  std::uint64_t body_bytes = 0;  // of the response, as announced
  bool completed = false;        // false: the client went away first
  double milliseconds = 0;
};

// Who answers a request: one of many threads, or the one that is kept free for questions after the health.
enum class Lane { general, health };

class Service {
 public:
  Service() = default;
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;
  virtual ~Service() = default;

  // Which lane a request takes that has no body. In the health lane nothing may take longer than a moment.
  virtual Lane lane([[maybe_unused]] const Request& head) { return Lane::general; }
  // Judges a request by its head, before a byte of its body is read. A response ends the matter; without
  // one, answer() follows as soon as the body is complete.
  virtual std::optional<Response> screen(const Request& head) = 0;
  // May move the body out of the request. An exception becomes refuse(500); one that says
  // that memory or threads are out, refuse(503).
  virtual Response answer(Request& request) = 0;
  // Words the transport's own refusals. `request` holds what could be read of it.
  virtual Response refuse(const Request& request, const Refusal& refusal) = 0;
  // Called once for each response, after the last byte. An exception is swallowed.
  virtual void record(const Exchange& exchange) = 0;
};

}  // namespace subdivd::server

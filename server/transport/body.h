#pragma once
// Reads the body of a request, within the bounds of size, memory and time.
//
// Memory is reserved before it is used and in few large steps, and waited for while others have it. If bodies
// grew piece by piece, many half-read ones could hold all of it between them, each in want of a little more,
// and none would ever be complete.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "server/transport/client_socket.h"
#include "server/transport/head.h"
#include "server/transport/quota.h"
#include "server/transport/service.h"

namespace subdivd::server {

// A string whose capacity is paid for from a quota.
class BodyBuffer {
 public:
  BodyBuffer(Quota& memory, std::string& body)
      : memory_(memory), body_(body), leases_{Quota::Lease(memory), Quota::Lease(memory)} {}

  // Room for `bytes` in all; false (and nothing changed) when the memory is not there until `deadline`. While
  // the body moves, the old room and the new one are both paid for.
  bool reserve(std::uint64_t bytes, Clock::time_point deadline);
  std::uint64_t most() const { return memory_.total(); }
  std::uint64_t reserved() const { return reserved_; }
  // Frees the body and gives its memory back.
  void release();

 private:
  Quota& memory_;
  std::string& body_;
  Quota::Lease leases_[2];
  std::size_t current_ = 0;
  std::uint64_t reserved_ = 0;
};

struct BodyLimits {
  std::uint64_t bytes = 0;
  std::chrono::milliseconds patience{};  // see Pace
};

Refusal body_too_large(std::uint64_t announced, std::uint64_t allowed);

// Fills `body`, which `buffer` pays for; afterwards the socket stands behind it. After a refusal it stands
// anywhere. Throws when the system has no memory.
std::optional<Refusal> read_body(ClientSocket& socket, const Head& head, const BodyLimits& limits,
                                 BodyBuffer& buffer, std::string& body);

}  // namespace subdivd::server

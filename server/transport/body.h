#pragma once
// Reads the body of a request, within the bounds of size, memory and time.
//
// Memory is reserved before it is used, all that a body will need at once, and waited for while others have
// it. If bodies grew piece by piece, many half-read ones could hold all of it between them, each in want of a
// little more, and none would ever be complete.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "server/transport/client_socket.h"
#include "server/transport/head.h"
#include "server/transport/request_memory.h"
#include "server/transport/service.h"

namespace subdivd::server {

// Every thread may read so much without asking: announced lengths are believed once this much has come.
inline constexpr std::uint64_t kFreeBody = 64 * 1024;

// A string whose capacity beyond kFreeBody is paid for.
class BodyBuffer {
 public:
  BodyBuffer(RequestMemory& memory, std::string& body)
      : memory_(memory), body_(body), medium_(memory.medium), large_(memory.large) {}

  // Room for `bytes` in all; false (and nothing changed) when the memory is not there until `deadline`, or
  // when `cancelled` (may be null) turns true. Waits only for a share of which this body has nothing: from
  // its free room for a medium one, from that for a large one. While the body moves, the old room and the new
  // one are paid for.
  bool reserve(std::uint64_t bytes, Clock::time_point deadline, const std::atomic<bool>* cancelled);
  std::uint64_t reserved() const { return reserved_; }
  // How far a body should grow whose length nobody knows, when `bytes` of it are there already: `most` in the
  // end.
  std::uint64_t next_room(std::uint64_t bytes, std::uint64_t most) const;
  // Frees the body and gives its memory back.
  void release();

 private:
  RequestMemory& memory_;
  std::string& body_;
  Quota::Lease medium_, large_;
  std::uint64_t reserved_ = 0;
};

struct BodyLimits {
  std::uint64_t bytes = 0;
  std::chrono::milliseconds patience{};  // see TransferTime
};

Refusal body_too_large(std::uint64_t announced, std::uint64_t allowed);

// Fills `body`, which `buffer` pays for (waiting for memory no longer than limits.patience, until
// `cancelled`); afterwards the socket stands behind it. After a refusal it stands anywhere. Throws when the
// system has no memory.
std::optional<Refusal> read_body(ClientSocket& socket, const Head& head, const BodyLimits& limits,
                                 ThreadDemand& demand, const std::atomic<bool>* cancelled, BodyBuffer& buffer,
                                 std::string& body);

}  // namespace subdivd::server

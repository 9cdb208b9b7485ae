#pragma once
// What requests take while they are read and answered, in shares that cannot be taken from each other: nobody
// who sends a large body slowly, or many heads, keeps those waiting who send a small one.

#include <cstdint>

#include "server/transport/quota.h"

namespace subdivd::server {

struct RequestMemory {
  explicit RequestMemory(std::uint64_t bytes)
      : heads(bytes / 8), medium(bytes / 8 * 3), large(bytes - bytes / 8 - bytes / 8 * 3) {}

  Quota heads;   // that are longer than a kilobyte
  Quota medium;  // bodies of up to most_medium(); those of up to 64 KiB are their thread's own (body.h)
  Quota large;   // all others

  std::uint64_t most_medium() const { return medium.total() / 8; }
  std::uint64_t most_body() const { return large.total(); }
  std::uint64_t total() const { return heads.total() + medium.total() + large.total(); }
  std::uint64_t free() const { return heads.free() + medium.free() + large.free(); }
};

}  // namespace subdivd::server

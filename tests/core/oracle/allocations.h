#pragma once
// What this thread allocates: this program replaces operator new (allocations.cpp). Blocks of other threads
// must not be freed by this one while it counts.

#include <cstdint>

namespace subdivd::oracle::testing {

// Under a sanitizer, which has an operator new of its own, nothing is counted and nothing fails.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kCounts = false;
#else
inline constexpr bool kCounts = true;
#endif

class Allocations {
 public:
  // The allocation with this number (from 0) throws std::bad_alloc; -1: none does.
  explicit Allocations(std::int64_t failing = -1);  // one at a time
  ~Allocations();
  Allocations(const Allocations&) = delete;
  Allocations& operator=(const Allocations&) = delete;

  std::int64_t count() const;
  // The most bytes that were allocated at once, beyond those before.
  std::int64_t peak_bytes() const;
};

}  // namespace subdivd::oracle::testing

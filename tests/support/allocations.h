#pragma once
// What a program allocates: linking allocations.cpp replaces its operator new. Stacks, and what comes from
// elsewhere (malloc, mmap), is not counted; neither our code nor Far does that.

#include <cstdint>

namespace subdivd::test {

// Counts as long as it lives; one at a time. Blocks from before must not be freed meanwhile, by any thread.
class Allocations {
 public:
  static constexpr std::int64_t kNever = -1;
  struct Failures {
    std::int64_t at = kNever;      // the allocation with this number (from 0) throws std::bad_alloc,
    std::int64_t beyond = kNever;  // and so does one that would make it more bytes than these at once
  };

  Allocations() : Allocations(Failures{}) {}
  explicit Allocations(Failures failures);
  ~Allocations();
  Allocations(const Allocations&) = delete;
  Allocations& operator=(const Allocations&) = delete;

  std::int64_t count() const;
  // The most bytes that were allocated at once, in blocks of the size that the allocator gave.
  std::int64_t peak_bytes() const;
};

}  // namespace subdivd::test

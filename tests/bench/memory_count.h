#pragma once
// Counts what goes through operator new: this program replaces it (memory_count.cpp). Stacks, and what is
// allocated by other means (malloc, mmap), are not counted; neither our core nor Far does that.

#include <cstdint>

namespace subdivd::bench {

class MemoryCount {
 public:
  MemoryCount();  // one at a time
  ~MemoryCount();
  MemoryCount(const MemoryCount&) = delete;
  MemoryCount& operator=(const MemoryCount&) = delete;
  // The most bytes that were allocated at once beyond those that were there at the beginning, in blocks of
  // the size that the allocator gave.
  std::int64_t peak_bytes() const;
};

}  // namespace subdivd::bench

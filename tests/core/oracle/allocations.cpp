#include "tests/core/oracle/allocations.h"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace {

struct Counters {
  bool counting = false;
  std::int64_t live = 0, peak = 0, count = 0, failing = -1;
};
thread_local Counters counters;

}  // namespace

namespace subdivd::oracle::testing {

Allocations::Allocations(std::int64_t failing) { counters = {true, 0, 0, 0, failing}; }
Allocations::~Allocations() { counters.counting = false; }
std::int64_t Allocations::count() const { return counters.count; }
std::int64_t Allocations::peak_bytes() const { return counters.peak; }

}  // namespace subdivd::oracle::testing

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

void* counted(std::size_t size, std::size_t alignment) {
  if (counters.counting && counters.count++ == counters.failing) throw std::bad_alloc();
  void* block = nullptr;
  if (alignment == 0)
    block = std::malloc(std::max<std::size_t>(size, 1));
  else if (posix_memalign(&block, alignment, size) != 0)  // which, unlike aligned_alloc, takes any size
    block = nullptr;
  if (block == nullptr) throw std::bad_alloc();
  if (counters.counting) {
    counters.live += static_cast<std::int64_t>(malloc_usable_size(block));
    counters.peak = std::max(counters.peak, counters.live);
  }
  return block;
}

void release(void* block) {
  if (counters.counting && block != nullptr)
    counters.live -= static_cast<std::int64_t>(malloc_usable_size(block));
  std::free(block);
}

}  // namespace

// The other forms (arrays, nothrow) call these.
void* operator new(std::size_t size) { return counted(size, 0); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept { release(block); }
void operator delete(void* block, std::size_t) noexcept { release(block); }
void operator delete(void* block, std::align_val_t) noexcept { release(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { release(block); }
#endif

#include "tests/support/allocations.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

// Off while times are taken: then an allocation costs one more branch, whoever makes it.
std::atomic<bool> counting{false};
std::atomic<std::int64_t> live{0}, peak{0}, allocated{0}, failing_at{-1}, most_live{-1};

}  // namespace

namespace subdivd::test {

Allocations::Allocations(Failures failures) {
  live = peak = allocated = 0;
  failing_at = failures.at;
  most_live = failures.beyond;
  counting = true;
}
Allocations::~Allocations() { counting = false; }
std::int64_t Allocations::count() const { return allocated; }
std::int64_t Allocations::peak_bytes() const { return peak; }

}  // namespace subdivd::test

namespace {

// The block, or null when it is to fail.
void* counted(void* block) {
  const auto size = static_cast<std::int64_t>(malloc_usable_size(block));
  const std::int64_t number = allocated.fetch_add(1, std::memory_order_relaxed);
  const std::int64_t now = live.fetch_add(size, std::memory_order_relaxed) + size;
  const std::int64_t most = most_live.load(std::memory_order_relaxed);
  if (number == failing_at.load(std::memory_order_relaxed) || (most >= 0 && now > most)) {
    live.fetch_sub(size, std::memory_order_relaxed);
    std::free(block);
    return nullptr;
  }
  std::int64_t before = peak.load(std::memory_order_relaxed);
  while (now > before && !peak.compare_exchange_weak(before, now, std::memory_order_relaxed)) {
  }
  return block;
}

void* allocate(std::size_t size, std::size_t alignment) {
  void* block = nullptr;
  if (alignment == 0)
    block = std::malloc(std::max<std::size_t>(size, 1));
  else if (posix_memalign(&block, alignment, size) != 0)  // which, unlike aligned_alloc, takes any size
    block = nullptr;
  if (block != nullptr && counting.load(std::memory_order_relaxed)) block = counted(block);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void release(void* block) {
  if (counting.load(std::memory_order_relaxed) && block != nullptr)
    live.fetch_sub(static_cast<std::int64_t>(malloc_usable_size(block)), std::memory_order_relaxed);
  std::free(block);
}

}  // namespace

// The library's nothrow forms call these. Its array forms do, too, but those of sanitizers do not.
void* operator new(std::size_t size) { return allocate(size, 0); }
void* operator new[](std::size_t size) { return allocate(size, 0); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept { release(block); }
void operator delete[](void* block) noexcept { release(block); }
void operator delete(void* block, std::size_t) noexcept { release(block); }
void operator delete[](void* block, std::size_t) noexcept { release(block); }
void operator delete(void* block, std::align_val_t) noexcept { release(block); }
void operator delete[](void* block, std::align_val_t) noexcept { release(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { release(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept { release(block); }

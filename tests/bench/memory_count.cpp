#include "tests/bench/memory_count.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

// Off while times are taken: then an allocation costs one more branch, for us and for all others alike.
std::atomic<bool> counting{false};
std::atomic<std::int64_t> live{0}, peak{0};

void* counted(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  if (counting.load(std::memory_order_relaxed)) {
    const auto size = static_cast<std::int64_t>(malloc_usable_size(block));
    const std::int64_t now = live.fetch_add(size, std::memory_order_relaxed) + size;
    std::int64_t most = peak.load(std::memory_order_relaxed);
    while (now > most && !peak.compare_exchange_weak(most, now, std::memory_order_relaxed)) {
    }
  }
  return block;
}

void release(void* block) {
  if (counting.load(std::memory_order_relaxed) && block != nullptr)
    live.fetch_sub(static_cast<std::int64_t>(malloc_usable_size(block)), std::memory_order_relaxed);
  std::free(block);
}

}  // namespace

// The other forms (arrays, nothrow) call these.
void* operator new(std::size_t size) { return counted(std::malloc(size > 0 ? size : 1)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}
void operator delete(void* block) noexcept { release(block); }
void operator delete(void* block, std::size_t) noexcept { release(block); }
void operator delete(void* block, std::align_val_t) noexcept { release(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { release(block); }

namespace subdivd::bench {

MemoryCount::MemoryCount() {
  live = 0;
  peak = 0;
  counting = true;
}

MemoryCount::~MemoryCount() { counting = false; }

std::int64_t MemoryCount::peak_bytes() const { return peak.load(); }

}  // namespace subdivd::bench

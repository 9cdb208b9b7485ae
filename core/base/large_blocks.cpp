#include "core/base/large_blocks.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <mutex>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace subdivd::large_blocks {
namespace {

// A block of one class serves every size of it: at most a sixteenth is left over.
std::size_t class_of(std::size_t bytes) {
  const std::size_t step = std::max(kHugePage, std::bit_floor(bytes) / 16);
  return (bytes + step - 1) / step * step;
}

void* new_block(std::size_t bytes) {
  void* const block = ::operator new (bytes, std::align_val_t{kHugePage});
  prefer_huge_pages(block, bytes);
  return block;
}

void give_back(void* block) noexcept { ::operator delete (block, std::align_val_t{kHugePage}); }

class Store {
 public:
  void keep(const Keep& keep) { keep_ = keep; }

  void* allocate(std::size_t bytes) {
    if (keep_.freed == 0) return new_block(bytes);
    const std::size_t size = class_of(bytes);
    if (void* const block = reuse(size)) return block;
    try {
      return new_block(size);
    } catch (const std::bad_alloc&) {
      trim();
    }
    try {
      return new_block(size);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      use_.in_use -= size;
      throw;
    }
  }

  void deallocate(void* block, std::size_t bytes) noexcept {
    if (keep_.freed == 0 || !store(block, class_of(bytes))) give_back(block);
  }

  void trim() noexcept {
    for (;;) {
      void* block = nullptr;
      {
        const std::lock_guard lock(mutex_);
        if (kept_count_ == 0) return;
        block = take(kept_count_ - 1);
      }
      give_back(block);
    }
  }

  Use use() {
    const std::lock_guard lock(mutex_);
    return use_;
  }

 private:
  struct Kept {
    void* block;
    std::size_t size;
  };
  static constexpr std::size_t kMostKept = 256;

  // A kept block of that size, or null: a new one is to be made, and there is room for it under the ceiling
  // unless blocks in use leave none.
  void* reuse(std::size_t size) {
    void* found = nullptr;
    {
      const std::lock_guard lock(mutex_);
      // The one freed last: its lines may still be in the caches.
      for (std::size_t k = kept_count_; k-- > 0 && found == nullptr;)
        if (kept_[k].size == size) found = take(k);
      use_.in_use += size;
    }
    while (found == nullptr) {
      void* oldest = nullptr;
      {
        const std::lock_guard lock(mutex_);
        if (kept_count_ == 0 || use_.in_use + use_.kept <= keep_.ceiling) break;
        oldest = take(0);
      }
      give_back(oldest);
    }
    return found;
  }

  bool store(void* block, std::size_t size) noexcept {
    const std::lock_guard lock(mutex_);
    use_.in_use -= size;
    if (kept_count_ == kMostKept || use_.kept + size > keep_.freed ||
        use_.in_use + use_.kept + size > keep_.ceiling)
      return false;
    kept_[kept_count_++] = {block, size};
    use_.kept += size;
    return true;
  }

  void* take(std::size_t at) noexcept {
    void* const block = kept_[at].block;
    use_.kept -= kept_[at].size;
    std::copy(kept_ + at + 1, kept_ + kept_count_, kept_ + at);
    --kept_count_;
    return block;
  }

  Keep keep_;  // set before there are threads
  std::mutex mutex_;
  Use use_;
  Kept kept_[kMostKept] = {};  // the longest kept first
  std::size_t kept_count_ = 0;
};

// Never destroyed: other objects that end with the program may hold blocks.
Store& store() {
  static Store* const only = new Store;
  return *only;
}

}  // namespace

void* allocate(std::size_t bytes) { return store().allocate(bytes); }
void deallocate(void* block, std::size_t bytes) noexcept { store().deallocate(block, bytes); }
void keep(const Keep& keep) { store().keep(keep); }
void trim() noexcept { store().trim(); }
Use use() { return store().use(); }

void prefer_huge_pages([[maybe_unused]] void* block, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  const auto begin = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t first = (begin + kHugePage - 1) / kHugePage * kHugePage;
  const std::uintptr_t last = (begin + bytes) / kHugePage * kHugePage;
  if (first < last) (void)::madvise(static_cast<char*>(block) + (first - begin), last - first, MADV_HUGEPAGE);
#endif
}

}  // namespace subdivd::large_blocks

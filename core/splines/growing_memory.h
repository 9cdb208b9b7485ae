#pragma once
// Memory for what grows while it is searched: how many pieces a curve is cut into, nobody knows beforehand.

#include <algorithm>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"

namespace subdivd {

// Takes from the budget in steps of half of what is held; never gives back.
class GrowingMemory {
 public:
  // `in_vector`: bytes of an element in its vector; `elsewhere`: bytes that it owns beside that.
  GrowingMemory(const Budget& budget, Count in_vector, Count elsewhere)
      // A vector that grows holds the old elements and twice as many new ones for a moment.
      : budget_(budget), each_(3 * in_vector + elsewhere) {}

  // To be called before there are `count` elements.
  Result<void> hold(Count count) {
    if (count <= held_) return {};
    const Count more = std::max(count, held_ + held_ / 2 + 64) - held_;
    held_ += more;
    return budget_.take_memory(more * each_);
  }

 private:
  const Budget& budget_;
  const Count each_;
  Count held_ = 0;
};

// The most that the system's allocator adds to a block: 8 bytes, rounded up to 16, and no block below 32.
inline constexpr Count kBytesPerBlock = 32;

}  // namespace subdivd

#pragma once
// Index types. Everything that can be indexed is numbered from 0 with 32 bits; counts that may exceed
// that (before they are checked) are 64-bit.

#include <cstdint>
#include <limits>

namespace subdivd {

using Index = std::uint32_t;
using Count = std::uint64_t;

// "No such element": never a valid index, because counts are limited to kMaxIndexCount.
inline constexpr Index kNoIndex = std::numeric_limits<Index>::max();
inline constexpr Count kMaxIndexCount = std::numeric_limits<Index>::max();

}  // namespace subdivd

#pragma once
// Whole arrays judged without a branch per element. They only say whether there is a fault; where it is, a
// second and slow pass finds out.

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

#include "core/base/index.h"
#include "core/base/pace.h"

namespace subdivd {

inline bool all_below(std::span<const Index> indices, Count limit) {
  constexpr Count kSigned = Count{1} << 31;
  if (indices.empty()) return true;
  if (limit == 0) return false;
  if (limit > kSigned) return *std::ranges::max_element(indices) < limit;
  // Sign bits: of an index too large for a signed one, and of what a smaller one exceeds the last by.
  const auto last = static_cast<Index>(limit - 1);
  Index any = 0;
  for (const Index index : indices) any |= (last - index) | index;
  return any < kSigned;
}

// Of faces by their numbers of vertices; where none is given all are triangles.
inline bool has_triangles_only(std::span<const Index> face_vertex_counts, const Pace& pace) {
  return pace.all_blocks(face_vertex_counts.size(), [&](Count begin, Count end) {
    return std::ranges::all_of(face_vertex_counts.subspan(begin, end - begin),
                               [](Index count) { return count == 3; });
  });
}

// Whether one of the triangles (3 indices each) names a vertex twice.
inline bool any_repeats(std::span<const Index> triangles) {
  // Four triangles, three vectors, at a time: every index against the one behind it and the one after that,
  // where these are of the same triangle. Vectors by name: compilers do not find them here.
  using Four [[gnu::vector_size(16)]] = Index;
  constexpr std::size_t kBlock = 12;
  constexpr Index kYes = ~Index{0};
  constexpr std::array<Four, 3> kNext{{{kYes, kYes, 0, kYes}, {kYes, 0, kYes, kYes}, {0, kYes, kYes, 0}}};
  constexpr std::array<Four, 3> kLast{{{kYes, 0, 0, kYes}, {0, 0, kYes, 0}, {0, kYes, 0, 0}}};
  const auto four_at = [](const Index* at) {
    Four four;
    std::memcpy(&four, at, sizeof four);
    return four;
  };
  Four any{};
  const Index* at = triangles.data();
  std::size_t left = triangles.size();
  for (; left >= kBlock + 2; left -= kBlock, at += kBlock)
    for (std::size_t k = 0; k < 3; ++k) {
      const Four own = four_at(at + 4 * k);
      any |= (Four(own == four_at(at + 4 * k + 1)) & kNext[k]) |
             (Four(own == four_at(at + 4 * k + 2)) & kLast[k]);
    }
  bool found = (any[0] | any[1] | any[2] | any[3]) != 0;
  for (; left >= 3; left -= 3, at += 3) found |= at[0] == at[1] || at[1] == at[2] || at[2] == at[0];
  return found;
}

// Calls f(k) for every element that is not zero, ascending; where there are few, at the speed of the memory.
template <class T, class F>
void for_each_set(std::span<const T> values, F&& f, const Pace& pace = {}) {
  constexpr std::size_t kBlock = 64;
  for (std::size_t begin = 0; begin < values.size(); begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, values.size());
    pace.spend(2);
    unsigned any = 0;
    for (std::size_t k = begin; k < end; ++k) any |= values[k] != T{};
    if (any == 0) continue;
    pace.spend(end - begin);
    for (std::size_t k = begin; k < end; ++k)
      if (values[k] != T{}) f(k);
  }
}

// Whether every index is below `count` and no triangle names a vertex twice: in one walk through memory.
inline bool all_sound(std::span<const Index> triangles, Count count) {
  constexpr std::size_t kBlock = 3 * 1024;
  for (; triangles.size() > kBlock; triangles = triangles.subspan(kBlock))
    if (const auto block = triangles.first(kBlock); !all_below(block, count) || any_repeats(block))
      return false;
  return all_below(triangles, count) && !any_repeats(triangles);
}

}  // namespace subdivd

#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "proto/gltf/work.h"

namespace subdivd::proto::gltf {

// std::sort that can be stopped: sorted blocks, merged two by two. `cost`: steps of one comparison.
// Holds a second array while it works; stopped, it leaves the elements in any order.
template <class T, class Less>
Result<void> polled_sort(std::vector<T>& values, const Less& less, Work& work, Count cost = 1) {
  constexpr std::size_t kBlock = 32;
  const std::size_t size = values.size();
  for (std::size_t begin = 0; begin < size; begin += kBlock) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
    const std::size_t count = std::min(kBlock, size - begin);
    std::sort(first, first + static_cast<std::ptrdiff_t>(count), less);
    if (auto stop = work.spend(5 * count * cost)) return *stop;
  }
  if (size <= kBlock) return {};
  auto held = work.hold(size * sizeof(T));
  if (!held) return held.error();
  std::vector<T> merged(size);
  for (std::size_t width = kBlock; width < size; width *= 2) {
    for (std::size_t begin = 0; begin < size; begin += 2 * width) {
      std::size_t a = begin, b = std::min(begin + width, size);
      const std::size_t a_end = b, b_end = std::min(begin + 2 * width, size);
      for (std::size_t out = begin; out < b_end; ++out) {
        const bool second = a == a_end || (b != b_end && less(values[b], values[a]));
        merged[out] = values[second ? b++ : a++];
        if (out % kBlock == 0)
          if (auto stop = work.spend(kBlock * cost)) return *stop;
      }
    }
    std::swap(values, merged);
  }
  return {};
}

}  // namespace subdivd::proto::gltf

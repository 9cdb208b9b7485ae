#include "proto/gltf/weld.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>

namespace subdivd::proto::gltf {

Welded weld_tuples(std::span<const double> values, Count width) {
  const Count count = width == 0 ? 0 : values.size() / width;
  const auto bits = [&](Count tuple, Count k) {
    return std::bit_cast<std::uint64_t>(values[tuple * width + k] + 0.0);  // -0 + 0 is +0
  };
  // The first word rides along: most comparisons never touch the values.
  struct Entry {
    std::uint64_t word;
    Index tuple;
  };
  std::vector<Entry> order(count);
  for (Count i = 0; i < count; ++i) order[i] = {bits(i, 0), static_cast<Index>(i)};
  const auto compare_rest = [&](Index a, Index b) {
    for (Count k = 1; k < width; ++k)
      if (const std::uint64_t x = bits(a, k), y = bits(b, k); x != y) return x < y ? -1 : 1;
    return 0;
  };
  std::sort(order.begin(), order.end(), [&](const Entry& a, const Entry& b) {
    if (a.word != b.word) return a.word < b.word;
    const int rest = compare_rest(a.tuple, b.tuple);
    return rest != 0 ? rest < 0 : a.tuple < b.tuple;
  });

  Welded weld;
  weld.id.resize(count);
  std::vector<Index> representative(count);
  for (Count i = 0; i < count; ++i) {
    const bool same =
        i > 0 && order[i].word == order[i - 1].word && compare_rest(order[i].tuple, order[i - 1].tuple) == 0;
    representative[order[i].tuple] = same ? representative[order[i - 1].tuple] : order[i].tuple;
  }
  for (Index i = 0; i < count; ++i) {
    if (representative[i] == i) {
      weld.id[i] = static_cast<Index>(weld.first.size());
      weld.first.push_back(i);
    } else {
      weld.id[i] = weld.id[representative[i]];
    }
  }
  return weld;
}

}  // namespace subdivd::proto::gltf

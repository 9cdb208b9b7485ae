#include "proto/gltf/tuples.h"

#include <type_traits>

namespace subdivd::proto::gltf {

Result<void> keep_first(std::vector<double>& values, Count width, const Welded& weld, Work& work) {
  if (weld.all_differ()) return {};
  const auto move_down = [&](auto w) -> Result<void> {
    for (Count id = 0; id < weld.first.size(); ++id) {
      if (auto stop = work.spend(1)) return *std::move(stop);
      for (Count k = 0; k < w; ++k) values[id * w + k] = values[weld.first[id] * w + k];
    }
    return {};
  };
  const auto moved = width == 3 ? move_down(std::integral_constant<Count, 3>{}) : move_down(width);
  if (!moved) return moved;
  values.resize(weld.first.size() * width);
  return {};
}

Result<void> widen_last(std::vector<double>& values, Count count, Count from, Count to, double padding,
                        Work& work) {
  if (from == to) return {};
  const Count begin = values.size() - count * from;
  values.resize(begin + count * to);
  for (Count i = count; i-- > 0;) {
    if (auto stop = work.spend(1)) return *std::move(stop);
    double* const wide = &values[begin + i * to];
    const double* const narrow = &values[begin + i * from];
    for (Count k = to; k-- > 0;) wide[k] = k < from ? narrow[k] : k + 1 == to ? padding : 0.0;
  }
  return {};
}

}  // namespace subdivd::proto::gltf

#include "core/oracle/scale.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/mesh/creases.h"

namespace subdivd::oracle {

template <>
double value_tolerance<double>() {
  return 1e-12;
}
template <>
double value_tolerance<float>() {
  return 2e-6;
}
template <>
double normal_tolerance<double>() {
  return 0.01;
}
template <>
double normal_tolerance<float>() {
  return 0.5;
}
template <>
double face_varying_limit_tolerance<double>() {
  return 1e-7;
}
template <>
double face_varying_limit_tolerance<float>() {
  return 2e-6;
}

PointScale point_scale(std::span<const double> points, Index width, const Pace& pace) {
  if (width == 0 || points.size() < width) return {};
  std::vector<double> low(points.begin(), points.begin() + width), high = low;
  double largest = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    pace.spend(1);
    low[k % width] = std::min(low[k % width], points[k]);
    high[k % width] = std::max(high[k % width], points[k]);
    largest = std::max(largest, std::abs(points[k]));
  }
  if (!(largest > 0)) return {};
  double square = 0;  // of half the diagonal, in units of the largest: nothing overflows
  for (std::size_t k = 0; k < width; ++k) {
    const double half = high[k] / largest / 2 - low[k] / largest / 2;
    square += half * half;
  }
  const double diagonal = 2 * std::sqrt(square);
  if (!(diagonal > 0)) return {largest, 1};
  return {std::min(diagonal * largest, std::numeric_limits<double>::max()), std::max(1.0, 1 / diagonal)};
}

bool sharpness_rounds(const ControlMesh& mesh, const Pace& pace) {
  if (mesh.crease_lengths.empty()) return false;
  std::vector<Index> edges(mesh.point_count(),
                           0);  // semi-sharp ones at every point; named twice, counted twice
  for_each_crease_edge(mesh, [&](Count, Index a, Index b, float sharpness) {
    pace.spend(1);
    if (!(sharpness > 0) || sharpness >= kInfiniteSharpness) return;
    ++edges[a];
    ++edges[b];
  });
  return std::any_of(edges.begin(), edges.end(), [](Index count) { return count >= 3; });
}

}  // namespace subdivd::oracle

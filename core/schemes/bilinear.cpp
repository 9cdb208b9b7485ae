#include "core/schemes/bilinear.h"

#include <cmath>
#include <numbers>

namespace subdivd {
namespace {

using std::numbers::pi;

template <class F>
RingMask mask_of_edges(Index edges, Index faces, F&& f, const Pace& pace) {
  RingMask mask{0, std::vector<double>(edges), std::vector<double>(faces)};
  pace.for_each(edges, [&](Index k) { mask.edges[k] = f(k); });
  return mask;
}

}  // namespace

RingMask Bilinear::dart_limit_mask(Index n, const Pace& pace) {
  RingMask mask = mask_of_edges(
      n, n, [](Index) { return 0; }, pace);
  mask.self = 1;
  return mask;
}

RingMask Bilinear::smooth_tangent_u(Index n, const Pace& pace) {
  return mask_of_edges(
      n, n, [n](Index k) { return std::cos(2 * pi * k / n); }, pace);
}

RingMask Bilinear::smooth_tangent_v(Index n, const Pace& pace) {
  if (n == 2) return {0, {0, 0}, {1, -1}};
  return mask_of_edges(
      n, n, [n](Index k) { return std::sin(2 * pi * k / n); }, pace);
}

RingMask Bilinear::crease_tangent_across(Index m, const Pace& pace) {
  if (m == 1) return {-2, {1, 1}, {0}};
  RingMask mask = mask_of_edges(
      m + 1, m, [m](Index k) { return k == 0 || k == m ? 0 : std::sin(pi * k / m); }, pace);
  mask.self = -sum_of(mask);
  return mask;
}

}  // namespace subdivd

#include "core/curves/four_point.h"

#include <cstddef>

namespace subdivd {
namespace {

#include "core/curves/kernels/curve_rules.inc"

}  // namespace

bool is_four_point_tension(double w) { return w >= 0 && w < 1 && 32 * w * w * w + 4 * w < 1; }

CurveSplit four_point_split() { return {false, 2, 5}; }

LimitMasks four_point_limits(double w) {
  const double a = 1 / (2 * (1 - 4 * w));
  return {{1}, {0, a, -2 * w * a}, {2 * a, -4 * w * a}};
}

template <class Real>
void four_point_children(double w, Index width, const Real* __restrict self, Count scalars,
                         Real* __restrict first, Real* __restrict second) {
  const FourPointRule<Real> rule{static_cast<Real>(w)};
  const std::ptrdiff_t step = width;
  for (Count k = 0; k < scalars; ++k)
    rule([=](std::ptrdiff_t away) { return self[away * step + static_cast<std::ptrdiff_t>(k)]; }, first[k],
         second[k]);
}

template void four_point_children<float>(double, Index, const float*, Count, float*, float*);
template void four_point_children<double>(double, Index, const double*, Count, double*, double*);

}  // namespace subdivd

#include "core/curves/corner_cutting.h"

#include <cstddef>

namespace subdivd {
namespace {

#include "core/curves/kernels/curve_rules.inc"

}  // namespace

bool is_cutting_ratio(double r) { return r > 0 && r < 0.5; }

CurveSplit corner_cutting_split() { return {true, 1, 2}; }

LimitMasks corner_cutting_limits(double r) { return {{1 - r, r / 2}, {0, 2 * r}, {2}}; }

template <class Real>
void corner_cutting_children(double r, Index width, const Real* __restrict self, Count scalars,
                             Real* __restrict first, Real* __restrict second) {
  const CornerCuttingRule<Real> rule{static_cast<Real>(r), static_cast<Real>(1 - r)};
  const std::ptrdiff_t step = width;
  for (Count k = 0; k < scalars; ++k)
    rule([=](std::ptrdiff_t away) { return self[away * step + static_cast<std::ptrdiff_t>(k)]; }, first[k],
         second[k]);
}

template void corner_cutting_children<float>(double, Index, const float*, Count, float*, float*);
template void corner_cutting_children<double>(double, Index, const double*, Count, double*, double*);

}  // namespace subdivd

#include "core/curves/four_point.h"

#include <cstddef>
#include <string>

#include "core/curves/parameter_fault.h"

namespace subdivd {
namespace {

#include "core/curves/kernels/curve_rules.inc"

}  // namespace

bool is_four_point_tension(double w) { return w >= 0 && w < 1 && 32 * w * w * w + 4 * w < 1; }

Result<void> FourPoint::check() const {
  if (is_four_point_tension(tension)) return {};
  return parameter_fault("tension", tension, "at least 0 and below 0.192729");
}

std::string FourPoint::description() const { return "four-point curve"; }

CurveSplit FourPoint::split() const { return {.dual = false, .reach = 2, .lost = 5}; }

LimitMasks FourPoint::limit_masks() const {
  const double w = tension;
  const double a = 1 / (2 * (1 - 4 * w));
  return {{1}, {0, a, -2 * w * a}, {2 * a, -4 * w * a}};
}

template <class Real>
void FourPoint::children(Index width, const Real* __restrict self, Count scalars, Real* __restrict first,
                         Real* __restrict second) const {
  const FourPointRule<Real> rule{static_cast<Real>(tension)};
  const std::ptrdiff_t step = width;
  for (Count k = 0; k < scalars; ++k)
    rule([=](std::ptrdiff_t away) { return self[away * step + static_cast<std::ptrdiff_t>(k)]; }, first[k],
         second[k]);
}

template void FourPoint::children<float>(Index, const float*, Count, float*, float*) const;
template void FourPoint::children<double>(Index, const double*, Count, double*, double*) const;

}  // namespace subdivd

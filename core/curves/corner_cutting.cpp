#include "core/curves/corner_cutting.h"

#include <cstddef>
#include <string>

#include "core/curves/parameter_fault.h"

namespace subdivd {
namespace {

#include "core/curves/kernels/curve_rules.inc"

}  // namespace

bool is_cutting_ratio(double r) { return r > 0 && r < 0.5; }

Result<void> CornerCutting::check() const {
  if (is_cutting_ratio(ratio)) return {};
  return parameter_fault("ratio", ratio, "above 0 and below 0.5");
}

std::string CornerCutting::description() const { return "corner-cutting curve"; }

CurveSplit CornerCutting::split() const { return {.dual = true, .reach = 1, .lost = 2}; }

LimitMasks CornerCutting::limit_masks() const {
  return {.values = {1 - ratio, ratio / 2}, .slopes = {0, 2 * ratio}, .end_slopes = {2}};
}

template <class Real>
void CornerCutting::children(Index width, const Real* __restrict self, Count scalars, Real* __restrict first,
                             Real* __restrict second) const {
  const CornerCuttingRule<Real> rule{static_cast<Real>(ratio), static_cast<Real>(1 - ratio)};
  const std::ptrdiff_t step = width;
  for (Count k = 0; k < scalars; ++k)
    rule([=](std::ptrdiff_t away) { return self[away * step + static_cast<std::ptrdiff_t>(k)]; }, first[k],
         second[k]);
}

template void CornerCutting::children<float>(Index, const float*, Count, float*, float*) const;
template void CornerCutting::children<double>(Index, const double*, Count, double*, double*) const;

}  // namespace subdivd

#include "core/curves/corner_cutting.h"

#include <cstddef>

namespace subdivd {

bool is_cutting_ratio(double r) { return r > 0 && r < 0.5; }

CurveSplit corner_cutting_split() { return {true, 1, 2}; }

LimitMasks corner_cutting_limits(double r) { return {{1 - r, r / 2}, {0, 2 * r}, {2}}; }

template <class Real>
void corner_cutting_children(double r, Index width, const Real* __restrict self, Count scalars,
                             Real* __restrict first, Real* __restrict second) {
  const Real far = static_cast<Real>(r), near = static_cast<Real>(1 - r);
  const std::ptrdiff_t step = width;
  for (Count k = 0; k < scalars; ++k) {
    const Real* c = self + k;
    first[k] = c[-step] * far + c[0] * near;
    second[k] = c[step] * far + c[0] * near;
  }
}

template void corner_cutting_children<float>(double, Index, const float*, Count, float*, float*);
template void corner_cutting_children<double>(double, Index, const double*, Count, double*, double*);

}  // namespace subdivd

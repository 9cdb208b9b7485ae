#include <type_traits>

#include "core/engine/grid/kernels/instruction_sets.h"
#include "core/engine/quad_grid/kernels/quad_step.h"

namespace subdivd::kernels {

#define SUBDIVD_DECLARE(set)                    \
  namespace set {                               \
  extern const QuadKernels<float> kQuadFloat;   \
  extern const QuadKernels<double> kQuadDouble; \
  }
SUBDIVD_DECLARE(baseline)
#ifdef SUBDIVD_NEWER_KERNELS
SUBDIVD_DECLARE(avx2)
SUBDIVD_DECLARE(avx512)
#endif
#undef SUBDIVD_DECLARE

namespace {

template <class Real>
const QuadKernels<Real>* choose(int set) {
  const auto pick = [](const QuadKernels<float>& f,
                       const QuadKernels<double>& d) -> const QuadKernels<Real>* {
    if constexpr (std::is_same_v<Real, float>)
      return &f;
    else
      return &d;
  };
#ifdef SUBDIVD_NEWER_KERNELS
  if (set == 2) return pick(avx512::kQuadFloat, avx512::kQuadDouble);
  if (set == 1) return pick(avx2::kQuadFloat, avx2::kQuadDouble);
#endif
  (void)set;
  return pick(baseline::kQuadFloat, baseline::kQuadDouble);
}

}  // namespace

template <class Real>
const QuadKernels<Real>& quad_kernels() {
  return *choose<Real>(instruction_set());
}

template const QuadKernels<float>& quad_kernels<float>();
template const QuadKernels<double>& quad_kernels<double>();

}  // namespace subdivd::kernels

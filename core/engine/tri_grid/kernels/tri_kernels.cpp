#include <type_traits>

#include "core/engine/grid/kernels/instruction_sets.h"
#include "core/engine/tri_grid/kernels/tri_step.h"

namespace subdivd::kernels {

#define SUBDIVD_DECLARE(set)               \
  namespace set {                          \
  extern const TriKernels<float> kFloat;   \
  extern const TriKernels<double> kDouble; \
  }
SUBDIVD_DECLARE(baseline)
#ifdef SUBDIVD_NEWER_KERNELS
SUBDIVD_DECLARE(avx2)
SUBDIVD_DECLARE(avx512)
#endif
#undef SUBDIVD_DECLARE

namespace {

template <class Real>
const TriKernels<Real>* choose(int set) {
  const auto pick = [](const TriKernels<float>& f, const TriKernels<double>& d) -> const TriKernels<Real>* {
    if constexpr (std::is_same_v<Real, float>)
      return &f;
    else
      return &d;
  };
#ifdef SUBDIVD_NEWER_KERNELS
  if (set == 2) return pick(avx512::kFloat, avx512::kDouble);
  if (set == 1) return pick(avx2::kFloat, avx2::kDouble);
#endif
  (void)set;
  return pick(baseline::kFloat, baseline::kDouble);
}

}  // namespace

template <class Real>
const TriKernels<Real>& tri_kernels() {
  return *choose<Real>(instruction_set());
}

template const TriKernels<float>& tri_kernels<float>();
template const TriKernels<double>& tri_kernels<double>();

}  // namespace subdivd::kernels

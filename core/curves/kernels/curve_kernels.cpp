#include "core/curves/kernels/curve_kernels.h"

#include <atomic>
#include <type_traits>

namespace subdivd::kernels {

namespace curves_baseline {
extern const CurveKernels<float> kFloat;
extern const CurveKernels<double> kDouble;
}  // namespace curves_baseline
namespace curves_avx2 {
extern const CurveKernels<float> kFloat;
extern const CurveKernels<double> kDouble;
}  // namespace curves_avx2

namespace {

std::atomic<int> forced{-1};

template <class Real>
const CurveKernels<Real>& pick(const CurveKernels<float>& of_float, const CurveKernels<double>& of_double) {
  if constexpr (std::is_same_v<Real, float>)
    return of_float;
  else
    return of_double;
}

}  // namespace

bool has_curve_instruction_set(int set) {
#ifdef SUBDIVD_NEWER_CURVE_KERNELS
  if (set == 1) return __builtin_cpu_supports("avx2") != 0;
#endif
  return set == 0;
}

void force_curve_instruction_set(int set) { forced.store(set, std::memory_order_relaxed); }

template <class Real>
const CurveKernels<Real>& curve_kernels() {
#ifdef SUBDIVD_NEWER_CURVE_KERNELS
  const int set = forced.load(std::memory_order_relaxed);
  if (set < 0 ? has_curve_instruction_set(1) : set == 1)
    return pick<Real>(curves_avx2::kFloat, curves_avx2::kDouble);
#endif
  return pick<Real>(curves_baseline::kFloat, curves_baseline::kDouble);
}

template const CurveKernels<float>& curve_kernels<float>();
template const CurveKernels<double>& curve_kernels<double>();

}  // namespace subdivd::kernels

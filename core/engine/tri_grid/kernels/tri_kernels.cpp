#include <atomic>
#include <type_traits>

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

std::atomic<int> forced{-1};

int best() {
  int set = kInstructionSets - 1;
  while (!has_instruction_set(set)) --set;
  return set;
}

}  // namespace

bool has_instruction_set(int set) {
#ifdef SUBDIVD_NEWER_KERNELS
  if (set == 2)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  if (set == 1) return __builtin_cpu_supports("avx2") != 0;
#endif
  return set == 0;
}

void force_instruction_set(int set) { forced.store(set, std::memory_order_relaxed); }

template <class Real>
const TriKernels<Real>& tri_kernels() {
  static const int kBest = best();
  const int set = forced.load(std::memory_order_relaxed);
  return *choose<Real>(set < 0 ? kBest : set);
}

template const TriKernels<float>& tri_kernels<float>();
template const TriKernels<double>& tri_kernels<double>();

}  // namespace subdivd::kernels

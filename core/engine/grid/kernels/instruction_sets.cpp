#include "core/engine/grid/kernels/instruction_sets.h"

#include <atomic>

namespace subdivd::kernels {
namespace {

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

int instruction_set() {
  static const int kBest = best();
  const int set = forced.load(std::memory_order_relaxed);
  return set < 0 ? kBest : set;
}

void force_instruction_set(int set) { forced.store(set, std::memory_order_relaxed); }

}  // namespace subdivd::kernels

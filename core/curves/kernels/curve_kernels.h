#pragma once
// One step of a curve's scheme as its inner loop sees it: bare pointers, so that the same loop can be
// compiled for several instruction sets without sharing a single inline function with the rest of the
// program.

#include "core/base/index.h"

namespace subdivd::kernels {

// Both children of `points` consecutive points from `self` on, in turn, into `to`: 2 points * width scalars.
// Neighbours within the scheme's reach can be read too; `to` does not overlap them. `parameter`: tension or
// ratio, not rounded to Real yet.
template <class Real>
using SplitPoints = void (*)(double parameter, const Real* self, Count points, Real* to);

inline constexpr Index kKernelWidth = 4, kKernelDegree = 5;

// The loops for one instruction set; index w - 1 holds those for w scalars per point, 1 to kKernelWidth.
template <class Real>
struct CurveKernels {
  SplitPoints<Real> lane_riesenfeld[kKernelDegree][kKernelWidth];  // of degree p at p - 1
  SplitPoints<Real> four_point[kKernelWidth], corner_cutting[kKernelWidth];
};

// Those for this processor, or for what force_curve_instruction_set chose.
template <class Real>
const CurveKernels<Real>& curve_kernels();

// Instruction sets: 0 what every processor has, 1 AVX2.
inline constexpr int kCurveInstructionSets = 2;
bool has_curve_instruction_set(int set);
// For tests: the answer must not depend on it. -1: the best.
void force_curve_instruction_set(int set);

}  // namespace subdivd::kernels

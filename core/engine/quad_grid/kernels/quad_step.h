#pragma once
// One step of the engine as its inner loops see it.

#include "core/base/index.h"
#include "core/engine/grid/kernels/step.h"

namespace subdivd::kernels {

// Weights of rings that are regular and settled. Regular masks are products: what a row of points makes of itself
// along its direction, and then the columns across it.
template <class Real>
struct QuadMasks {
  Real self, side;                // smooth vertex point of a row
  Real middle;                    // edge point of a row: of either end
  Real crease_self, crease_side;  // vertex point along a crease
};

template <class Real>
struct QuadStep : GridStep<Real> {
  QuadMasks<Real> masks;
};

// The limit surface at the values of one level.
template <class Real>
struct QuadLimit {
  QuadStep<Real> level;  // `from`, n: the level; `to`: where limits go, may be null
  Real self, side;       // limit of a row, whose product the limit mask is
  // Tangents: along a row the difference of the points beside, and across it these weights.
  Real tangent_self, tangent_side;
  // Per valence up to kListedValence: limit weights as in vertex_masks; and kListedValence times four tangent
  // weights: of the neighbour on edge k in the two tangents, of the opposite in face k.
  const Real *vertex_masks, *vertex_tangents;
  FrameOutput<Real> frames;
};

inline constexpr Count quad_row_stride(Count n) { return 4 * (2 * n + 6); }
// Scalars of a step's scratch.
inline constexpr Count quad_row_scratch(Count n) { return 16 * quad_row_stride(n) + 64; }

template <class Real>
using QuadKernels = GridKernels<QuadStep<Real>, QuadLimit<Real>>;

// Those for this processor, or for what force_instruction_set chose.
template <class Real>
const QuadKernels<Real>& quad_kernels();
template <>
const QuadKernels<float>& quad_kernels();
template <>
const QuadKernels<double>& quad_kernels();

}  // namespace subdivd::kernels

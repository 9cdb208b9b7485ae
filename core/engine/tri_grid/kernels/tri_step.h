#pragma once
// One step of the engine as its inner loops see it.

#include "core/base/index.h"
#include "core/engine/grid/kernels/step.h"

namespace subdivd::kernels {

// Weights of rings that are regular and settled.
template <class Real>
struct TriMasks {
  Real vertex_self, vertex_each;              // smooth vertex point, valence 6
  Real edge_end, edge_opposite;               // smooth edge point
  Real crease_self, crease_end, crease_edge;  // crease: vertex point, and its edge point
};

template <class Real>
struct TriStep : GridStep<Real> {
  TriMasks<Real> masks;
};

// The limit surface at the values of one level.
template <class Real>
struct TriLimit {
  TriStep<Real> level;  // `from`, n: the level; `to`: where limits go, may be null
  Real self, each;      // limit mask, valence 6
  // Per valence up to kListedValence: limit weight of a smooth vertex, of each neighbour; and kListedValence
  // pairs of the neighbours' weights in the two tangents.
  const Real *vertex_masks, *vertex_tangents;
  FrameOutput<Real> frames;
};

inline constexpr Count row_stride(Count n) { return 4 * (n + 4); }
// Scalars of a step's scratch.
inline constexpr Count row_scratch(Count n) { return 6 * row_stride(n) + 16; }

template <class Real>
using TriKernels = GridKernels<TriStep<Real>, TriLimit<Real>>;
// Those for this processor, or for what force_instruction_set chose.
template <class Real>
const TriKernels<Real>& tri_kernels();
template <>
const TriKernels<float>& tri_kernels();
template <>
const TriKernels<double>& tri_kernels();

}  // namespace subdivd::kernels

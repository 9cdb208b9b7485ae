#pragma once
// One step of the engine as its inner loops see it: bare pointers, so that the same loops can be compiled for
// several instruction sets without sharing a single inline function with the rest of the program.

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

// From level `from` (n segments per base edge) to the next; both arrays in the closed-form numbering
// (split.h), `width` scalars per value. A kernel takes 1 to 4 of them: `from` and `to` point to the first.
template <class Real>
struct TriStep {
  const Index* triangles;        // 3 per face
  const Index* half_edge_edges;  // 3 per face
  const Index* edge_vertices;    // 2 per edge, the lower first
  const Index* edge_sides;       // 2 per edge: the half-edge that runs from the lower end, and the other
  const unsigned char* edge_rules;
  const Index *vertex_edges, *vertex_edge_offsets;  // rows of edges, one per vertex
  const unsigned char* vertex_rules;
  const Real* vertex_masks;  // per valence up to kListedValence: weight of the vertex, of each neighbour
  Index vertex_count, edge_count, face_count;
  Count n;
  Index width;
  const Real* from;  // a step may read 3 scalars past its end, a limit may not
  Real* to;
  TriMasks<Real> masks;
  Real* rows;  // scratch of row_scratch(n) scalars
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
inline constexpr Count row_scratch(Count n) { return 6 * row_stride(n) + 16; }

template <class Real>
using TriKernels = GridKernels<TriStep<Real>, TriLimit<Real>>;
// Those for this processor, or for what force_instruction_set chose.
template <class Real>
const TriKernels<Real>& tri_kernels();

}  // namespace subdivd::kernels

#pragma once
// One step of the engine as its inner loops see it: bare pointers, so that the same loops can be compiled for
// several instruction sets without sharing a single inline function with the rest of the program.

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

// From level `from` (n segments per base edge) to the next; both arrays in the closed-form numbering
// (quads.h), `width` scalars per value. A kernel takes 1 to 4 of them: `from` and `to` point to the first.
template <class Real>
struct QuadStep {
  const Index* corners;          // 4 per face
  const Index* half_edge_edges;  // 4 per face
  const Index* edge_vertices;    // 2 per edge, the lower first
  const Index* edge_sides;       // 2 per edge: the half-edge that runs from the lower end, and the other
  const unsigned char* edge_rules;
  const Index *vertex_edges, *vertex_edge_offsets;      // rows of edges, one per vertex
  const Index *vertex_corners, *vertex_corner_offsets;  // rows of corners, likewise
  const unsigned char* vertex_rules;
  // Per valence up to kListedValence: weight of the vertex, of each neighbour on an edge, of each opposite in a face.
  const Real* vertex_masks;
  Index vertex_count, edge_count, face_count;
  Count n;
  Index width;
  const Real* from;  // a step may read 3 scalars past its end, a limit may not
  Real* to;
  QuadMasks<Real> masks;
  Real* rows;  // scratch of quad_row_scratch(n) scalars
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
inline constexpr Count quad_row_scratch(Count n) { return 16 * quad_row_stride(n) + 64; }

template <class Real>
using QuadKernels = GridKernels<QuadStep<Real>, QuadLimit<Real>>;

// Those for this processor, or for what force_instruction_set chose.
template <class Real>
const QuadKernels<Real>& quad_kernels();

}  // namespace subdivd::kernels

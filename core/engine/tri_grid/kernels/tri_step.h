#pragma once
// One step of the engine as its inner loops see it: bare pointers, so that the same loops can be compiled for
// several instruction sets without sharing a single inline function with the rest of the program.

#include "core/base/index.h"

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
  Real *tangents_u, *tangents_v, *normals;  // may be null
  // Sets the frame of a vertex whose tangents are too close to parallel, too long or too short for the short
  // way. `context` is handed through.
  void (*robust_frame)(const void* context, Count vertex, Real* u, Real* v, Real* normal);
  const void* context;
};

// Rows [row, ...) of the faces from `face` on.
struct FaceRow {
  Index face = 0;
  Count row = 0;
};

inline constexpr Count row_stride(Count n) { return 4 * (n + 4); }
inline constexpr Count row_scratch(Count n) { return 6 * row_stride(n) + 16; }

inline constexpr Index kListedValence = 64;

// The loops for one instruction set; index K - 1 holds those for K scalars, 1 to 4.
template <class Real>
struct TriKernels {
  const char* name;
  // Those of the base vertices [begin, end) that are smooth or darts and of a listed valence; the others are
  // left alone.
  void (*refine_vertices[4])(const TriStep<Real>&, Index begin, Index end);
  // The points inside base edges [begin, end), by their settled rules.
  void (*refine_edges[4])(const TriStep<Real>&, Index begin, Index end);
  // The points inside faces that stem from the coarse rows [begin, end).
  void (*refine_faces[4])(const TriStep<Real>&, FaceRow begin, FaceRow end);
  // Limits of the base vertices [begin, end) that are smooth and of a listed valence; the others are left
  // alone.
  void (*limit_vertices[4])(const TriLimit<Real>&, Index begin, Index end);
  // Limits of the points inside faces; rows are those of the level itself, 1 to n - 2.
  void (*limit_faces[4])(const TriLimit<Real>&, FaceRow begin, FaceRow end);
  // Limits of the points inside smooth edges; other edges are left alone.
  void (*limit_edges[4])(const TriLimit<Real>&, Index begin, Index end);
};

// Those for this processor, or for what force_instruction_set chose.
template <class Real>
const TriKernels<Real>& tri_kernels();

// Names of the instruction sets that this processor has, "baseline" first, best last.
inline constexpr int kInstructionSets = 3;
bool has_instruction_set(int set);
// For tests: the answer must not depend on it. -1: the best.
void force_instruction_set(int set);

}  // namespace subdivd::kernels

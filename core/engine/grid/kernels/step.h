#pragma once
// What the steps of all grids share, as inner loops see it: bare pointers, so that the same loops can be compiled for
// several instruction sets without sharing a single inline function with the rest of the program.

#include "core/base/index.h"

namespace subdivd::kernels {

// Tables of masks hold vertices of so many edges at most; core/engine/net.h has the same number.
inline constexpr Index kListedValence = 64;

// From level `from` (n segments per base edge) to the next; both arrays in the closed-form numbering (core/lattice),
// `width` scalars per value. A kernel takes 1 to 4 of them: `from` and `to` point to the first.
template <class Real>
struct GridStep {
  const Index* corners;          // vertices, face after face
  const Index* half_edge_edges;  // one per corner
  const Index* edge_vertices;    // 2 per edge, the lower first
  const Index* edge_sides;       // 2 per edge: the half-edge that runs from the lower end, and the other
  const unsigned char* edge_rules;
  const Index *vertex_edges, *vertex_edge_offsets;      // rows of edges, one per vertex
  const Index *vertex_corners, *vertex_corner_offsets;  // rows of corners, likewise
  const unsigned char* vertex_rules;
  // Per valence up to kListedValence: weight of the vertex, of each neighbour on an edge, and where faces are quads of
  // each vertex opposite in one.
  const Real* vertex_masks;
  Index vertex_count, edge_count, face_count;
  Count n;
  Index width;
  const Real* from;  // a step may read 3 scalars past its end, a limit may not
  Real* to;
  Real* rows;  // scratch, as much as the engine says
};

// Rows [row, ...) of the faces from `face` on.
struct FaceRow {
  Index face = 0;
  Count row = 0;
};

// Where the frames of a level's points go.
template <class Real>
struct FrameOutput {
  Real *tangents_u, *tangents_v, *normals;  // may be null
  // Sets the frame of a vertex whose tangents are too close to parallel, too long or too short for the short
  // way. `context` is handed through.
  void (*robust_frame)(const void* context, Count vertex, Real* u, Real* v, Real* normal);
  const void* context;
};

// The loops for one instruction set; index K - 1 holds those for K scalars, 1 to 4.
template <class Step, class Limit>
struct GridKernels {
  const char* name;
  // Those of the base vertices [begin, end) that are smooth or darts and of a listed valence; the others are
  // left alone.
  void (*refine_vertices[4])(const Step&, Index begin, Index end);
  // The points inside base edges [begin, end), by their settled rules.
  void (*refine_edges[4])(const Step&, Index begin, Index end);
  // The points inside faces that stem from the coarse rows [begin, end).
  void (*refine_faces[4])(const Step&, FaceRow begin, FaceRow end);
  // Limits of the base vertices [begin, end) that are smooth and of a listed valence; the others are left
  // alone.
  void (*limit_vertices[4])(const Limit&, Index begin, Index end);
  // Limits of the points inside faces; rows are those of the level itself, from 1 on.
  void (*limit_faces[4])(const Limit&, FaceRow begin, FaceRow end);
  // Limits of the points inside smooth edges; other edges are left alone.
  void (*limit_edges[4])(const Limit&, Index begin, Index end);
};

}  // namespace subdivd::kernels

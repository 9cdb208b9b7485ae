#pragma once
// Where on the control mesh a refined vertex or triangle lies, by formula alone.

#include <span>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/mesh/connectivity.h"

namespace subdivd {

// A point of a base triangle (v0, v1, v2): v0 + u (v1 - v0) + v (v2 - v0), with u = i/n, v = j/n.
struct Provenance {
  Index face = kNoIndex;  // the lowest-numbered base face that holds the vertex; kNoIndex: unreferenced point
  Index i = 0, j = 0;
};

// Of every refined vertex in turn: Numbering(connectivity, level).vertex_count() places into `out`.
void write_provenance(const Connectivity<Triangles>& connectivity, Index level, std::span<Provenance> out,
                      const Pace& pace);

// The base face of every refined triangle in turn, in the order of write_triangles: n^2 numbers for each face
// whose `holes` flag is 0 into `out`.
void write_triangle_faces(Index level, std::span<const unsigned char> holes, Index* out, const Pace& pace);

}  // namespace subdivd

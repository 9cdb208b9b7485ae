#pragma once
// The number of every refined vertex from its place on a base face: see split.h for the formula.

#include "core/base/index.h"
#include "core/mesh/topology.h"
#include "core/refine/split.h"

namespace subdivd {

class Numbering {
 public:
  Numbering(const Topology& topology, Index level)
      : topology_(&topology),
        n_(segments(level)),
        edge_begin_(topology.vertex_count()),
        face_begin_(edge_begin_ + topology.edge_count() * (n_ - 1)) {}

  Count segment_count() const { return n_; }
  Count vertex_count() const { return face_begin_ + topology_->face_count() * inner_points(n_); }

  // Vertex at grid point (i, j) of `face`; faces that share an edge agree about the points on it.
  Index vertex(Index face, Count i, Count j) const {
    const Count n = n_;
    if (j == 0) return on_edge(face, 0, i);
    if (i + j == n) return on_edge(face, 1, j);
    if (i == 0) return on_edge(face, 2, n - j);
    return static_cast<Index>(face_begin_ + face * inner_points(n) + inner_index(n, i, j));
  }

 private:
  // The point `k` segments from corner `corner` towards the next corner.
  Index on_edge(Index face, Index corner, Count k) const {
    const Index h = 3 * face + corner;
    if (k == 0) return topology_->corner_vertex(h);
    if (k == n_) return topology_->corner_vertex(Topology::next(h));
    const Index e = topology_->half_edge_edge(h);
    const Count from_low = topology_->edge_vertices(e)[0] == topology_->corner_vertex(h) ? k : n_ - k;
    return static_cast<Index>(edge_begin_ + e * (n_ - 1) + from_low - 1);
  }

  const Topology* topology_;
  Count n_, edge_begin_, face_begin_;
};

// Calls f(i0, j0, i1, j1, i2, j2) for the corners of all n^2 triangles of a face, in their order.
template <class F>
void for_each_triangle(Count n, F&& f) {
  for (Count j = 0; j < n; ++j)
    for (Count i = 0; i + j < n; ++i) {
      f(i, j, i + 1, j, i, j + 1);
      if (i + j + 1 < n) f(i + 1, j, i + 1, j + 1, i, j + 1);
    }
}

}  // namespace subdivd

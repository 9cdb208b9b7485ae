#pragma once
// The faces of a mesh of any kind and the edges between them: all that the indices of a refined mesh follow
// from. What touches a vertex stands in topology.h, and what half-edges are in faces.h.

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/mesh/edges.h"
#include "core/mesh/faces.h"

namespace subdivd {

// Instantiated for Triangles, Quads and Polygons.
template <class Faces>
class Connectivity {
 public:
  Connectivity() = default;
  // The faces' vertices are each < vertex_count, no face repeating one (assumed). Edges are numbered by
  // find_edges(). Takes time and memory for the faces alone: there may be far more vertices.
  Connectivity(Index vertex_count, Faces faces, const Pace& pace = {});

  Index vertex_count() const { return vertex_count_; }
  Index edge_count() const { return edges_.count(); }
  Index face_count() const { return faces_.count(); }

  const Faces& faces() const { return faces_; }
  std::span<const Index> corner_vertices() const { return faces_.corners(); }
  std::span<const Index> half_edge_edges() const { return edges_.of_half_edges; }
  std::span<const std::array<Index, 2>> edge_vertices() const { return edges_.vertices; }
  // Per edge the half-edge that runs from its lower end, and the other; kNoIndex: none.
  std::span<const std::array<Index, 2>> edge_sides() const { return edges_.sides; }
  Index corner_vertex(Index h) const { return faces_.corners()[h]; }
  Index half_edge_edge(Index h) const { return edges_.of_half_edges[h]; }
  // The two ends, the lower-numbered first.
  std::array<Index, 2> edge_vertices(Index e) const { return edges_.vertices[e]; }
  Index other_end(Index e, Index v) const {
    return edges_.vertices[e][0] == v ? edges_.vertices[e][1] : edges_.vertices[e][0];
  }

  std::span<const EdgeKind> edge_kinds() const { return edges_.kinds; }
  bool is_boundary(Index e) const { return edges_.kinds[e] == EdgeKind::border; }
  // More than two faces, or two that run along the edge in the same direction (their windings clash).
  bool is_non_manifold_edge(Index e) const { return edges_.kinds[e] == EdgeKind::non_manifold; }

  // The half-edge on the other side of h, leaving the vertex that h enters; kNoIndex at a boundary or
  // non-manifold edge.
  Index mate(Index h) const {
    const Index e = edges_.of_half_edges[h];
    return edges_.kinds[e] == EdgeKind::manifold ? across(e, h) : kNoIndex;
  }

  Index next(Index h) const { return faces_.next(h); }
  Index prev(Index h) const { return faces_.prev(h); }

 protected:
  // The edges are for the heir to find.
  struct WithoutEdges {};
  Connectivity(WithoutEdges, Index vertex_count, Faces faces)
      : vertex_count_(vertex_count), faces_(std::move(faces)) {}

  // The other of two half-edges along e; kNoIndex at a border.
  Index across(Index e, Index h) const { return edges_.sides[e][0] ^ edges_.sides[e][1] ^ h; }

  Index vertex_count_ = 0;
  Faces faces_;
  Edges edges_;
};

extern template class Connectivity<Triangles>;
extern template class Connectivity<Quads>;
extern template class Connectivity<Polygons>;

}  // namespace subdivd

#pragma once
// The faces of a triangle mesh of any kind and the edges between them: all that the indices of a refined mesh
// follow from. What touches a vertex stands in topology.h.
//
// A half-edge h = 3 f + k runs from corner k to corner k + 1 of face f; the same number names the corner of
// face f that it leaves, whose vertex is triangles()[h].
//
//          v2          next(h): the following half-edge of the face
//         /  ^         prev(h): the one before
//     h+2/    \h+1
//       v  h   \       Around v0 counter-clockwise: the face lies between the edge of h and the edge of
//     v0 -----> v1     prev(h); the next face around v0 lies across the edge of prev(h).

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/mesh/edges.h"

namespace subdivd {

class Connectivity {
 public:
  Connectivity() = default;
  // `triangles`: 3 vertex indices per face, each < vertex_count, no face repeating a vertex (assumed). Edges
  // are numbered by find_edges(). Takes time and memory for the faces alone: there may be far more vertices.
  Connectivity(Index vertex_count, std::vector<Index> triangles, const Pace& pace = {});

  Index vertex_count() const { return vertex_count_; }
  Index edge_count() const { return edges_.count(); }
  Index face_count() const { return static_cast<Index>(triangles_.size() / 3); }

  std::span<const Index> triangles() const { return triangles_; }
  std::span<const Index> half_edge_edges() const { return edges_.of_half_edges; }
  std::span<const std::array<Index, 2>> edge_vertices() const { return edges_.vertices; }
  // Per edge the half-edge that runs from its lower end, and the other; kNoIndex: none.
  std::span<const std::array<Index, 2>> edge_sides() const { return edges_.sides; }
  Index corner_vertex(Index h) const { return triangles_[h]; }
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

  // Branch-free: which corner of its face it is cannot be predicted.
  static Index next(Index h) { return h + 1 - 3 * static_cast<Index>(h % 3 == 2); }
  static Index prev(Index h) { return h - 1 + 3 * static_cast<Index>(h % 3 == 0); }

 protected:
  // The edges are for the heir to find.
  struct WithoutEdges {};
  Connectivity(WithoutEdges, Index vertex_count, std::vector<Index> triangles)
      : vertex_count_(vertex_count), triangles_(std::move(triangles)) {}

  // The other of two half-edges along e; kNoIndex at a border.
  Index across(Index e, Index h) const { return edges_.sides[e][0] ^ edges_.sides[e][1] ^ h; }

  Index vertex_count_ = 0;
  std::vector<Index> triangles_;
  Edges edges_;
};

}  // namespace subdivd

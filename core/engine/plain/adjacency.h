#pragma once
// What touches what in a mesh of faces of any sizes, manifold or not; core/mesh/faces.h says what half-edges
// are. Everything is sorted and nothing else, so that it can be trusted: the witness of core/mesh/topology.h.

#include <array>
#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/mesh/faces.h"
#include "core/mesh/topology.h"

namespace subdivd::plain {

class Adjacency {
 public:
  Adjacency() = default;
  // The faces' vertices are each < vertex_count, no face repeating one (assumed). Edges are numbered in the
  // order in which the faces, corner by corner, first run along them. Linear time, no hashing.
  Adjacency(Index vertex_count, Polygons faces, const Pace& pace = {});
  // The same with the edge of every half-edge and every edge's ends as given, the lower-numbered first: two
  // faces over the same points refine to edges that share their ends and are not the same.
  Adjacency(Index vertex_count, Polygons faces, std::vector<Index> half_edge_edges,
            std::vector<std::array<Index, 2>> edge_vertices, const Pace& pace = {});

  Index vertex_count() const { return vertex_count_; }
  Index edge_count() const { return static_cast<Index>(edge_vertices_.size()); }
  Index face_count() const { return faces_.count(); }
  Index half_edge_count() const { return static_cast<Index>(faces_.corners().size()); }

  Index face_begin(Index f) const { return faces_.begin(f); }
  Index face_size(Index f) const { return faces_.begin(f + 1) - faces_.begin(f); }
  Index face_of(Index h) const { return faces_.face_of(h); }
  Index next(Index h) const { return faces_.next(h); }
  Index prev(Index h) const { return faces_.prev(h); }
  Index corner_vertex(Index h) const { return faces_.corners()[h]; }
  std::span<const Index> corners() const { return faces_.corners(); }
  Index half_edge_edge(Index h) const { return half_edge_edges_[h]; }
  std::span<const Index> half_edge_edges() const { return half_edge_edges_; }
  std::array<Index, 2> edge_vertices(Index e) const { return edge_vertices_[e]; }  // the lower-numbered first
  std::span<const std::array<Index, 2>> edge_vertices() const { return edge_vertices_; }
  Index other_end(Index e, Index v) const { return edge_vertices_[e][edge_vertices_[e][0] == v ? 1 : 0]; }

  // Ascending.
  std::span<const Index> edge_half_edges(Index e) const { return row(edge_half_edges_, edge_offsets_, e); }
  // Where the faces at v are one fan, counter-clockwise: a closed fan from the edge of its lowest corner on,
  // an open one from its border. Elsewhere ascending.
  std::span<const Index> vertex_edges(Index v) const { return row(vertex_edges_, vertex_edge_offsets_, v); }
  // Ascending.
  std::span<const Index> vertex_corners(Index v) const {
    return row(vertex_corners_, vertex_corner_offsets_, v);
  }
  // The half-edge that runs along the same edge in the other direction; kNoIndex where there is none, or
  // more than one face beside h's own.
  Index mate(Index h) const;

 private:
  static std::span<const Index> row(const std::vector<Index>& items, const std::vector<Index>& offsets,
                                    Index k) {
    return std::span(items).subspan(offsets[k], offsets[k + 1] - offsets[k]);
  }
  void find_edges(const Pace& pace);
  void connect(const Pace& pace);
  void order_edges(const Pace& pace);
  bool order_fan(Index v, std::vector<Index>& edges, const Pace& pace) const;

  Index vertex_count_ = 0;
  Polygons faces_;
  std::vector<Index> half_edge_edges_;
  std::vector<std::array<Index, 2>> edge_vertices_;
  std::vector<Index> edge_half_edges_, edge_offsets_ = {0}, vertex_edges_, vertex_edge_offsets_ = {0},
                                       vertex_corners_, vertex_corner_offsets_ = {0};
};

// Of a control mesh, or a channel: the same faces and edges under the same numbers. Instantiated for Triangles, Quads and
// Polygons.
template <class Faces>
Adjacency adjacency_of(const Topology<Faces>& topology, const Pace& pace);

}  // namespace subdivd::plain

#pragma once
// The faces of a mesh, of any number of corners each, and what touches what; manifold or not. Faces of
// different size may stand side by side.
//
// A half-edge h is a corner of a face as well: it runs from that corner to the next one of its face. Those of
// face f are numbered face_begin(f) to face_begin(f + 1) - 1, counter-clockwise.

#include <array>
#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"

namespace subdivd::plain {

class Polygons {
 public:
  Polygons() = default;
  // `face_offsets`: where the corners of each face begin in `corners`, and behind them the number of all.
  // `corners`: vertices, each < vertex_count, no face repeating one (assumed). Edges are numbered in the order
  // in which the faces, corner by corner, first run along them. Linear time, no hashing.
  Polygons(Index vertex_count, std::vector<Index> face_offsets, std::vector<Index> corners,
           const Pace& pace = {});
  // The same with the edge of every half-edge and every edge's ends as given, the lower-numbered first: two
  // faces over the same points refine to edges that share their ends and are not the same.
  Polygons(Index vertex_count, std::vector<Index> face_offsets, std::vector<Index> corners,
           std::vector<Index> half_edge_edges, std::vector<std::array<Index, 2>> edge_vertices,
           const Pace& pace = {});

  Index vertex_count() const { return vertex_count_; }
  Index edge_count() const { return static_cast<Index>(edge_vertices_.size()); }
  Index face_count() const { return static_cast<Index>(face_offsets_.size() - 1); }
  Index half_edge_count() const { return static_cast<Index>(corners_.size()); }

  Index face_begin(Index f) const { return face_offsets_[f]; }
  Index face_size(Index f) const { return face_offsets_[f + 1] - face_offsets_[f]; }
  Index face_of(Index h) const { return faces_[h]; }
  Index next(Index h) const {
    return h + 1 == face_offsets_[faces_[h] + 1] ? face_offsets_[faces_[h]] : h + 1;
  }
  Index prev(Index h) const {
    return h == face_offsets_[faces_[h]] ? face_offsets_[faces_[h] + 1] - 1 : h - 1;
  }
  Index corner_vertex(Index h) const { return corners_[h]; }
  std::span<const Index> corners() const { return corners_; }
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
  void list_faces(const Pace& pace);
  void find_edges(const Pace& pace);
  void connect(const Pace& pace);
  void order_edges(const Pace& pace);
  bool order_fan(Index v, std::vector<Index>& edges, const Pace& pace) const;

  Index vertex_count_ = 0;
  std::vector<Index> face_offsets_ = {0}, corners_, faces_, half_edge_edges_;
  std::vector<std::array<Index, 2>> edge_vertices_;
  std::vector<Index> edge_half_edges_, edge_offsets_ = {0}, vertex_edges_, vertex_edge_offsets_ = {0},
                                       vertex_corners_, vertex_corner_offsets_ = {0};
};

}  // namespace subdivd::plain

#pragma once
// Edges and adjacency of a triangle mesh of any kind, manifold or not. The only code that knows half-edges.
//
// A half-edge h = 3 f + k runs from corner k to corner k + 1 of face f; the same number names the corner of
// face f that it leaves, whose vertex is triangles()[h].
//
//          v2          next(h): the following half-edge of the face
//         /  ^         prev(h): the one before
//     h+2/    \h+1
//       v  h   \       Around v0 counter-clockwise: the face lies between the edge of h and the edge of
//     v0 -----> v1     prev(h); the next face around v0 lies across the edge of prev(h).

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/base/budget.h"
#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/result.h"

namespace subdivd {

class Topology {
 public:
  Topology() = default;
  // `triangles`: 3 vertex indices per face, each < vertex_count, no face repeating a vertex (assumed).
  // Edges are numbered in the order in which the faces, corner by corner, first run along them. Linear time,
  // some tens of nanoseconds a triangle; edges between two vertices of more than 64 corners each are sorted.
  Topology(Index vertex_count, std::vector<Index> triangles);
  // The same, and stops when the budget is polled dry.
  static Result<Topology> build(Index vertex_count, std::vector<Index> triangles, const Budget& budget);
  // With the edges as given: the edge of every half-edge, and every edge's ends, the lower-numbered first.
  // Refinement needs it: two faces over the same three points refine to edges that share their ends and are
  // not the same.
  Topology(Index vertex_count, std::vector<Index> triangles, Buffer<Index> half_edge_edges,
           Buffer<std::array<Index, 2>> edge_vertices);

  Index vertex_count() const { return vertex_count_; }
  Index edge_count() const { return static_cast<Index>(edge_vertices_.size()); }
  Index face_count() const { return static_cast<Index>(triangles_.size() / 3); }

  std::span<const Index> triangles() const { return triangles_; }
  std::span<const Index> half_edge_edges() const { return half_edge_edges_; }
  std::span<const std::array<Index, 2>> edge_vertices() const { return edge_vertices_; }
  // Per edge its two lowest half-edges; the second is kNoIndex at a boundary.
  std::span<const std::array<Index, 2>> edge_sides() const { return edge_sides_; }
  Index corner_vertex(Index h) const { return triangles_[h]; }
  Index half_edge_edge(Index h) const { return half_edge_edges_[h]; }
  // The two ends, the lower-numbered first.
  std::array<Index, 2> edge_vertices(Index e) const { return edge_vertices_[e]; }
  Index other_end(Index e, Index v) const {
    return edge_vertices_[e][0] == v ? edge_vertices_[e][1] : edge_vertices_[e][0];
  }
  // Half-edges along e, ascending.
  std::span<const Index> edge_half_edges(Index e) const {
    if (edge_kinds_[e] == EdgeKind::crowded) return crowd_of(e);
    return {edge_sides_[e].data(), edge_kinds_[e] == EdgeKind::border ? 1u : 2u};
  }
  // Edges at v, ascending; corners at v, ascending.
  std::span<const Index> vertex_edges(Index v) const { return slice(vertex_edges_, vertex_edge_offsets_, v); }
  std::span<const Index> vertex_corners(Index v) const {
    return slice(vertex_corners_, vertex_corner_offsets_, v);
  }

  bool is_boundary(Index e) const { return edge_kinds_[e] == EdgeKind::border; }
  // More than two faces, or two that run along the edge in the same direction (their windings clash).
  bool is_non_manifold_edge(Index e) const { return edge_kinds_[e] >= EdgeKind::clash; }
  // An end of a non-manifold edge, or a point where several fans of faces meet (a bow tie).
  bool is_non_manifold_vertex(Index v) const { return non_manifold_vertices_[v] != 0; }

  // The half-edge on the other side of h, leaving the vertex that h enters; kNoIndex at a boundary or
  // non-manifold edge.
  Index mate(Index h) const { return mates_[h]; }

  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index prev(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }

  // The corners at v in fans: faces follow each other counter-clockwise across edges for which passable(edge)
  // is true and that two faces share in agreement. A fan that closes on itself starts at the lowest of its
  // corners, fans are ordered by their lowest corner.
  struct Fan {
    std::vector<Index> corners;
    bool closed = false;
  };
  template <class Passable>
  std::vector<Fan> fans(Index v, Passable passable) const;

 private:
  enum class EdgeKind : unsigned char {
    border,    // one face
    manifold,  // two, of one winding
    clash,     // two that run along the edge in the same direction
    crowded,   // more
  };
  static std::span<const Index> slice(const Buffer<Index>& items, const Buffer<Index>& offsets, Index k) {
    return std::span(items).subspan(offsets[k], offsets[k + 1] - offsets[k]);
  }
  class Numbering;
  Result<void> connect(const Budget& budget);
  void join_edge(Index h, Index e);
  void gather_crowds();
  void group_corners();
  void group_edges();
  void find_non_manifold_vertices();
  bool is_one_fan(std::span<const Index> corners) const;
  std::span<const Index> crowd_of(Index e) const;

  Index vertex_count_ = 0;
  std::vector<Index> triangles_;
  Buffer<Index> half_edge_edges_, mates_;
  Buffer<std::array<Index, 2>> edge_vertices_, edge_sides_;  // sides: the two lowest half-edges
  Buffer<EdgeKind> edge_kinds_;
  Buffer<Index> vertex_edges_, vertex_edge_offsets_, vertex_corners_, vertex_corner_offsets_;
  std::vector<unsigned char> non_manifold_vertices_;
  std::vector<Index> crowded_edges_, crowd_half_edges_,
      crowd_offsets_;  // ascending; of edges that are crowded
};

template <class Passable>
std::vector<Topology::Fan> Topology::fans(Index v, Passable passable) const {
  const auto corners = vertex_corners(v);
  // The corner before h, clockwise: across the edge of h.
  auto before = [&](Index h) {
    const Index g = mate(h);
    return g != kNoIndex && passable(half_edge_edge(h)) ? next(g) : kNoIndex;
  };
  auto after = [&](Index h) { return passable(half_edge_edge(prev(h))) ? mate(prev(h)) : kNoIndex; };
  std::vector<Fan> result;
  std::vector<unsigned char> done(corners.size(), 0);
  auto position = [&](Index h) {
    return static_cast<std::size_t>(std::lower_bound(corners.begin(), corners.end(), h) - corners.begin());
  };
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (done[c] != 0) continue;
    Fan fan;
    Index start = corners[c];
    for (Index h = before(start); h != kNoIndex; h = before(h)) {
      start = h;
      if (h == corners[c]) {
        fan.closed = true;
        break;
      }
    }
    for (Index h = start; h != kNoIndex; h = after(h)) {
      done[position(h)] = 1;
      fan.corners.push_back(h);
      if (fan.closed && after(h) == start) break;
    }
    result.push_back(std::move(fan));
  }
  return result;
}

}  // namespace subdivd

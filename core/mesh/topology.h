#pragma once
// What touches what in a mesh of any kind, manifold or not. The fast way round vertices by half-edges;
// faces.h says what those are.

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/base/budget.h"
#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/mesh/connectivity.h"

namespace subdivd {

// Instantiated for Triangles, Quads and Polygons.
template <class Faces>
class Topology : public Connectivity<Faces> {
 public:
  Topology() = default;
  // The faces' vertices are each < vertex_count, no face repeating one (assumed). Edges are numbered by
  // find_edges(). Linear time, some tens of nanoseconds a triangle.
  Topology(Index vertex_count, Faces faces, const Pace& pace = {});
  // The same, and returns the budget's error when it says to stop.
  static Result<Topology> build(Index vertex_count, Faces faces, const Budget& budget);
  // With the edges as given: the edge of every half-edge, and every edge's ends, the lower-numbered first.
  // Refinement needs it: two faces over the same three points refine to edges that share their ends and are
  // not the same.
  Topology(Index vertex_count, Faces faces, Buffer<Index> half_edge_edges,
           Buffer<std::array<Index, 2>> edge_vertices, const Pace& pace = {});

  using Base = Connectivity<Faces>;
  using Base::corner_vertices;
  using Base::edge_count;
  using Base::edge_kinds;
  using Base::half_edge_edge;
  using Base::is_boundary;
  using Base::is_non_manifold_edge;
  using Base::mate;
  using Base::next;
  using Base::prev;

  // Half-edges along e: of a manifold edge the one that runs from the lower end first, of others ascending.
  std::span<const Index> edge_half_edges(Index e) const {
    if (is_non_manifold_edge(e)) return half_edges_of_non_manifold(e);
    const auto& sides = edges_.sides[e];
    if (!is_boundary(e)) return sides;
    return {&sides[sides[0] == kNoIndex ? 1 : 0], 1};
  }
  // Edges and corners at v. Where the faces at v are one fan: counter-clockwise, corner k lying between the
  // edges k and k + 1; a closed fan starts at its lowest corner, an open one at its border. At a non-manifold
  // vertex both ascend.
  std::span<const Index> vertex_edges(Index v) const { return slice(vertex_edges_, vertex_edge_offsets_, v); }
  std::span<const Index> vertex_corners(Index v) const {
    return slice(vertex_corners_, vertex_corner_offsets_, v);
  }

  // The rows of vertex_edges(v), one after the other, and where each begins and the last ends.
  std::span<const Index> all_vertex_edges() const { return vertex_edges_; }
  std::span<const Index> vertex_edge_offsets() const { return vertex_edge_offsets_; }
  // The same of vertex_corners(v).
  std::span<const Index> all_vertex_corners() const { return vertex_corners_; }
  std::span<const Index> vertex_corner_offsets() const { return vertex_corner_offsets_; }

  // An end of a non-manifold edge, or a point where several fans of faces meet (a bow tie).
  bool is_non_manifold_vertex(Index v) const { return non_manifold_vertices_[v] != 0; }
  std::span<const unsigned char> non_manifold_vertices() const { return non_manifold_vertices_; }

  // The corners at v in fans: faces follow each other counter-clockwise across edges for which passable(edge)
  // is true and that two faces share in agreement. A fan that closes on itself starts at the lowest of its
  // corners, fans are ordered by their lowest corner.
  struct Fan {
    std::span<const Index> corners;
    bool closed = false;
  };
  // In two arrays: a hub may have millions of fans, and as many small blocks of memory would have to be
  // freed.
  class Fans {
   public:
    std::size_t size() const { return ranges_.size(); }
    Fan operator[](std::size_t k) const {
      return {std::span(corners_).subspan(ranges_[k].begin, ranges_[k].end - ranges_[k].begin),
              ranges_[k].closed};
    }

   private:
    friend class Topology;
    struct Range {
      Index lowest, begin, end;  // lowest: of the corners
      bool closed;
    };
    void begin_fan() { ranges_.push_back({kNoIndex, size_of_corners(), size_of_corners(), false}); }
    void add(Index corner) {
      corners_.push_back(corner);
      ranges_.back().end = size_of_corners();
      ranges_.back().lowest = std::min(ranges_.back().lowest, corner);
    }
    Index size_of_corners() const { return static_cast<Index>(corners_.size()); }

    std::vector<Index> corners_;
    std::vector<Range> ranges_;
  };
  template <class Passable>
  Fans fans(Index v, Passable passable, const Pace& pace = {}) const {
    return is_non_manifold_vertex(v) ? scattered_fans(v, passable, pace) : fans_of_one(v, passable, pace);
  }

 private:
  static std::span<const Index> slice(const Buffer<Index>& items, const Buffer<Index>& offsets, Index k) {
    return std::span(items).subspan(offsets[k], offsets[k + 1] - offsets[k]);
  }
  using Base::across;
  using Base::edges_;
  using Base::faces_;
  using Base::vertex_count_;
  class Walk;
  void connect(Buffer<Index> first_corners, const Pace& pace);
  Buffer<Index> count_corners(const Pace& pace);
  void gather_non_manifold_half_edges(const Pace& pace);
  void count_edges(std::span<Index> first_corners, const Pace& pace);
  void go_round_vertices(std::span<const Index> first_corners, const Pace& pace);
  void go_round_vertices(Range vertices, std::span<const Index> first_corners,
                         std::span<const Index> next_corners, const Pace& pace);
  void find_next_corners(Range faces, std::span<Index> next_corners, const Pace& pace) const;
  void go_round_borders(const Pace& pace);
  void list_non_manifold(const Pace& pace);
  std::span<const Index> half_edges_of_non_manifold(Index e) const;
  template <class Passable>
  Fans fans_of_one(Index v, Passable passable, const Pace& pace) const;
  template <class Passable>
  Fans scattered_fans(Index v, Passable passable, const Pace& pace) const;

  Buffer<Index> vertex_edges_, vertex_edge_offsets_, vertex_corners_, vertex_corner_offsets_;
  std::vector<unsigned char> non_manifold_vertices_;
  std::vector<Index> non_manifold_half_edges_, non_manifold_offsets_;  // of the non-manifold edges
};

// Cuts the fan that the vertex has at the edges that may not be passed.
template <class Faces>
template <class Passable>
auto Topology<Faces>::fans_of_one(Index v, Passable passable, const Pace& pace) const -> Fans {
  const auto corners = vertex_corners(v), edges = vertex_edges(v);
  const bool closed = corners.size() == edges.size();
  const std::size_t count = corners.size();
  Fans result;
  if (count == 0) return result;
  // A closed fan is cut open at the first wall.
  std::size_t start = 0;
  if (closed)
    while (start < count && passable(edges[start])) {
      pace.spend(1);
      ++start;
    }
  const bool whole = start == count;
  for (std::size_t k = 0; k < count; ++k) {
    pace.spend(4);
    const std::size_t at = (start + k) % count;
    if (k == 0 || (!whole && !passable(edges[at]))) result.begin_fan();
    result.add(corners[at]);
  }
  result.ranges_.back().closed = whole;
  if (result.size() > 1)
    pace.sort(result.ranges_.begin(), result.ranges_.end(),
              [](const auto& a, const auto& b) { return a.lowest < b.lowest; });
  return result;
}

template <class Faces>
template <class Passable>
auto Topology<Faces>::scattered_fans(Index v, Passable passable, const Pace& pace) const -> Fans {
  const auto corners = vertex_corners(v);
  // The corner before h, clockwise: across the edge of h.
  auto before = [&](Index h) {
    const Index g = mate(h);
    return g != kNoIndex && passable(half_edge_edge(h)) ? next(g) : kNoIndex;
  };
  auto after = [&](Index h) { return passable(half_edge_edge(prev(h))) ? mate(prev(h)) : kNoIndex; };
  Fans result;
  std::vector<unsigned char> done(corners.size(), 0);
  auto position = [&](Index h) {
    return static_cast<std::size_t>(std::lower_bound(corners.begin(), corners.end(), h) - corners.begin());
  };
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (done[c] != 0) continue;
    bool closed = false;
    Index start = corners[c];
    for (Index h = before(start); h != kNoIndex; h = before(h)) {
      pace.spend(4);
      start = h;
      if (h == corners[c]) {
        closed = true;
        break;
      }
    }
    result.begin_fan();
    result.ranges_.back().closed = closed;
    for (Index h = start; h != kNoIndex; h = after(h)) {
      pace.spend(8);
      done[position(h)] = 1;
      result.add(h);
      if (closed && after(h) == start) break;
    }
  }
  return result;
}

extern template class Topology<Triangles>;
extern template class Topology<Quads>;
extern template class Topology<Polygons>;

// What building a topology takes beside what it holds in the end, at most: the edges' homes while they are found
// (edges.cpp), room for edges that grows, half-edges between hubs.
inline Count topology_building_bytes(Count vertices, Count corners) {
  const bool has_homes = vertices <= corners;
  return 28 * corners + (has_homes ? 68 * vertices : 8 * vertices + 12 * corners);
}

}  // namespace subdivd

#pragma once
// The number of every refined vertex from its place on a base face: see split.h for the formula.

#include <array>

#include "core/base/index.h"
#include "core/lattice/split.h"
#include "core/mesh/connectivity.h"

namespace subdivd {

// The points around one: of its edges, counter-clockwise, and where faces are quads the one opposite to it in the
// face behind each edge.
template <std::size_t kEdges, std::size_t kFaces>
struct PointsAround {
  std::array<Index, kEdges> edges;
  std::array<Index, kFaces> opposite = {};
};

// Of the refined mesh over faces of one size: below for triangles, in quads.h for quads.
template <class Faces>
class Numbering;
template <class Faces>
Numbering(const Connectivity<Faces>&, Index) -> Numbering<Faces>;

template <>
class Numbering<Triangles> {
 public:
  Numbering(const Connectivity<Triangles>& connectivity, Index level)
      : connectivity_(&connectivity),
        n_(segments(level)),
        edge_begin_(connectivity.vertex_count()),
        face_begin_(edge_begin_ + connectivity.edge_count() * (n_ - 1)) {}

  Count segment_count() const { return n_; }
  Count vertex_count() const { return face_begin_ + connectivity_->face_count() * inner_points(n_); }

  // Vertex at grid point (i, j) of `face`; faces that share an edge agree about the points on it.
  Index vertex(Index face, Count i, Count j) const {
    const Count n = n_;
    if (j == 0) return on_edge(face, 0, i);
    if (i + j == n) return on_edge(face, 1, j);
    if (i == 0) return on_edge(face, 2, n - j);
    return static_cast<Index>(face_begin_ + face * inner_points(n) + inner_index(n, i, j));
  }

  // The k-th point of base edge e from its lower-numbered end, 0..n.
  Index along(Index e, Count k) const {
    if (k == 0) return connectivity_->edge_vertices(e)[0];
    if (k == n_) return connectivity_->edge_vertices(e)[1];
    return static_cast<Index>(edge_begin_ + e * (n_ - 1) + k - 1);
  }

  using Ring = PointsAround<6, 0>;
  using BorderRing = PointsAround<4, 0>;

  // The neighbours of point k inside an edge of two faces, counter-clockwise from the next point along
  // the edge.
  Ring ring_on_edge(Index e, Count k) const {
    const auto [left, right] = connectivity_->edge_sides()[e];
    return {{along(e, k + 1), beside(left, k), beside(left, k - 1), along(e, k - 1), beside(right, n_ - k),
             beside(right, n_ - 1 - k)}};
  }
  // Those of point p inside half-edge h, counted from its own start, in the face of h alone: from the next point
  // to the one before.
  BorderRing ring_beside(Index h, Count p) const {
    return {{on_edge(h / 3, h % 3, p + 1), beside(h, p), beside(h, p - 1), on_edge(h / 3, h % 3, p - 1)}};
  }

  // Those of any vertex inside a base face, or inside a base edge of two faces.
  Ring regular_ring(Index vertex) const {
    if (vertex < face_begin_) {
      const Count from_first = vertex - edge_begin_;
      return ring_on_edge(static_cast<Index>(from_first / (n_ - 1)), from_first % (n_ - 1) + 1);
    }
    const Count from_first = vertex - face_begin_;
    const auto face = static_cast<Index>(from_first / inner_points(n_));
    const auto [i, j] = inner_point(n_, from_first % inner_points(n_));
    return {{this->vertex(face, i + 1, j), this->vertex(face, i, j + 1), this->vertex(face, i - 1, j + 1),
             this->vertex(face, i - 1, j), this->vertex(face, i, j - 1), this->vertex(face, i + 1, j - 1)}};
  }

  // The row of points next to half-edge h and parallel to it, in h's direction: p = 0..n-1. Point p and the
  // h's points p and p + 1 are a triangle.
  Index beside(Index h, Count p) const {
    const Count n = n_;
    switch (h % 3) {
      case 0:
        return vertex(h / 3, p, 1);
      case 1:
        return vertex(h / 3, n - 1 - p, p);
      default:
        return vertex(h / 3, 1, n - 1 - p);
    }
  }

 private:
  // The point `k` segments from corner `corner` towards the next corner.
  Index on_edge(Index face, Index corner, Count k) const {
    const Index h = 3 * face + corner;
    if (k == 0) return connectivity_->corner_vertex(h);
    if (k == n_) return connectivity_->corner_vertex(Triangles::next(h));
    const Index e = connectivity_->half_edge_edge(h);
    const Count from_low = connectivity_->edge_vertices(e)[0] == connectivity_->corner_vertex(h) ? k : n_ - k;
    return static_cast<Index>(edge_begin_ + e * (n_ - 1) + from_low - 1);
  }

  const Connectivity<Triangles>* connectivity_;
  Count n_, edge_begin_, face_begin_;
};

// As many values has a mesh at that level.
inline Count refined_vertex_count(const Connectivity<Triangles>& connectivity, Index level) {
  return Numbering(connectivity, level).vertex_count();
}

// The numbers of one face's points, edge by edge: point p = 1..n-1 of side k, counted from corner k, has the
// number side[k] + (p - 1) step[k], modulo 2^32; those inside start at `inside`.
struct FaceNumbers {
  Index corner[3], side[3], step[3], inside;

  FaceNumbers(const Connectivity<Triangles>& connectivity, Count n, Index face) {
    const Index edge_begin = connectivity.vertex_count();
    for (Index k = 0; k < 3; ++k) {
      const Index h = 3 * face + k;
      corner[k] = connectivity.corner_vertex(h);
      const Index first = static_cast<Index>(edge_begin + Count{connectivity.half_edge_edge(h)} * (n - 1));
      const bool forward = corner[k] < connectivity.corner_vertex(Triangles::next(h));
      side[k] = forward ? first : static_cast<Index>(first + n - 2);
      step[k] = forward ? 1 : static_cast<Index>(-1);
    }
    inside =
        static_cast<Index>(edge_begin + Count{connectivity.edge_count()} * (n - 1) + face * inner_points(n));
  }
};

// Calls f(i0, j0, i1, j1, i2, j2) for the corners of all n^2 triangles of a face, in their order.
template <class F>
constexpr void for_each_triangle(Count n, F&& f) {
  for (Count j = 0; j < n; ++j)
    for (Count i = 0; i + j < n; ++i) {
      f(i, j, i + 1, j, i, j + 1);
      if (i + j + 1 < n) f(i + 1, j, i + 1, j + 1, i, j + 1);
    }
}

}  // namespace subdivd

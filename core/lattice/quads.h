#pragma once
// Closed-form numbering of uniformly refined quad meshes: n = 2^level segments per base edge.
//
// The grid of a base face (v0, v1, v2, v3): point (i, j), 0 <= i, j <= n, lies at (1 - u)(1 - v) v0 + u (1 - v) v1 +
// u v v2 + (1 - u) v v3 with u = i/n, v = j/n.
//
//       v3 ------ v2         edge 0 = v0 v1 (j = 0), edge 1 = v1 v2 (i = n), edge 2 = v2 v3 (j = n),
//       |          |         edge 3 = v3 v0 (i = 0)
//       |          |         quad (i,j) (i+1,j) (i+1,j+1) (i,j+1)
//       v0 ------ v1
//
// Vertices:   base vertex v: number v
//             k-th point inside base edge e (k = 1..n-1, from the edge's lower-numbered end): V + e(n-1) + k-1
//             inside face f: V + E(n-1) + f(n-1)^2 + (j-1)(n-1) + i-1
// Quads:      face f owns n^2 quads starting at f n^2, row by row: the one above is number j n + i

#include "core/base/index.h"
#include "core/lattice/numbering.h"
#include "core/lattice/split.h"
#include "core/mesh/connectivity.h"

namespace subdivd {

inline constexpr Count inner_quad_points(Count n) { return (n - 1) * (n - 1); }
// Number of inner point (i, j) of a face, 0-based: 1 <= i, j <= n - 1.
inline constexpr Count inner_quad_index(Count n, Count i, Count j) { return (j - 1) * (n - 1) + i - 1; }

// V + E(n-1) + F(n-1)^2 vertices, nE + 2F n(n-1) edges, F n^2 quads. 64-bit results are exact for level <= kMaxLevel
// and counts below 2^32.
inline constexpr LevelCounts refined_quad_counts(Count vertices, Count edges, Count faces, Index level) {
  const Count n = segments(level);
  return {vertices + edges * (n - 1) + faces * inner_quad_points(n), edges * n + faces * 2 * n * (n - 1),
          faces * n * n, 4};
}

template <>
class Numbering<Quads> {
 public:
  Numbering(const Connectivity<Quads>& connectivity, Index level)
      : connectivity_(&connectivity),
        n_(segments(level)),
        edge_begin_(connectivity.vertex_count()),
        face_begin_(edge_begin_ + connectivity.edge_count() * (n_ - 1)) {}

  Count segment_count() const { return n_; }
  Count vertex_count() const { return face_begin_ + connectivity_->face_count() * inner_quad_points(n_); }

  // Vertex at grid point (i, j) of `face`; faces that share an edge agree about the points on it.
  Index vertex(Index face, Count i, Count j) const {
    if (j == 0) return on_edge(4 * face, i);
    if (i == n_) return on_edge(4 * face + 1, j);
    if (j == n_) return on_edge(4 * face + 2, n_ - i);
    if (i == 0) return on_edge(4 * face + 3, n_ - j);
    return static_cast<Index>(face_begin_ + face * inner_quad_points(n_) + inner_quad_index(n_, i, j));
  }

  // The point opposite to corner h of its face in the small quad there.
  Index opposite(Index h) const {
    const Index k = h % 4;
    return vertex(h / 4, k == 0 || k == 3 ? 1 : n_ - 1, k < 2 ? 1 : n_ - 1);
  }

  // The k-th point of base edge e from its lower-numbered end, 0..n.
  Index along(Index e, Count k) const {
    if (k == 0) return connectivity_->edge_vertices(e)[0];
    if (k == n_) return connectivity_->edge_vertices(e)[1];
    return static_cast<Index>(edge_begin_ + e * (n_ - 1) + k - 1);
  }

  using Ring = PointsAround<4, 4>;
  using BorderRing = PointsAround<3, 2>;

  // The neighbours of point k inside an edge of two faces, counter-clockwise from the next point along the edge.
  Ring ring_on_edge(Index e, Count k) const {
    const auto [left, right] = connectivity_->edge_sides()[e];
    return {{along(e, k + 1), beside(left, k), along(e, k - 1), beside(right, n_ - k)},
            {beside(left, k + 1), beside(left, k - 1), beside(right, n_ - k + 1), beside(right, n_ - k - 1)}};
  }
  // Those of point p inside half-edge h, counted from its own start, in the face of h alone: from the next point
  // to the one before.
  BorderRing ring_beside(Index h, Count p) const {
    return {{on_edge(h, p + 1), beside(h, p), on_edge(h, p - 1)}, {beside(h, p + 1), beside(h, p - 1)}};
  }

  // Those of any vertex inside a base face, or inside a base edge of two faces.
  Ring regular_ring(Index vertex) const {
    if (vertex < face_begin_) {
      const Count from_first = vertex - edge_begin_;
      return ring_on_edge(static_cast<Index>(from_first / (n_ - 1)), from_first % (n_ - 1) + 1);
    }
    const Count from_first = vertex - face_begin_, inside = from_first % inner_quad_points(n_);
    const auto face = static_cast<Index>(from_first / inner_quad_points(n_));
    const Count i = inside % (n_ - 1) + 1, j = inside / (n_ - 1) + 1;
    return {{this->vertex(face, i + 1, j), this->vertex(face, i, j + 1), this->vertex(face, i - 1, j),
             this->vertex(face, i, j - 1)},
            {this->vertex(face, i + 1, j + 1), this->vertex(face, i - 1, j + 1),
             this->vertex(face, i - 1, j - 1), this->vertex(face, i + 1, j - 1)}};
  }

  // The row of points next to half-edge h and parallel to it, in h's direction: p = 0..n. Its points p and p + 1
  // and the half-edge's make a quad.
  Index beside(Index h, Count p) const {
    const Index face = h / 4;
    switch (h % 4) {
      case 0:
        return vertex(face, p, 1);
      case 1:
        return vertex(face, n_ - 1, p);
      case 2:
        return vertex(face, n_ - p, n_ - 1);
      default:
        return vertex(face, 1, n_ - p);
    }
  }

 private:
  // The point `k` segments along half-edge h.
  Index on_edge(Index h, Count k) const {
    const Index from = connectivity_->corner_vertex(h);
    if (k == 0) return from;
    if (k == n_) return connectivity_->corner_vertex(Quads::next(h));
    const Index e = connectivity_->half_edge_edge(h);
    return along(e, connectivity_->edge_vertices(e)[0] == from ? k : n_ - k);
  }

  const Connectivity<Quads>* connectivity_;
  Count n_, edge_begin_, face_begin_;
};

// The numbers of one face's points, edge by edge: point p = 1..n-1 of side k, counted from corner k, has the
// number side[k] + (p - 1) step[k], modulo 2^32; those inside start at `inside`.
struct QuadNumbers {
  Index corner[4], side[4], step[4], inside;

  QuadNumbers(const Connectivity<Quads>& connectivity, Count n, Index face) {
    const Index edge_begin = connectivity.vertex_count();
    for (Index k = 0; k < 4; ++k) {
      const Index h = 4 * face + k;
      corner[k] = connectivity.corner_vertex(h);
      const Index e = connectivity.half_edge_edge(h);
      const Index first = static_cast<Index>(edge_begin + Count{e} * (n - 1));
      const bool forward = corner[k] == connectivity.edge_vertices(e)[0];
      side[k] = forward ? first : static_cast<Index>(first + n - 2);
      step[k] = forward ? 1 : static_cast<Index>(-1);
    }
    inside = static_cast<Index>(edge_begin + Count{connectivity.edge_count()} * (n - 1) +
                                face * inner_quad_points(n));
  }
};

// As many values has a mesh at that level.
inline Count refined_vertex_count(const Connectivity<Quads>& connectivity, Index level) {
  return Numbering(connectivity, level).vertex_count();
}

}  // namespace subdivd

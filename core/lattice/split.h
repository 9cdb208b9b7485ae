#pragma once
// Closed-form numbering of uniformly refined triangle meshes: n = 2^level segments per base edge.
//
// The grid of a base face (v0, v1, v2): point (i, j) = v0 + i/n (v1 - v0) + j/n (v2 - v0), i, j >= 0 and
// i + j <= n.
//
//            v2            row j holds the points (0..n-j, j)
//           /  \           edge 0 = v0 v1 (j = 0), edge 1 = v1 v2 (i + j = n), edge 2 = v2 v0 (i = 0)
//         /      \         upright triangle  (i,j) (i+1,j) (i,j+1)
//       v0 ------ v1       inverted triangle (i+1,j) (i+1,j+1) (i,j+1)
//
// Vertices:   base vertex v: number v
//             k-th point inside base edge e (k = 1..n-1, from the edge's lower-numbered end): V + e(n-1) + k-1
//             inside face f: V + E(n-1) + f(n-1)(n-2)/2 + inner(i,j), row by row from j = 1
// Triangles:  face f owns n^2 triangles starting at f n^2, row by row: upright (i,j) is number
//             n^2 - (n-j)^2 + 2i, the inverted one right of it the next

#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/index.h"

namespace subdivd {

inline constexpr Index kMaxLevel = 15;  // of any request; n = 32768 segments per edge

struct GridPoint {
  Index i = 0, j = 0;
};

// Size of a refined level, known before anything is refined.
struct LevelCounts {
  Count vertices = 0, edges = 0, faces = 0;  // faces: holes included
  Index face_size = 3;                       // corners of each; 0: they have different numbers
};

inline constexpr Count segments(Index level) { return Count{1} << level; }
inline constexpr Count triangles_per_face(Index level) { return Count{1} << (2 * level); }
// All points of one face's grid, borders included, and the number of (i, j) among them, row by row.
inline constexpr Count face_points(Count n) { return (n + 1) * (n + 2) / 2; }
inline constexpr Count face_point_index(Count n, Count i, Count j) {
  return j * (n + 1) - (j * j - j) / 2 + i;
}
inline constexpr Count inner_points(Count n) { return n < 3 ? 0 : (n - 1) * (n - 2) / 2; }
// Number of inner point (i, j) of a face, 0-based: i, j >= 1 and i + j < n.
inline constexpr Count inner_index(Count n, Count i, Count j) {
  return (j - 1) * (n - 1) - j * (j - 1) / 2 + (i - 1);
}
// The point with that number. (n - 1 - j points a row: from the last row backwards 1, 2, 3, ...)
inline GridPoint inner_point(Count n, Count index) {
  const Count behind = inner_points(n) - 1 - index;
  // Whole roots are exact, and no other comes near a whole number: 8 n^2 is far below 2^53.
  const auto rows_behind = static_cast<Count>((std::sqrt(8 * static_cast<double>(behind) + 1) - 1) / 2);
  const Count j = n - 2 - rows_behind;
  return {static_cast<Index>(index - inner_index(n, 1, j) + 1), static_cast<Index>(j)};
}
inline constexpr Count upright_index(Count n, Count i, Count j) { return n * n - (n - j) * (n - j) + 2 * i; }
// Number within its face of the triangle with these corners, which may begin at any of them.
inline constexpr Count triangle_index(Count n, std::span<const GridPoint, 3> corners) {
  Count i = n, j = n, total = 0;
  for (const GridPoint& corner : corners) {
    i = std::min<Count>(i, corner.i);
    j = std::min<Count>(j, corner.j);
    total += corner.i + corner.j;
  }
  const bool inverted = total == 3 * (i + j) + 4;  // its corners sum to 4 more than three times the least
  return upright_index(n, i, j) + (inverted ? 1 : 0);
}

// Counts of the refined mesh: V + E(n-1) + F(n-1)(n-2)/2 vertices, nE + 3F n(n-1)/2 edges, F n^2 triangles.
// 64-bit results are exact for level <= kMaxLevel and counts below 2^32.
inline constexpr LevelCounts refined_counts(Count vertices, Count edges, Count faces, Index level) {
  const Count n = segments(level);
  return {vertices + edges * (n - 1) + faces * inner_points(n), edges * n + faces * 3 * (n * (n - 1) / 2),
          faces * n * n};
}

}  // namespace subdivd

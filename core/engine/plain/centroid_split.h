#pragma once
// The step that puts a point into every triangle and flips the edges; two of them cut every edge in three.
//
// Edges that two faces share in agreement are *crossed*: of triangles f and g, edge (a, b) between them becomes the edge
// between their points. Others, and infinitely sharp ones, are *creases* and stay in a first step:
//
//        c               c            first step: the triangle keeps its crease (a, b)
//       / \            / | \          second step: no point in the triangle (a, b, f) that
//      /   \    ->    /  f  \         the first one left, but two on its crease, p and q;
//     /     \        / /   \ \        the other two edges go to the nearer one of those.
//    a-------b      a---------b
//
// With V vertices, F faces, H = 3 F half-edges before:
//   vertices    the old ones; in a second step then two for each crease, by its edge's number, the one near its
//               lower-numbered end first; then the points of faces, in their order: all, or in a second step those
//               without a crease
//   faces       one for every half-edge, under its number: beside a crossed edge (corner, point of the face across, point
//               of the face); beside a crease the face's point with it, in a second step with its middle third
//
// Channels: a channel's borders are the mesh's, or creases of it. Across any other seam the mesh would flip an edge that
// the channel keeps, and the two would not have the same faces any more: not provided for.
//
// Two faces over the same points have edges of their own. Steps alternate: Level::thirds_next.

#include <array>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/engine/plain/level.h"

namespace subdivd::plain {

// The points of the next level, by the old level's edges and faces.
struct CentroidNumbers {
  CentroidNumbers(const Level& level, const Pace& pace);

  std::vector<unsigned char> crease;  // 1: of the old edges
  std::vector<Index> edge_points;     // the first of a crease's two; kNoIndex: none
  std::vector<Index> face_points;     // kNoIndex: none, the face has a crease with points
  std::vector<Index> face_creases;  // in a second step: the half-edge along the face's crease; kNoIndex: none
  Index vertex_count = 0;

  // The point of edge e near v.
  Index near(const Adjacency& faces, Index e, Index v) const {
    return edge_points[e] + (faces.edge_vertices(e)[0] == v ? 0 : 1);
  }
};

// One step. The faces are triangles; semi-sharpness plays no part: callers refuse it. Linear time.
Level next_level_by_centroids(const Level& level, const Pace& pace = {});

}  // namespace subdivd::plain

#pragma once
// The dual step: every corner of a face becomes a vertex, and faces come from faces, edges and vertices.
//
// Edges that two faces share in agreement are *crossed*. Others, and infinitely sharp ones, bound the surface on
// either side, which falls apart there: two borders, one beside the other, that follow the same curve. The faces
// around a vertex between such edges are a *sector*.
//   curve   The border is Chaikin's curve of its own points. Along an edge (a, b) it has the points (3a + b)/4 and
//           (a + 3b)/4; beside a pinned end p it has p and (p + b)/2.   [core/surfaces, degree 2]
//   open    A border edge without sharpness bounds nothing: the strip along it disappears.  (interpolateBoundary none)
// A vertex is pinned where it is infinitely sharp itself, and where more than two of its edges are curves (bow
// ties and other vertices that are not manifold are infinitely sharp). One sharp edge that ends inside the surface
// is a slit, whose curve turns at its tip; one whose ends are both pinned stays an infinitely sharp edge between them.
//
// What becomes of a sector of k faces between two curves:
//   k = 1, pinned      The new vertex of the corner is the vertex itself.
//   k = 1              Chaikin's curve has two points here: two vertices more, and a triangle between them and the
//                      corner's own, which lies inside. From the second step on there is no such sector.
//   k >= 2             The outermost corners lie on the curves; k >= 3: the corners are a face.
//   k >= 2, pinned     One vertex more, the pinned one; all corners lie inside and are a face with it.
// Where a corner lies inside though its face's edge is a curve, a triangle or quad fills up to the curve. A pinned
// vertex all around which edges are crossed gets a triangle at every corner.
//
// Inside a face, the point of a corner is the scheme's. Beside a curve it is as in `surfaces` of degree 2: the mean of
// its own and those of its neighbours in the face that lie on curves across (of a quad's corner with two such, also
// of the one opposite).
//
// Two faces over the same points in opposite order close up; in the same order all their edges are curves. Where a
// vertex inside has two faces only, there is no face in its place. A point that no face uses disappears.
//
// Channels: the faces in the place of an edge or a vertex take values of several old faces. A channel without seams is
// refined with the mesh's own split; a seam would have to be a curve of the mesh as well, and is not provided for.

#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/engine/plain/level.h"
#include "core/engine/plain/sectors.h"
#include "core/mesh/cage.h"

namespace subdivd::plain {

// Where the new vertex of a corner lies.
enum class CornerPlace : unsigned char {
  inside,     // of its face
  after,      // on the curve, towards the next corner
  before,     // on the curve, towards the corner before
  at_vertex,  // at the pinned vertex
};

// A vertex more on a curve: near `vertex` towards another vertex; kNoIndex: the pinned vertex itself.
struct CurvePoint {
  Index vertex = 0, towards = kNoIndex;
};

enum class EdgeRole : unsigned char { crossed, curve, open };

struct CornerSplit {
  // New vertices: that of half-edge h has its number; the points `more` follow. New faces: those of faces, in their
  // order; of crossed edges, in theirs; of sectors, by vertex and lowest corner; those that fill up to curves, by
  // half-edge.
  Adjacency faces;
  Sharpness sharpness;              // of the new edges and vertices: curves and pinned vertices, nothing else
  std::vector<Index> face_parents;  // the lowest of the old faces that a new one comes from

  std::vector<EdgeRole> roles;        // of the old edges
  std::vector<unsigned char> pinned;  // 1: of the old vertices
  std::vector<CornerPlace> places;    // of the old corners
  std::vector<CurvePoint> more;

  Sectors sectors;
};

// Semi-sharpness plays no part: callers refuse it. Linear time.
CornerSplit split_corners(const Level& level, const Pace& pace = {});

// The level that the split makes.
Level next_level(CornerSplit split, const Pace& pace = {});

// Makes the borders of a level 0 open that the cage does not make infinitely sharp: for interpolateBoundary none, with
// splits into corners.
void open_borders(Level& level, const Cage& cage, const Pace& pace = {});

}  // namespace subdivd::plain

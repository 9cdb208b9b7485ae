#pragma once
// The faces and edges of the next level, with numbers by which a parent's children are found.

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/engine/plain/adjacency.h"
#include "core/schemes/scheme.h"

namespace subdivd::plain {

// Which of its halves edge e has at v: 0 at its lower-numbered end.
inline Index half_at(const Adjacency& faces, Index e, Index v) {
  return faces.edge_vertices(e)[0] == v ? 0 : 1;
}

// With V vertices, E edges and F faces before: the vertex point of v has the number v, the edge point of e the
// number V + e; edge e has the halves 2 e, at its lower end, and 2 e + 1.
//   triangles  Every face being a triangle. Face f has the children 4 f + k at its corners k and 4 f + 3 between;
//              inside it, across its corner k, lies edge 2 E + 3 f + k.
//   quads      The point of face f has the number V + E + f. The child at the corner that half-edge h leaves has
//              the number h and begins there; from the edge point of h to the face point runs edge 2 E + h.
// The other splits depend on sharpness too, and have files of their own: corner_split, centroid_split.
Adjacency split_faces(Split split, const Adjacency& parent, const Pace& pace);

// How many points that step makes.
Count child_count(Split split, const Adjacency& parent);

}  // namespace subdivd::plain

#pragma once
// Where on the control mesh a refined vertex lies.

#include "core/base/index.h"

namespace subdivd {

// With n = 2^level, u = i/n, v = j/n:
//   on a triangle (v0, v1, v2):    v0 + u (v1 - v0) + v (v2 - v0);
//   on a quad (v0, v1, v2, v3):    (1 - u)(1 - v) v0 + u (1 - v) v1 + u v v2 + (1 - u) v v3, at the first step;
//   on a face of another number of corners, which becomes as many quads: in the same way on the quad of `corner`, that
//   is (v_corner, its edge's point, the face's point, the point of the edge before).
struct Provenance {
  Index face = kNoIndex;  // the lowest-numbered base face that holds the vertex; kNoIndex: unreferenced point
  Index i = 0, j = 0;
  Index corner = 0;  // 0 on triangles and quads
  friend bool operator==(const Provenance&, const Provenance&) = default;
};

}  // namespace subdivd

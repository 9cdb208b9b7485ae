#pragma once
// All that a mask may see of the mesh: plain data around an edge or a vertex. Above this file nobody sees
// half-edges, below it nobody sees a formula.

#include <span>

#include "core/base/index.h"
#include "core/mesh/control_mesh.h"

namespace subdivd {

//        o0         An edge with its ends a, b and the vertices opposite to it in its faces: one at a border,
//       /  \        two inside, any number where the mesh is not manifold.
//      a----b
//       \  /
//        o1
struct EdgeRing {
  Index face_count = 2;
  float sharpness = 0;
  float child_sharpness[2] = {0, 0};  // of its two halves, one level on
  Index triangle_count = 0;           // of its faces; set where faces may have any size
};

//     e2---e1       A vertex v and the other ends e_k of its edges.
//     / \  / \      .
//   e3---v---e0
struct VertexRing {
  Index face_count = 0;
  CreaseMethod crease_method = CreaseMethod::uniform;
  float sharpness = 0, child_sharpness = 0;
  std::span<const float> edge_sharpness, child_edge_sharpness;  // per edge; child: of the half next to v
};

}  // namespace subdivd

#pragma once
// Catmull and Clark's subdivision of polygon meshes with creases: every mask of a step, its formula, its source.
//
// [CatmullClark78]  E. Catmull, J. Clark, Recursively generated B-spline surfaces on arbitrary topological
//                   meshes, Computer-Aided Design 10, 1978
// [DeRose98]        T. DeRose, M. Kass, T. Truong, Subdivision Surfaces in Character Animation, SIGGRAPH 98

#include <string_view>

#include "core/mesh/cage.h"
#include "core/schemes/scheme.h"

namespace subdivd {

// The point of a face is the mean of its vertices.  [CatmullClark78]
struct CatmullClark {
  static constexpr std::string_view name = "catmullClark";
  static constexpr Split split = Split::quads;
  static constexpr FaceSizes face_sizes{3, kNoIndex};
  static constexpr Index regular_valence = 4;

  TriangleRule triangles = TriangleRule::catmull_clark;

  // smooth 1/4 (a + b) + 1/4 (f0 + f1), crease or border 1/2 (a + b)      [CatmullClark78]
  // k faces share the faces' weight: 1/2 / k each                         [Far 3.5 for k != 2]
  // Of two faces, with TriangleRule::smooth: w (f0 + f1) + (1/2 - w) (a + b), w being the mean of 0.470 for a
  // triangle and 1/4 for another face.                                    [Far 3.5]
  EdgeMask edge_mask(const EdgeRing& ring) const;
  // smooth (n - 2)/n v + 1/n^2 (sum e + sum f), n being the number of faces; crease 3/4 v + 1/8 (e_a + e_b);
  // corner v.                                                             [CatmullClark78, DeRose98]
  VertexMask vertex_mask(const VertexRing& ring) const;
};

}  // namespace subdivd

#pragma once
// Catmull and Clark's subdivision of polygon meshes with creases: every mask, its formula, its source.
//
// [CatmullClark78]  E. Catmull, J. Clark, Recursively generated B-spline surfaces on arbitrary topological
//                   meshes, Computer-Aided Design 10, 1978
// [HalsteadKassDeRose93]  M. Halstead, M. Kass, T. DeRose, Efficient, Fair Interpolation using Catmull-Clark
//                   Surfaces, SIGGRAPH 93: limits and tangents of smooth vertices
// [DeRose98]        T. DeRose, M. Kass, T. Truong, Subdivision Surfaces in Character Animation, SIGGRAPH 98

#include <span>
#include <string_view>

#include "core/base/pace.h"
#include "core/mesh/cage.h"
#include "core/schemes/scheme.h"

namespace subdivd {

// The point of a face is the mean of its vertices.  [CatmullClark78]
struct CatmullClark {
  static constexpr std::string_view name = "catmullClark";
  static constexpr Split split = Split::quads;
  static constexpr FaceSizes face_sizes{3, kNoIndex};
  static constexpr Index regular_valence = 4;
  static constexpr Index flat_corner_faces = 1;

  TriangleRule triangles = TriangleRule::catmull_clark;

  static std::span<const SchemeOption<CatmullClark>> options() { return {}; }
  // See beyond_opensubdiv() of all.h.
  std::string_view beyond_opensubdiv() const { return {}; }

  // smooth 1/4 (a + b) + 1/4 (f0 + f1), crease or border 1/2 (a + b)      [CatmullClark78]
  // k faces share the faces' weight: 1/2 / k each                         [Far 3.5 for k != 2]
  // Of two faces, with TriangleRule::smooth: w (f0 + f1) + (1/2 - w) (a + b), w being the mean of 0.470 for a
  // triangle and 1/4 for another face.                                    [Far 3.5]
  EdgeMask edge_mask(const EdgeRing& ring) const;
  // smooth (n - 2)/n v + 1/n^2 (sum e + sum f), n being the number of faces; crease 3/4 v + 1/8 (e_a + e_b);
  // corner v.                                                             [CatmullClark78, DeRose98]
  VertexMask vertex_mask(const VertexRing& ring) const;

  // What follows is of a ring of quads, d_k being the vertex opposite to v in face k.

  // smooth: (n^2 v + 4 sum e + sum d) / (n (n + 5))                       [HalsteadKassDeRose93]
  VertexMask smooth_limit_mask(Index n) const;
  // crease: 1/6 e_a + 2/3 v + 1/6 e_b, the limit of 1/8, 3/4, 1/8.
  VertexMask crease_limit_mask(Index a, Index b) const;
  // dart: the vertex point is the smooth one but the edge point on the crease (edge 0) is 1/2, 1/2. Derivation in
  // catmull_clark.cpp.
  RingMask dart_limit_mask(Index n, const Pace& pace = {}) const;

  // Tangents at a smooth vertex, with t = 2 pi / n and A = 1 + cos t + cos(t / 2) sqrt(2 (9 + cos t)):
  //   u: A cos(k t) e_k + (cos(k t) + cos((k + 1) t)) d_k, and v the same with sines;  n = 2: e_0 - e_1, d_0 - d_1.
  // They shrink by (4 + A) / 16 a level. Ring counter-clockwise: the cross product points outwards.
  //                                                                       [HalsteadKassDeRose93]
  RingMask smooth_tangent_u(Index n, const Pace& pace = {}) const;
  RingMask smooth_tangent_v(Index n, const Pace& pace = {}) const;
  // At a dart whose crease is edge 0: the sine is the same; the cosine's place is taken by the dominant
  // eigenvector that is symmetric about the crease, found by iteration.
  RingMask dart_tangent_u(Index n, const Pace& pace = {}) const;
  // Across a sector of m faces between two crease edges 0 and m: with t = pi / m and A as above
  //   e_i: A sin(i t),  d_i: sin(i t) + sin((i + 1) t),  e_0, e_m and v: derivation in catmull_clark.cpp.
  // m = 1: e_0 + e_1 - 2 v.  m = 2: 4 e_1 - e_0 - e_2 + d_0 + d_1 - 4 v.  It is a left eigenvector for (4 + A) / 16
  // (m = 1: 1/4). The tangent along the crease is e_0 - e_m, eigenvalue 1/2.
  RingMask crease_tangent_across(Index m, const Pace& pace = {}) const;
};

}  // namespace subdivd

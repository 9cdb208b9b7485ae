#pragma once
// Loop's subdivision of triangle meshes with creases: every mask, its formula, its source.
//
// [Loop87]      C. Loop, Smooth Subdivision Surfaces Based on Triangles, MSc thesis, University of Utah, 1987
// [Warren95]    J. Warren, Subdivision Methods for Geometric Design, 1995: the simpler beta
// [DeRose98]    T. DeRose, M. Kass, T. Truong, Subdivision Surfaces in Character Animation, SIGGRAPH 98
// [Biermann00]  H. Biermann, A. Levin, D. Zorin, Piecewise Smooth Subdivision Surfaces with Normal Control

#include <span>
#include <string_view>

#include "core/base/pace.h"
#include "core/schemes/scheme.h"

namespace subdivd {

// beta(n) of the smooth vertex point. The two agree at valences 3 and 6 only.
enum class LoopWeights { loop, warren };

// What takes a pace has one weight for each edge of a ring that may have millions.
struct Loop {
  static constexpr std::string_view name = "loop";
  static constexpr Split split = Split::triangles;
  static constexpr FaceSizes face_sizes{3, 3};
  static constexpr Index regular_valence = 6;
  static constexpr Index flat_corner_faces = 2;

  LoopWeights weights = LoopWeights::loop;

  static std::span<const SchemeOption<Loop>> options();
  // See beyond_opensubdiv() of all.h.
  std::string_view beyond_opensubdiv() const;

  // Weight of each neighbour in the smooth vertex point of valence n >= 1.
  //   Loop:   beta(n) = (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n        [Loop87]
  //   Warren: beta(n) = 3 / (8 n), 3/16 at n = 3                       [Warren95]
  double beta(Index n) const;

  // smooth 3/8 (a + b) + 1/8 (o0 + o1), crease or border 1/2 (a + b)      [Loop87]
  // k faces share the opposite weight: 1/8 * 2/k each                     [Far 3.5 for k != 2]
  // A sharpness below 1 that runs out blends the two.                     [DeRose98]
  EdgeMask edge_mask(const EdgeRing& ring) const;
  // smooth (1 - n beta) v + beta sum e; crease 3/4 v + 1/8 (e_a + e_b); corner v; blended by the fractional
  // weight when the rule changes with the next level. A ring without faces stays where it is.
  VertexMask vertex_mask(const VertexRing& ring) const;

  // smooth: (1 - n e) v + e sum e_k, e = 1 / (n + 3 / (8 beta)).
  VertexMask smooth_limit_mask(Index n) const;
  // crease: 1/6 e_a + 2/3 v + 1/6 e_b, the limit of 1/8, 3/4, 1/8 at any number of faces. The often printed
  // 1/5, 3/5, 1/5 belongs to another edge rule (5/8, 3/8) and would not survive a refinement.
  VertexMask crease_limit_mask(Index a, Index b) const;
  // dart: the vertex point is the smooth one but the edge point on the crease (edge 0) is 1/2, 1/2, so the
  // smooth limit mask is no eigenvector here. Derivation in loop.cpp.
  RingMask dart_limit_mask(Index n, const Pace& pace = {}) const;

  // Tangents at a smooth vertex: sum cos(2 pi k / n) e_k and sum sin(2 pi k / n) e_k; they shrink by
  // (3 + 2 cos(2 pi / n)) / 8 a level. Ring counter-clockwise: the cross product points outwards.
  RingMask smooth_tangent_u(Index n, const Pace& pace = {}) const;
  RingMask smooth_tangent_v(Index n, const Pace& pace = {}) const;
  // At a dart whose crease is edge 0: the sine is the same; the cosine's place is taken by the dominant
  // eigenvector that is symmetric about the crease, found by iteration (no closed form for all n).
  RingMask dart_tangent_u(Index n, const Pace& pace = {}) const;
  // Across a sector of m >= 1 faces between two crease edges 0 and m; with theta = pi / m
  //   e_0, e_m: -cos(theta) cot(theta / 2) / (1 + 2 cos(theta)),   e_i: sin(i theta),   v: minus the sum;
  // m = 1: e_0 + e_1 - 2 v.  m = 2: e_1 - v.  It is a left eigenvector for 3/8 + cos(theta) / 4 (m = 1: 1/4).
  // The tangent along the crease is e_0 - e_m, eigenvalue 1/2.
  RingMask crease_tangent_across(Index m, const Pace& pace = {}) const;
};

}  // namespace subdivd

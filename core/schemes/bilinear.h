#pragma once
// Bilinear subdivision of polygon meshes: points stay, edges get their midpoints, faces the mean of their
// vertices. Sharpness plays no part. The limit is made of bilinear patches, which meet at an angle: tangents at
// edges and vertices are those of a plane between them.

#include <span>
#include <string_view>

#include "core/base/pace.h"
#include "core/schemes/scheme.h"

namespace subdivd {

struct Bilinear {
  static constexpr std::string_view name = "bilinear";
  static constexpr Split split = Split::quads;
  static constexpr FaceSizes face_sizes{3, kNoIndex};
  static constexpr Index regular_valence = 4;
  static constexpr Index flat_corner_faces = 1;
  // A face's points depend on it alone: with interpolateBoundary none nothing is missing at borders.  [Far 3.5]
  static constexpr bool needs_neighbors = false;

  static std::span<const SchemeOption<Bilinear>> options() { return {}; }
  // See beyond_opensubdiv() of all.h.
  std::string_view beyond_opensubdiv() const { return {}; }

  static EdgeMask edge_mask(const EdgeRing&) { return {}; }
  static VertexMask vertex_mask(const VertexRing&) { return {}; }

  // Points are limit points.
  static VertexMask smooth_limit_mask(Index) { return {}; }
  static VertexMask crease_limit_mask(Index, Index) { return {}; }
  static RingMask dart_limit_mask(Index n, const Pace& pace = {});

  // Every e_k - v shrinks by 1/2 a level. With t = 2 pi / n, or pi / m across a sector of m faces:
  //   u: cos(k t) e_k, v: sin(k t) e_k, n = 2: e_0 - e_1, d_0 - d_1;  across: sin(k t) (e_k - v), m = 1: e_0 + e_1 - 2 v.
  static RingMask smooth_tangent_u(Index n, const Pace& pace = {});
  static RingMask smooth_tangent_v(Index n, const Pace& pace = {});
  static RingMask dart_tangent_u(Index n, const Pace& pace = {}) { return smooth_tangent_u(n, pace); }
  static RingMask crease_tangent_across(Index m, const Pace& pace = {});
};

}  // namespace subdivd

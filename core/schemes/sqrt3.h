#pragma once
// Kobbelt's sqrt(3) subdivision of triangle meshes: every mask of a step, its formula, its source.
//
// [Kobbelt00]  L. Kobbelt, sqrt(3)-Subdivision, SIGGRAPH 2000

#include <span>
#include <string_view>

#include "core/schemes/scheme.h"

namespace subdivd {

// The point of a face is its centroid. Borders and infinitely sharp edges are cut into three every second step, by the
// ternary rule of cubic B-splines: new points (1, 16, 10) / 27 and (10, 16, 1) / 27, old ones (4, 19, 4) / 27. They
// stand with the split (core/engine/plain/centroid_rows.h).     [Kobbelt00, section 6]
struct Sqrt3 {
  static constexpr std::string_view name = "sqrt3";
  static constexpr Split split = Split::centroids;
  static constexpr FaceSizes face_sizes{3, 3};
  static constexpr Index regular_valence = 6;
  static constexpr bool takes_semi_sharp = false;

  static std::span<const SchemeOption<Sqrt3>> options() { return {}; }
  // See beyond_opensubdiv() of all.h.
  std::string_view beyond_opensubdiv() const { return "does not know this scheme: leave out verify"; }

  // alpha(n) = (4 - 2 cos(2 pi / n)) / 9     [Kobbelt00]
  static double alpha(Index n);
  // A smooth vertex of valence n: (1 - alpha) v + alpha (e_0 + ... + e_{n-1}) / n.
  VertexMask vertex_mask(Index n) const;
  // Its limit: (v + 3 alpha (e_0 + ... + e_{n-1}) / n) / (1 + 3 alpha).
  VertexMask limit_mask(Index n) const;
};

}  // namespace subdivd

#pragma once
// Bilinear subdivision of polygon meshes: points stay, edges get their midpoints, faces the mean of their
// vertices. Sharpness plays no part.

#include <string_view>

#include "core/schemes/scheme.h"

namespace subdivd {

struct Bilinear {
  static constexpr std::string_view name = "bilinear";
  static constexpr Split split = Split::quads;
  static constexpr FaceSizes face_sizes{3, kNoIndex};
  static constexpr Index regular_valence = 4;

  static EdgeMask edge_mask(const EdgeRing&) { return {}; }
  static VertexMask vertex_mask(const VertexRing&) { return {}; }
};

}  // namespace subdivd

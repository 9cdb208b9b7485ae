#pragma once
// Vertex attributes by name, and the modes of primitives.

#include <string_view>

#include "core/base/index.h"

namespace subdivd::proto::gltf {

enum class Semantic {
  position,
  normal,    // recomputed
  tangent,   // dropped
  texcoord,  // TEXCOORD_n
  color,     // COLOR_n
  skinning,  // JOINTS_n, WEIGHTS_n
  custom,    // _ANYTHING
  unknown,
};
Semantic semantic_of(std::string_view name);
// Whether values of this semantic are refined along with the surface or curve.
inline bool is_channel(Semantic semantic) {
  return semantic == Semantic::texcoord || semantic == Semantic::color || semantic == Semantic::custom;
}

enum Mode : Count { kPoints, kLines, kLineLoop, kLineStrip, kTriangles, kTriangleStrip, kTriangleFan };

}  // namespace subdivd::proto::gltf

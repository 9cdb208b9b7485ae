#include "proto/gltf/semantics.h"

#include <algorithm>

namespace subdivd::proto::gltf {

Semantic semantic_of(std::string_view name) {
  if (name == "POSITION") return Semantic::position;
  if (name == "NORMAL") return Semantic::normal;
  if (name == "TANGENT") return Semantic::tangent;
  if (name.size() > 1 && name.front() == '_') return Semantic::custom;
  const auto numbered = [name](std::string_view prefix) {
    if (!name.starts_with(prefix) || name.size() == prefix.size() || name.size() > prefix.size() + 4)
      return false;
    return std::all_of(name.begin() + static_cast<std::ptrdiff_t>(prefix.size()), name.end(),
                       [](char c) { return c >= '0' && c <= '9'; });
  };
  if (numbered("TEXCOORD_")) return Semantic::texcoord;
  if (numbered("COLOR_")) return Semantic::color;
  if (numbered("JOINTS_") || numbered("WEIGHTS_")) return Semantic::skinning;
  return Semantic::unknown;
}

}  // namespace subdivd::proto::gltf

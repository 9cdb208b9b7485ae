#pragma once
// bufferViews and accessors, proved to lie within their buffers.

#include <optional>
#include <string_view>
#include <vector>

#include "proto/gltf/buffers.h"
#include "proto/gltf/json_tree.h"

namespace subdivd::proto::gltf {

// componentType of accessors.
enum Component : int { kByte = 5120, kUnsignedByte, kShort, kUnsignedShort, kUnsignedInt = 5125, kFloat };
Count component_size(Count component);  // 0 when there is no such component type

struct ViewInfo {
  Index buffer = 0;
  Count offset = 0, length = 0;
  Count stride = 0;  // 0: packed
};

struct AccessorInfo {
  std::optional<Index> view;  // none: zeros
  std::string_view type;      // SCALAR, VEC2, …
  Count component = 0, count = 0;
  Count components = 0;  // scalars per element
  bool normalized = false;
};

struct Layout {
  std::vector<ViewInfo> views;
  std::vector<AccessorInfo> accessors;
};

// Every element of every accessor, dense and sparse, can be read from `buffers` afterwards.
Result<Layout> check_layout(const Json& document, const Buffers& buffers, Work& work);

}  // namespace subdivd::proto::gltf

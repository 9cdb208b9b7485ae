#pragma once
#include <cstddef>
#include <vector>

#include "proto/gltf/buffers.h"
#include "proto/gltf/json_tree.h"

namespace subdivd::proto::gltf {

// Which accessors and bufferViews something refers to.
struct References {
  std::vector<bool> accessors, views;
};
Result<References> collect_references(const Json& document, Work& work);

// Removes accessors and bufferViews that were referred to `before` and no longer are, renumbers the rest, and
// puts the bytes of all remaining views into one buffer, which is returned. Views that overlap keep
// overlapping: copied one by one, 10^5 views of one buffer would fill the memory.
Result<std::vector<std::byte>> prune(Json& document, const References& before, const Buffers& buffers,
                                     Work& work);

// `out` must have room for them.
Result<void> append_bytes(std::vector<std::byte>& out, Bytes bytes, Work& work);

}  // namespace subdivd::proto::gltf

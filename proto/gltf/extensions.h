#pragma once
// What this version knows about glTF extensions.

#include <string_view>

#include "proto/gltf/json_tree.h"

namespace subdivd::proto::gltf {

// Known extensions either leave geometry alone or are understood while reading and patching: an asset may
// require them, and their members hold no reference to accessors or bufferViews but those that prune.cpp
// follows.
bool is_known_extension(std::string_view name);

// Whether any `extensions` object (outside of extras) has a member that is not known and not empty. It may
// refer to anything, so nothing of such an asset may be removed or renumbered.
Result<bool> has_unknown_extension(const Json& document, Work& work);

}  // namespace subdivd::proto::gltf

#pragma once
#include "core/base/result.h"
#include "proto/gltf/json_tree.h"
#include "proto/gltf/layout.h"
#include "proto/wire.h"

namespace subdivd::proto::gltf {

// The part of check_structure that is about `meshes`; references have been checked.
Result<void> check_meshes(const Json& document, const Layout& layout, const Limits& limits, Work& work);

}  // namespace subdivd::proto::gltf

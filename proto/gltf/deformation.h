#pragma once
#include <vector>

#include "core/base/result.h"
#include "proto/gltf/json_tree.h"
#include "proto/gltf/warnings.h"

namespace subdivd::proto::gltf {

// Removes from these meshes (a flag for each), and from all that depends on it, what moves vertices: morph
// targets and skinning belong to the control points and are not carried over to refined vertices by this
// version. Nodes lose `skin` and `weights`, animations their channels of weights.
Result<void> drop_deformation(Json& document, const std::vector<bool>& meshes, Warnings& warnings,
                              Work& work);

}  // namespace subdivd::proto::gltf

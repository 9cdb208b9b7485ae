#pragma once
#include <set>

#include "core/base/index.h"
#include "proto/gltf/json_tree.h"
#include "proto/gltf/warnings.h"

namespace subdivd::proto::gltf {

// Removes from these meshes, and from all that depends on it, what moves vertices: morph targets and skinning
// belong to the control points and are not carried over to refined vertices by this version. Nodes lose
// `skin` and `weights`, animations their channels of weights.
void drop_deformation(Json& document, const std::set<Index>& meshes, Warnings& warnings);

}  // namespace subdivd::proto::gltf

#pragma once
// tinygltf reads the structure of meshes from a document that has passed check_structure.
//
// It is given a reduced copy: meshes, accessors and bufferViews with the members of the specification alone.
// No buffers (their bytes would be decoded and copied again), no images (it would decode them), no extras.

#include <tiny_gltf.h>

#include "core/base/result.h"
#include "proto/gltf/json_tree.h"

namespace subdivd::proto::gltf {

Result<tinygltf::Model> load_structure(const Json& document);

}  // namespace subdivd::proto::gltf

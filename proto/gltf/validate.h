#pragma once
// Everything that will be read is proved right here, before the reader library or our own code relies on it.
// What is only passed through (materials, cameras, extras, …) is not judged.

#include "core/base/result.h"
#include "proto/gltf/buffers.h"
#include "proto/gltf/json_tree.h"
#include "proto/gltf/layout.h"
#include "proto/wire.h"

namespace subdivd::proto::gltf {

// The version, how many there are of everything (caps.h), and that nothing is required which this version
// does not know. Before buffers are decoded.
Result<void> check_asset(const Json& document, Work& work);

// References, the node forest, meshes. Also bounds what decoding the primitives will allocate: a thousand
// primitives may share one accessor, and an accessor without data may claim 2^32 elements.
Result<void> check_structure(const Json& document, const Layout& layout, const Limits& limits, Work& work);

}  // namespace subdivd::proto::gltf

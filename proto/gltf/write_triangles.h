#pragma once
#include "core/base/result.h"
#include "proto/gltf/output.h"
#include "proto/gltf/warnings.h"
#include "proto/wire.h"

namespace subdivd::proto::gltf {

// Fills the slot's primitive from the refined mesh. A primitive of which no triangle is left becomes one
// triangle without area: glTF has no empty primitives.
template <class Real>
Result<void> write_triangles(const TrianglesSlot& slot, RefinedMesh<Real>& mesh, Output& output,
                             Warnings& warnings, Work& work);

}  // namespace subdivd::proto::gltf

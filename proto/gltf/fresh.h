#pragma once
// glTF documents for requests that came as JSON: one node and one mesh for every ControlMesh, every
// ControlCurves and every ControlPatch, in that order.
//
//   primvars of 2 scalars named st, uv or map (with or without a number)  TEXCOORD_0, TEXCOORD_1, …
//   displayColor of 3 or 4 scalars                                        COLOR_0
//   others of 1..4 scalars                                                _NAME in capitals
// Constant and uniform primvars and those of more than 4 scalars have no place in glTF.

#include <string>
#include <vector>

#include "core/base/result.h"
#include "proto/gltf/source.h"
#include "proto/gltf/work.h"
#include "proto/wire.h"

namespace subdivd::proto::gltf {

// Adds one sentence for each thing that the document will not hold. Refuses more primitives than caps.h
// allows.
Result<Source> make_source(const RefineRequest& request, std::vector<std::string>& warnings, Work& work);

// The mesh's vertices as glTF needs them: one for each combination of a point and indices of the face-varying
// primvars that `slot` writes. `faces`: corners of triangles; `indices`: per primvar, one per corner.
struct SplitVertices {
  Index vertex_count = 0;
  std::vector<Index> indices;  // per corner
};
Result<SplitVertices> split_vertices(const std::vector<Index>& corners,
                                     const std::vector<const std::vector<Index>*>& indices, Work& work);

}  // namespace subdivd::proto::gltf

#pragma once
#include <span>
#include <vector>

#include "core/base/result.h"
#include "proto/gltf/primitive.h"
#include "proto/gltf/source.h"
#include "proto/wire.h"

namespace subdivd::proto::gltf {

struct ReadMesh {
  ControlMesh mesh;                  // render_meshes in the order of `slots`
  std::vector<TrianglesSlot> slots;  // mesh and primitive set; control_mesh is not
  bool has_normals = false;          // any of its primitives had them
};

// All triangle primitives of a glTF mesh as one control mesh; no slots: it has none. Vertices that no
// triangle uses are left out.
Result<ReadMesh> read_triangles(const Asset& asset, Index mesh, const Options& options, const Limits& limits,
                                const Place& place);

// Corners of triangles out of the corners of a list, strip or fan. Triangles that join strips (they repeat a
// vertex) are left out of strips and fans.  [glTF 2.0, 3.7.2.1]
Result<std::vector<Index>> to_triangle_list(std::vector<Index> corners, Count mode, Work& work);

}  // namespace subdivd::proto::gltf

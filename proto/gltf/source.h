#pragma once
// What an answer is written into: a glTF document without the parts that refinement replaces, and where the
// refined parts go. For a JSON request it is made anew (fresh.h), otherwise patched (patch.h).

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/index.h"
#include "proto/gltf/json_tree.h"
#include "proto/gltf/semantics.h"

namespace subdivd::proto::gltf {

// A vertex attribute of the output.
struct AttributeSlot {
  std::string name;      // TEXCOORD_0, …
  Index primvar = 0;     // of surfaces: which of ControlMesh::primvars
  Index offset = 0;      // of curves: its first scalar within a point
  Index components = 1;  // 1..4, a prefix of the primvar's scalars
};

struct TrianglesSlot {
  Index mesh = 0, primitive = 0;  // in the document
  Index control_mesh = 0;         // in the request; of surfaces: which of them
  Index render_mesh = kNoIndex;   // of the control mesh; kNoIndex: every point is a vertex
  bool normals = false;
  bool ngons = false;  // tell which triangles make a larger face (ngons.h)
  std::vector<AttributeSlot> attributes;
};

struct CurvesSlot {
  Index mesh = 0, primitive = 0;  // in the document
  Count mode = kLineStrip;        // kLines: all curves of `curves`, segment by segment
  std::vector<Index> curves;      // in the request
  Index ordinal = 0;              // unless kLines: which curve of the single element of `curves`
  std::vector<AttributeSlot> attributes;
};

class Source {
 public:
  Json document;
  std::vector<std::byte> data;  // what buffer 0 holds already; a multiple of 4 bytes
  std::vector<TrianglesSlot> triangles;
  std::vector<CurvesSlot> curves;
  std::vector<TrianglesSlot> surfaces;  // without render meshes and attributes
  struct Foreign {
    std::uint32_t type;
    std::vector<std::byte> bytes;
  };
  std::vector<Foreign> foreign;  // GLB chunks of unknown type, appended to a GLB answer
};

}  // namespace subdivd::proto::gltf

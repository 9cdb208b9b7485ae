#pragma once
// The values of one primitive as the readers of surfaces and curves need them.

#include <string>
#include <vector>

#include "core/base/result.h"
#include "proto/gltf/accessors.h"
#include "proto/gltf/fields.h"
#include "proto/gltf/semantics.h"
#include "proto/gltf/warnings.h"

namespace subdivd::proto::gltf {

// What the readers read from; outlives them.
struct Asset {
  const tinygltf::Model& model;
  const Buffers& buffers;
  Warnings& warnings;
};

struct PrimitiveChannel {
  std::string name;
  Index components = 1;        // 1..4
  std::vector<double> values;  // components per vertex
};

struct PrimitiveData {
  Index vertex_count = 0;
  Index position_accessor = 0;
  std::vector<double> positions;           // 3 per vertex, finite
  std::vector<Index> corners;              // the indices, or 0, 1, 2, …; each < vertex_count
  std::vector<PrimitiveChannel> channels;  // texture coordinates, colours, custom attributes; finite
  bool has_normals = false;
};

// Warns of attributes that are left behind.
Result<PrimitiveData> read_primitive(const Asset& asset, const tinygltf::Primitive& primitive,
                                     const Place& place);

}  // namespace subdivd::proto::gltf

#pragma once
// What the readers of surfaces and curves need of one primitive: how it is put together, and the values of
// the vertices that it uses.

#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "proto/gltf/accessors.h"
#include "proto/gltf/fields.h"
#include "proto/gltf/semantics.h"
#include "proto/gltf/warnings.h"

namespace subdivd::proto::gltf {

// What the readers read from; outlives them.
struct Asset {
  const Json::Array& meshes;
  Elements elements;
  Warnings& warnings;
  Work& work;
};

// The mesh's name as messages and statistics repeat it: cut, because every line primitive repeats it.
std::string short_name(const Json& mesh);

// The mode of a checked primitive.
Count mode_of(const Json& primitive);

// Texture coordinates, colours, custom attributes.
struct PrimitiveChannel {
  std::string_view name;  // of the document's
  Index accessor = 0;
  Index components = 1;  // 1..4
};

struct PrimitiveData {
  Index vertex_count = 0;
  Index position_accessor = 0;
  std::vector<Index> corners;  // the indices, or 0, 1, 2, …; each < vertex_count
  std::vector<Index>
      original;  // of every vertex its number in the accessors, ascending; empty: they are the same
  std::vector<PrimitiveChannel> channels;  // by name
  bool has_normals = false;
};

// All vertices, whether used or not. Warns of attributes that are left behind. The memory is kept.
Result<PrimitiveData> read_primitive(const Asset& asset, const Json& primitive, const Place& place);

// Takes out the vertices that no corner uses; returns how many.
Result<Index> leave_out_unused(PrimitiveData& data, Work& work);

// Appends what the vertices have in this accessor; refuses what is not finite. `out` should have room for it.
Result<void> append_values(const Asset& asset, const PrimitiveData& data, Index accessor, const Place& place,
                           std::vector<double>& out);

}  // namespace subdivd::proto::gltf

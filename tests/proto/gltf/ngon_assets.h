#pragma once
// Assets whose triangles are pieces of polygons, by FB_ngon_encoding.

#include <cstddef>

#include "tests/support/gltf_builder.h"

namespace subdivd::test {

// Of the first mesh.
OrderedJson& primitive_of(GltfBuilder& builder, std::size_t primitive = 0);
void encode_ngons(GltfBuilder& builder, std::size_t primitive = 0);

// Two quads whose common edge has other texture coordinates on either side.
GltfBuilder seamed_quads();

}  // namespace subdivd::test

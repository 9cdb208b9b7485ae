#include "tests/proto/gltf/ngon_assets.h"

#include <cstdint>

namespace subdivd::test {

OrderedJson& primitive_of(GltfBuilder& builder, std::size_t primitive) {
  return builder.document()["meshes"][0]["primitives"][primitive];
}

void encode_ngons(GltfBuilder& builder, std::size_t primitive) {
  builder.document()["extensionsUsed"] = {"FB_ngon_encoding"};
  primitive_of(builder, primitive)["extensions"]["FB_ngon_encoding"] = OrderedJson::object();
}

GltfBuilder seamed_quads() {
  GltfBuilder builder;
  const int positions = builder.values<float>(
      {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 0, 2, 0, 0.5f, 2, 1, 0.5f, 1, 1, 0}, 3);
  const int coordinates = builder.values<float>({0, 0, 1, 0, 1, 1, 0, 1, 5, 0, 6, 0, 6, 1, 5, 1}, 2);
  builder.mesh({{"POSITION", positions}, {"TEXCOORD_0", coordinates}},
               builder.values<std::uint8_t>({0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}, 1));
  builder.document()["accessors"][0]["min"] = {0, 0, 0};
  builder.document()["accessors"][0]["max"] = {2, 1, 0.5};
  encode_ngons(builder);
  return builder;
}

}  // namespace subdivd::test

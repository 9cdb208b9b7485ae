#include "tests/proto/gltf/attacks.h"

#include <cstdint>
#include <cstring>

#include "tests/support/gltf_builder.h"

namespace subdivd::test {
namespace {

constexpr const char* kAsset = R"({"asset":{"version":"2.0"},)";

std::string number(std::size_t value) { return std::to_string(value); }

// Appends `one(i)` for i < count, with commas between.
template <class F>
std::string list(std::size_t count, const F& one) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += ',';
    text += one(i);
  }
  return text;
}

template <class T>
void append(std::string& bytes, T value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

// Positions on a line that bends, `count` of them.
std::string positions(std::size_t count) {
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i)
    for (const std::size_t x : {i, i * i % 101, i % 7}) append(bytes, static_cast<float>(x));
  return bytes;
}

std::string view(std::size_t offset, std::size_t length) {
  return R"({"buffer":0,"byteOffset":)" + number(offset) + R"(,"byteLength":)" + number(length) + "}";
}

std::string accessor(std::size_t view, int component, std::size_t count, const char* type) {
  return R"({"bufferView":)" + number(view) + R"(,"componentType":)" + std::to_string(component) +
         R"(,"count":)" + number(count) + R"(,"type":")" + type + "\"}";
}

std::string buffers(std::size_t size) { return R"("buffers":[{"byteLength":)" + number(size) + "}]"; }

// A document of meshes, accessors and views over `bin`.
std::string asset(const std::string& meshes, const std::string& accessors, const std::string& views,
                  const std::string& bin, const std::string& more = {}) {
  return make_glb(kAsset + more + R"("meshes":[)" + meshes + R"(],"accessors":[)" + accessors +
                      R"(],"bufferViews":[)" + views + "]," + buffers(bin.size()) + "}",
                  bin);
}

constexpr const char* kTriangle = R"({"attributes":{"POSITION":0}})";

std::string sparse_accessors_on_one_list(std::size_t size) {
  std::string bin = positions(3);
  for (std::size_t i = 0; i < size * 64; ++i) append(bin, static_cast<std::uint32_t>(i));
  const std::size_t count = size * 64;
  const std::string sparse = list(size, [&](std::size_t i) {
    // Every one its own length, so that no two are the same.
    return R"({"componentType":5121,"count":)" + number(count) + R"(,"type":"SCALAR","sparse":{"count":)" +
           number(count - i) +
           R"(,"indices":{"bufferView":1,"componentType":5125},"values":{"bufferView":1}}})";
  });
  return asset(R"({"primitives":[)" + std::string(kTriangle) + "]}",
               accessor(0, 5126, 3, "VEC3") + "," + sparse, view(0, 36) + "," + view(36, count * 4), bin);
}

std::string sparse_lists_that_overlap(std::size_t size) {
  std::string bin = positions(3);
  const std::size_t count = size * 64;
  for (std::size_t i = 0; i < count + size; ++i) append(bin, static_cast<std::uint32_t>(i));
  const std::string sparse = list(size, [&](std::size_t i) {
    return R"({"componentType":5121,"count":)" + number(count + size) +
           R"(,"type":"SCALAR","sparse":{"count":)" + number(count) +
           R"(,"indices":{"bufferView":1,"componentType":5125,"byteOffset":)" + number(4 * i) +
           R"(},"values":{"bufferView":1}}})";
  });
  return asset(R"({"primitives":[)" + std::string(kTriangle) + "]}",
               accessor(0, 5126, 3, "VEC3") + "," + sparse, view(0, 36) + "," + view(36, (count + size) * 4),
               bin);
}

std::string attributes_on_one_primitive(std::size_t size) {
  const std::string more = list(size, [](std::size_t i) { return "\"_A" + number(i) + "\":1"; });
  return asset(R"({"primitives":[{"attributes":{"POSITION":0,)" + more + "}}]}",
               accessor(0, 5126, 3, "VEC3") + "," + accessor(0, 5126, 3, "SCALAR"), view(0, 36),
               positions(3));
}

std::string root_members_before_primitives(std::size_t size) {
  const std::string junk = list(size, [](std::size_t i) { return "\"x" + number(i) + "\":0"; }) + ",";
  const std::string primitives = list(size / 50 + 1, [](std::size_t) { return std::string(kTriangle); });
  return asset(R"({"primitives":[)" + primitives + "]}", accessor(0, 5126, 3, "VEC3"), view(0, 36),
               positions(3), junk);
}

std::string many_primitives(std::size_t size) {
  return asset(R"({"primitives":[)" + list(size, [](std::size_t) { return std::string(kTriangle); }) + "]}",
               accessor(0, 5126, 3, "VEC3"), view(0, 36), positions(3));
}

std::string many_meshes(std::size_t size) {
  return asset(list(size, [](std::size_t) { return R"({"primitives":[)" + std::string(kTriangle) + "]}"; }),
               accessor(0, 5126, 3, "VEC3"), view(0, 36), positions(3));
}

std::string primitives_on_one_long_accessor(std::size_t size) {
  std::string bin = positions(size * 64);
  const std::size_t at = bin.size();
  for (std::uint32_t i = 0; i < 3; ++i) append(bin, i * static_cast<std::uint32_t>(size) * 20);
  const std::string primitives =
      list(size, [](std::size_t) { return std::string(R"({"attributes":{"POSITION":0},"indices":1})"); });
  return asset(R"({"primitives":[)" + primitives + "]}",
               accessor(0, 5126, size * 64, "VEC3") + "," + accessor(1, 5125, 3, "SCALAR"),
               view(0, at) + "," + view(at, 12), bin);
}

std::string line_primitives_of_a_long_name(std::size_t size) {
  const std::string primitives =
      list(size, [](std::size_t) { return std::string(R"({"attributes":{"POSITION":0},"mode":3})"); });
  return asset(R"({"name":")" + std::string(size * 64, 'n') + R"(","primitives":[)" + primitives + "]}",
               accessor(0, 5126, 3, "VEC3"), view(0, 36), positions(3));
}

std::string lines_on_one_long_accessor(std::size_t size) {
  std::string bin = positions(size * 64);
  const std::size_t at = bin.size();
  for (std::uint32_t i = 0; i < 4; ++i) append(bin, i * static_cast<std::uint32_t>(size) * 16);
  const std::string primitives = list(
      size, [](std::size_t) { return std::string(R"({"attributes":{"POSITION":0},"indices":1,"mode":1})"); });
  return asset(R"({"primitives":[)" + primitives + "]}",
               accessor(0, 5126, size * 64, "VEC3") + "," + accessor(1, 5125, 4, "SCALAR"),
               view(0, at) + "," + view(at, 16), bin);
}

std::string names_of_every_primitive_its_own(std::size_t size) {
  const std::string primitives =
      list(size, [](std::size_t i) { return R"({"attributes":{"POSITION":0,"_A)" + number(i) + R"(":0}})"; });
  return asset(R"({"primitives":[)" + primitives + "]}", accessor(0, 5126, 3, "VEC3"), view(0, 36),
               positions(3));
}

std::string unused_vertices_of_every_number(std::size_t size) {
  std::string bin = positions(size * 8 + 4);
  const std::size_t at = bin.size();
  for (std::uint32_t i = 0; i < 4; ++i) append(bin, i);
  const std::string primitives = list(size, [](std::size_t i) {
    return R"({"attributes":{"POSITION":)" + number(i + 1) + R"(},"indices":0})";
  });
  const std::string accessors = list(size, [](std::size_t i) { return accessor(0, 5126, i + 4, "VEC3"); });
  return asset(R"({"primitives":[)" + primitives + "]}", accessor(1, 5125, 3, "SCALAR") + "," + accessors,
               view(0, at) + "," + view(at, 16), bin);
}

std::string skins_of_many_joints(std::size_t size) {
  const std::string nodes =
      R"({"mesh":0,"skin":0},)" + list(size * 8, [](std::size_t) { return std::string("{}"); });
  const std::string skins = list(size, [](std::size_t i) { return R"({"joints":[)" + number(i) + "]}"; });
  return asset(R"({"primitives":[)" + std::string(kTriangle) + "]}", accessor(0, 5126, 3, "VEC3"),
               view(0, 36), positions(3), R"("nodes":[)" + nodes + R"(],"skins":[)" + skins + "],");
}

std::string channels_on_weights(std::size_t size) {
  const std::string channels = list(size * 8, [](std::size_t i) {
    return R"({"sampler":)" + number(i) + R"(,"target":{"node":0,"path":")" +
           (i % 2 == 0 ? "weights" : "scale") + "\"}}";
  });
  const std::string samplers =
      list(size * 8, [](std::size_t) { return std::string(R"({"input":0,"output":0})"); });
  return asset(R"({"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":0}]}]})",
               accessor(0, 5126, 3, "VEC3"), view(0, 36), positions(3),
               R"("nodes":[{"mesh":0}],"animations":[{"channels":[)" + channels + R"(],"samplers":[)" +
                   samplers + "]}],");
}

std::string node_chain(std::size_t size) {
  const std::string nodes = list(size * 8, [&](std::size_t i) {
    return i + 1 < size * 8 ? R"({"children":[)" + number(i + 1) + "]}" : std::string(R"({"mesh":0})");
  });
  return asset(R"({"primitives":[)" + std::string(kTriangle) + "]}", accessor(0, 5126, 3, "VEC3"),
               view(0, 36), positions(3), R"("nodes":[)" + nodes + "],");
}

std::string morph_targets(std::size_t size) {
  const std::string targets =
      list(size * 8, [](std::size_t) { return std::string(R"({"POSITION":0,"NORMAL":0})"); });
  return asset(R"({"primitives":[{"attributes":{"POSITION":0},"targets":[)" + targets + "]}]}",
               accessor(0, 5126, 3, "VEC3"), view(0, 36), positions(3));
}

std::string extensions_used(std::size_t size) {
  const std::string names = list(size * 8, [](std::size_t i) { return "\"EXT_" + number(i) + "\""; });
  return asset(R"({"primitives":[)" + std::string(kTriangle) + "]}", accessor(0, 5126, 3, "VEC3"),
               view(0, 36), positions(3), R"("extensionsUsed":[)" + names + "],");
}

std::string views_that_overlap(std::size_t size) {
  const std::string bin = positions(size * 64);
  const std::string images =
      list(size, [](std::size_t i) { return R"({"mimeType":"image/png","bufferView":)" + number(i) + "}"; });
  return asset(R"({"primitives":[)" + std::string(kTriangle) + "]}", accessor(0, 5126, 3, "VEC3"),
               list(size, [&](std::size_t i) { return view(4 * i, bin.size() - 4 * i); }), bin,
               R"("images":[)" + images + "],");
}

std::string keys_with_one_long_beginning(std::size_t size) {
  const std::string beginning(size, 'k');
  const std::string members =
      list(size, [&](std::size_t i) { return "\"" + beginning + number(i) + "\":0"; });
  return asset(R"({"primitives":[)" + std::string(kTriangle) + "]}", accessor(0, 5126, 3, "VEC3"),
               view(0, 36), positions(3), R"("extras":{)" + members + "},");
}

std::string embedded_buffers(std::size_t size) {
  const std::string one =
      R"({"byteLength":36,"uri":"data:application/octet-stream;base64,)" + base64(positions(3)) + "\"}";
  return kAsset + std::string(R"("meshes":[{"primitives":[)") + kTriangle + R"(]}],"accessors":[)" +
         accessor(0, 5126, 3, "VEC3") + R"(],"bufferViews":[)" + view(0, 36) + R"(],"buffers":[)" +
         list(size, [&](std::size_t) { return one; }) + "]}";
}

std::string accessors_without_data(std::size_t size) {
  const std::string primitives =
      list(64, [](std::size_t) { return std::string(R"({"attributes":{"POSITION":0,"_A":0}})"); });
  return asset(R"({"primitives":[)" + primitives + "]}",
               R"({"componentType":5126,"count":)" + number(size * 300) + R"(,"type":"VEC3"})", view(0, 36),
               positions(3));
}

std::string one_face_of_many_triangles(std::size_t size) {
  std::string bin = positions(size + 2);
  const std::size_t begin = bin.size();
  for (std::size_t i = 0; i < size; ++i)
    for (const std::size_t corner : {std::size_t{0}, i + 1, i + 2})
      append(bin, static_cast<std::uint32_t>(corner));
  return asset(
      R"({"primitives":[{"attributes":{"POSITION":0},"indices":1,"extensions":{"FB_ngon_encoding":{}}}]})",
      accessor(0, 5126, size + 2, "VEC3") + ',' + accessor(1, 5125, 3 * size, "SCALAR"),
      view(0, begin) + ',' + view(begin, bin.size() - begin), bin);
}

}  // namespace

const std::vector<Attack>& attacks() {
  using proto::Format;
  static const std::vector<Attack> all = {
      {"sparse_accessors_on_one_list", Format::glb, sparse_accessors_on_one_list, 16000},
      {"sparse_lists_that_overlap", Format::glb, sparse_lists_that_overlap, 16000},
      {"attributes_on_one_primitive", Format::glb, attributes_on_one_primitive, 50000},
      {"root_members_before_primitives", Format::glb, root_members_before_primitives, 500000},
      {"many_primitives", Format::glb, many_primitives, 60000},
      {"many_meshes", Format::glb, many_meshes, 60000},
      {"primitives_on_one_long_accessor", Format::glb, primitives_on_one_long_accessor, 16000},
      {"line_primitives_of_a_long_name", Format::glb, line_primitives_of_a_long_name, 60000},
      {"lines_on_one_long_accessor", Format::glb, lines_on_one_long_accessor, 16000},
      {"names_of_every_primitive_its_own", Format::glb, names_of_every_primitive_its_own, 30000},
      {"unused_vertices_of_every_number", Format::glb, unused_vertices_of_every_number, 30000},
      {"skins_of_many_joints", Format::glb, skins_of_many_joints, 30000},
      {"channels_on_weights", Format::glb, channels_on_weights, 10000},
      {"node_chain", Format::glb, node_chain, 30000},
      {"morph_targets", Format::glb, morph_targets, 30000},
      {"extensions_used", Format::glb, extensions_used, 100000},
      {"views_that_overlap", Format::glb, views_that_overlap, 60000},
      {"keys_with_one_long_beginning", Format::glb, keys_with_one_long_beginning, 4000},
      {"embedded_buffers", Format::gltf, embedded_buffers, 100000},
      {"accessors_without_data", Format::glb, accessors_without_data, 1000},
      {"one_face_of_many_triangles", Format::glb, one_face_of_many_triangles, 100000},
  };
  return all;
}

}  // namespace subdivd::test

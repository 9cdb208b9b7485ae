// FB_ngon_encoding in answers: faces are told apart, and come back when they are read again.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "proto/decode.h"
#include "tests/proto/gltf/ngon_assets.h"
#include "tests/proto/gltf/pipeline.h"
#include "tests/support/gltf_builder.h"

namespace subdivd::test {
namespace {

using proto::Options;
using testing::ElementsAre;
using testing::HasSubstr;

Options with_ngons(Index level) {
  Options options;
  options.level = level;
  options.ngons = true;
  return options;
}

std::vector<Index> indices_of(const ParsedGlb& glb, const OrderedJson& primitive) {
  const OrderedJson& accessor = glb.json["accessors"][primitive["indices"].get<std::size_t>()];
  const OrderedJson& view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  const std::size_t begin = view.value("byteOffset", std::size_t{0});
  std::vector<Index> indices;
  for (std::size_t i = 0; i < accessor["count"].get<std::size_t>(); ++i) {
    std::uint16_t narrow = 0;
    std::uint32_t wide = 0;
    if (accessor["componentType"] == 5123) {
      std::memcpy(&narrow, glb.bin.data() + begin + 2 * i, 2);
      indices.push_back(narrow);
    } else {
      std::memcpy(&wide, glb.bin.data() + begin + 4 * i, 4);
      indices.push_back(wide);
    }
  }
  return indices;
}

// As the extension's text has it: triangles that share their first corner are one face.
std::vector<std::size_t> sizes_of_faces(const std::vector<Index>& indices) {
  std::vector<std::size_t> sizes;
  for (std::size_t t = 0; t < indices.size(); t += 3)
    if (t > 0 && indices[t] == indices[t - 3])
      ++sizes.back();
    else
      sizes.push_back(3);
  return sizes;
}

bool is_marked(const OrderedJson& json, std::size_t primitive = 0) {
  const OrderedJson& extensions =
      json["meshes"][0]["primitives"][primitive].value("extensions", OrderedJson());
  const OrderedJson used = json.value("extensionsUsed", OrderedJson::array());
  const bool marked = extensions.contains("FB_ngon_encoding");
  EXPECT_EQ(marked, std::ranges::count(used, "FB_ngon_encoding") == 1);
  if (marked) {
    EXPECT_EQ(extensions["FB_ngon_encoding"], OrderedJson::object());
  }
  return marked;
}

TEST(WriteNgons, marks_quads_and_tells_them_apart) {
  for (const Index level : {0u, 1u, 2u, 3u}) {
    const Outcome outcome = must_refine(seamed_quads().glb(), with_ngons(level));
    const ParsedGlb glb = parse_glb(outcome.bytes);
    EXPECT_TRUE(is_marked(glb.json));
    const auto sizes = sizes_of_faces(indices_of(glb, glb.json["meshes"][0]["primitives"][0]));
    EXPECT_EQ(sizes, std::vector<std::size_t>(std::size_t{2} << (2 * level), 4)) << level;
    EXPECT_LE(outcome.bytes.size(), outcome.predicted);
  }
}

// The list of extensions, which the answer's document did not have, was made between the two: it moved the meshes.
TEST(WriteNgons, marks_every_primitive) {
  GltfBuilder builder = seamed_quads();
  builder.primitive(primitive_of(builder)["attributes"], builder.values<std::uint8_t>({4, 5, 6, 4, 6, 7}, 1));
  encode_ngons(builder, 1);
  const OrderedJson json = parse_glb(must_refine(builder.glb(), with_ngons(1)).bytes).json;
  EXPECT_TRUE(is_marked(json, 0));
  EXPECT_TRUE(is_marked(json, 1));
}

TEST(WriteNgons, leaves_meshes_of_triangles_as_they_are) {
  const Outcome marked = must_refine(seamed_octahedron().glb(), with_ngons(1));
  EXPECT_FALSE(is_marked(parse_glb(marked.bytes).json));
}

TEST(WriteNgons, changes_but_the_mark_where_faces_begin_apart) {
  Options plain;
  plain.level = 2;
  const ParsedGlb without = parse_glb(must_refine(seamed_quads().glb(), plain).bytes),
                  with = parse_glb(must_refine(seamed_quads().glb(), with_ngons(2)).bytes);
  EXPECT_EQ(without.bin, with.bin);
  EXPECT_FALSE(is_marked(without.json));
}

TEST(WriteNgons, keeps_the_extensions_that_there_are) {
  GltfBuilder builder = seamed_quads();
  primitive_of(builder)["extensions"]["KHR_materials_variants"] = {{"mappings", OrderedJson::array()}};
  builder.document()["extensionsUsed"] = {"FB_ngon_encoding", "KHR_materials_variants"};
  const OrderedJson json = parse_glb(must_refine(builder.glb(), with_ngons(1)).bytes).json;
  EXPECT_TRUE(is_marked(json));
  EXPECT_TRUE(json["meshes"][0]["primitives"][0]["extensions"].contains("KHR_materials_variants"));
  EXPECT_THAT(json["extensionsUsed"], ElementsAre("KHR_materials_variants", "FB_ngon_encoding"));
}

// What a caller sees of a mesh: its faces as positions and texture coordinates, from the least on.
std::vector<std::vector<std::vector<double>>> shape_of(const ControlMesh& mesh) {
  std::vector<std::vector<std::vector<double>>> faces;
  std::size_t corner = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    auto& face = faces.emplace_back();
    for (Index k = 0; k < mesh.face_size(f); ++k, ++corner) {
      const std::size_t point = mesh.face_vertex_indices[corner];
      auto& values = face.emplace_back(mesh.points.begin() + static_cast<std::ptrdiff_t>(3 * point),
                                       mesh.points.begin() + static_cast<std::ptrdiff_t>(3 * point + 3));
      for (const Primvar& primvar : mesh.primvars) {
        const auto first = primvar.values.begin() +
                           static_cast<std::ptrdiff_t>(primvar.indices[corner] * primvar.element_size);
        values.insert(values.end(), first, first + primvar.element_size);
      }
    }
    std::ranges::rotate(face, std::ranges::min_element(face));
  }
  std::ranges::sort(faces);
  return faces;
}

// Quads around a point, from another corner each, so that no two neighbours begin alike, and a pentagon.
GltfBuilder quads_and_a_pentagon() {
  GltfBuilder builder;
  const std::vector<float> points = {0, 0,  0,  1, 0, 0,  1,    1, 0.2f, 0, 1, 0,    -1, 1, 0.1f,  -1,  0,
                                     0, -1, -1, 0, 0, -1, 0.3f, 1, -1,   0, 2, 0.5f, 0,  2, -0.5f, 0.4f};
  const std::vector<std::uint8_t> indices = {1, 2, 3, 1, 3, 0, 0, 3, 4, 0,  4, 5,  5, 6, 7, 5, 7,
                                             0, 0, 7, 8, 0, 8, 1, 1, 8, 10, 1, 10, 9, 1, 9, 2};
  builder.mesh({{"POSITION", builder.values(points, 3)}}, builder.values(indices, 1));
  encode_ngons(builder);
  return builder;
}

TEST(WriteNgons, at_level_0_gives_back_the_faces_that_came) {
  for (GltfBuilder builder : {seamed_quads(), quads_and_a_pentagon()}) {
    const ControlMesh before = must_read(builder.glb()).meshes.at(0);
    const ControlMesh after = must_read(must_refine(builder.glb(), with_ngons(0)).bytes).meshes.at(0);
    EXPECT_EQ(shape_of(before), shape_of(after));
  }
}

// Answers hold single precision, and the mesh in the middle is rounded to it.
TEST(WriteNgons, are_refined_on_as_if_there_had_been_one_request) {
  for (GltfBuilder builder : {seamed_quads(), quads_and_a_pentagon()})
    for (const auto& [first, second] : {std::pair{0u, 2u}, {1u, 1u}, {1u, 2u}, {2u, 1u}}) {
      const ControlMesh once =
          must_read(must_refine(builder.glb(), with_ngons(first + second)).bytes).meshes.at(0);
      const std::string middle = must_refine(builder.glb(), with_ngons(first)).bytes;
      const ControlMesh twice = must_read(must_refine(middle, with_ngons(second)).bytes).meshes.at(0);
      ASSERT_EQ(once.face_vertex_counts.size(), twice.face_vertex_counts.size());
      ASSERT_EQ(once.point_count(), twice.point_count());
      // Every point of one is a point of the other, and so is every corner of a face with all its values.
      std::vector<std::vector<double>> corners[2];
      for (const ControlMesh* mesh : {&once, &twice})
        for (const auto& face : shape_of(*mesh))
          corners[mesh == &twice].insert(corners[mesh == &twice].end(), face.begin(), face.end());
      ASSERT_EQ(corners[0].size(), corners[1].size());
      for (const auto& corner : corners[0])
        EXPECT_TRUE(std::ranges::any_of(corners[1], [&](const std::vector<double>& other) {
          return std::ranges::equal(corner, other, [](double a, double b) { return std::abs(a - b) < 2e-6; });
        }));
    }
}

TEST(WriteNgons, is_refused_where_the_answer_is_no_gltf) {
  const std::string body = R"({"points":[[0,0,0],[1,0,0],[1,1,0],[0,1,0]],"faceVertexIndices":[[0,1,2,3]]})";
  const auto refused = proto::decode_refine(body, proto::BodyKind::json, {{"ngons", "true"}}, {});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
  EXPECT_EQ(to_pointer(refused.error().where), "/?ngons");
  EXPECT_THAT(refused.error().message, HasSubstr("format glb"));
  EXPECT_TRUE(
      proto::decode_refine(body, proto::BodyKind::json, {{"ngons", "true"}, {"format", "glb"}}, {}).ok());
}

// A body whose faces all begin at vertex 0, with and without a seam.
TEST(WriteNgons, marks_what_came_as_json) {
  for (const char* primvars :
       {"", R"(,"primvars":{"st":{"interpolation":"faceVarying","values":[[0,0],[1,0],[1,1],[0,1],[0,0],[0,1],
            [0,2],[-1,2]],"indices":[0,1,2,3,4,5,6,7]}})"}) {
    const std::string body = std::string(R"({"points":[[0,0,0],[1,0,0],[1,1,0],[0,1,0],[-1,1,0],[-1,0,1]],
          "faceVertexIndices":[[0,1,2,3],[0,3,4,5]],"options":{"format":"glb","ngons":true,"level":0})") +
                             primvars + "}";
    auto request = proto::decode_refine(body, proto::BodyKind::json, {}, {});
    ASSERT_TRUE(request.ok()) << request.error().message;
    const auto outcome = answer(*std::move(request));
    ASSERT_TRUE(outcome.ok());
    const ParsedGlb glb = parse_glb(outcome->bytes);
    EXPECT_TRUE(is_marked(glb.json));
    EXPECT_EQ(sizes_of_faces(indices_of(glb, glb.json["meshes"][0]["primitives"][0])),
              (std::vector<std::size_t>{4, 4}));
    EXPECT_LE(outcome->bytes.size(), outcome->predicted);
  }
}

}  // namespace
}  // namespace subdivd::test

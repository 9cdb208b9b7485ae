// FB_ngon_encoding: triangles that are polygons.
#include <gmock/gmock.h>

#include <cmath>

#include "core/schemes/all.h"
#include "proto/decode.h"
#include "tests/proto/gltf/ngon_assets.h"
#include "tests/proto/gltf/pipeline.h"
#include "tests/support/gltf_builder.h"

namespace subdivd::test {
namespace {

using proto::Format;
using proto::Options;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// Corners of a regular polygon, different for every number of them.
std::vector<float> circle(std::size_t count) {
  std::vector<float> points;
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = 2 * 3.14159265358979 * static_cast<double>(k) / static_cast<double>(count);
    points.insert(points.end(),
                  {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
  }
  return points;
}

GltfBuilder with_triangles(const std::vector<std::uint32_t>& indices, std::size_t points, int mode = 4) {
  GltfBuilder builder;
  builder.mesh({{"POSITION", builder.values(circle(points), 3)}}, builder.values(indices, 1), mode);
  encode_ngons(builder);
  return builder;
}

ControlMesh read_triangles(const std::vector<std::uint32_t>& indices, std::size_t points = 8) {
  return must_read(with_triangles(indices, points).glb()).meshes.at(0);
}

TEST(ReadNgons, joins_triangles_that_share_their_first_corner) {
  const ControlMesh mesh = read_triangles({0, 1, 2, 0, 2, 3, 0, 3, 4, 2, 1, 5, 2, 5, 6, 3, 6, 7});
  EXPECT_THAT(mesh.face_vertex_counts, ElementsAre(5, 4, 3));
  EXPECT_THAT(mesh.face_vertex_indices, ElementsAre(0, 1, 2, 3, 4, 2, 1, 5, 6, 3, 6, 7));
  ASSERT_THAT(mesh.render_meshes, SizeIs(1));
  EXPECT_EQ(mesh.render_meshes[0].face_end, 3u);
  EXPECT_EQ(mesh.render_meshes[0].indices, mesh.face_vertex_indices);
}

TEST(ReadNgons, keeps_triangles_apart_without_the_extension) {
  GltfBuilder builder = with_triangles({0, 1, 2, 0, 2, 3}, 4);
  primitive_of(builder).erase("extensions");
  EXPECT_THAT(must_read(builder.glb()).meshes.at(0).face_vertex_counts, IsEmpty());
}

TEST(ReadNgons, of_triangles_alone_is_a_mesh_of_triangles) {
  const ControlMesh mesh = read_triangles({0, 1, 2, 2, 1, 3, 3, 1, 0});
  EXPECT_THAT(mesh.face_vertex_counts, IsEmpty());
  EXPECT_THAT(mesh.face_vertex_indices, ElementsAre(0, 1, 2, 2, 1, 3, 3, 1, 0));
}

TEST(ReadNgons, begins_a_face_where_a_fan_does_not_continue) {
  EXPECT_THAT(read_triangles({0, 1, 2, 0, 3, 4, 0, 4, 5}).face_vertex_counts, ElementsAre(3, 4));
  EXPECT_THAT(read_triangles({0, 1, 2, 0, 2, 3, 0, 2, 4}).face_vertex_counts, ElementsAre(4, 3));
}

TEST(ReadNgons, begins_a_face_where_a_corner_would_come_twice) {
  const ControlMesh mesh = read_triangles({0, 1, 2, 0, 2, 3, 0, 3, 1, 0, 1, 4});
  EXPECT_THAT(mesh.face_vertex_counts, ElementsAre(4, 4));
  EXPECT_THAT(mesh.face_vertex_indices, ElementsAre(0, 1, 2, 3, 0, 3, 1, 4));
}

TEST(ReadNgons, never_continues_a_triangle_that_repeats_a_corner) {
  const ControlMesh mesh = read_triangles({0, 1, 1, 0, 1, 2, 0, 2, 3, 0, 3, 3, 0, 3, 4, 0, 0, 5, 0, 5, 6});
  EXPECT_THAT(mesh.face_vertex_counts, ElementsAre(3, 4, 3, 3, 3, 3));
  EXPECT_THAT(mesh.face_vertex_indices, ElementsAre(0, 1, 1, 0, 1, 2, 3, 0, 3, 3, 0, 3, 4, 0, 0, 5, 0, 5, 6));
}

// A sphere's poles: quads of which two corners lie in one place.
TEST(ReadNgons, of_quads_with_two_corners_in_a_place_leaves_triangles) {
  GltfBuilder builder;
  const std::vector<float> points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 0, 1, 0, 0, 1, 0};
  builder.mesh({{"POSITION", builder.values(points, 3)}},
               builder.values<std::uint8_t>({0, 1, 2, 0, 2, 3, 0, 4, 5, 4, 5, 1, 4, 1, 0}, 1));
  encode_ngons(builder);
  auto request = must_read(builder.glb());
  request.options.format = Format::glb;
  ASSERT_TRUE(proto::make_ready(request, {}, {}).ok());
  EXPECT_THAT(request.meshes.at(0).face_vertex_counts, IsEmpty());
  EXPECT_THAT(request.meshes.at(0).render_meshes.at(0).indices, ElementsAre(0, 1, 2, 4, 1, 0));
  EXPECT_THAT(request.warnings, Contains(HasSubstr("repeat a vertex")));
}

TEST(ReadNgons, stand_beside_primitives_of_triangles) {
  GltfBuilder builder = with_triangles({0, 1, 2, 0, 2, 3}, 8);
  const OrderedJson attributes = primitive_of(builder)["attributes"];
  builder.primitive(attributes, builder.values<std::uint8_t>({0, 3, 4, 0, 4, 5}, 1));
  builder.primitive(attributes, builder.values<std::uint8_t>({0, 5, 6, 0, 6, 7}, 1));
  encode_ngons(builder, 2);
  const ControlMesh mesh = must_read(builder.glb()).meshes.at(0);
  EXPECT_THAT(mesh.face_vertex_counts, ElementsAre(4, 3, 3, 4));
  ASSERT_THAT(mesh.render_meshes, SizeIs(3));
  EXPECT_EQ(mesh.render_meshes[1].face_begin, 1u);
  EXPECT_EQ(mesh.render_meshes[1].face_end, 3u);
  EXPECT_EQ(mesh.render_meshes[2].face_end, 4u);
}

TEST(ReadNgons, keep_their_seams) {
  const ControlMesh mesh = must_read(seamed_quads().glb()).meshes.at(0);
  EXPECT_THAT(mesh.face_vertex_counts, ElementsAre(4, 4));
  EXPECT_THAT(mesh.face_vertex_indices, ElementsAre(0, 1, 2, 3, 1, 4, 5, 2));
  ASSERT_THAT(mesh.primvars, SizeIs(1));
  EXPECT_THAT(mesh.primvars[0].indices, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_EQ(mesh.render_meshes.at(0).vertex_count, 8u);
}

TEST(ReadNgons, are_refined_as_faces_of_their_size) {
  const Outcome outcome = must_refine(seamed_quads().glb());
  const ParsedGlb glb = parse_glb(outcome.bytes);
  const OrderedJson& statistics = glb.json["asset"]["extras"]["subdivd"]["statistics"]["meshes"][0];
  EXPECT_EQ(statistics["subdivisionScheme"], "catmullClark");
  EXPECT_EQ(statistics["output"]["quads"], 32);
  EXPECT_LE(outcome.bytes.size(), outcome.predicted);
}

TEST(ReadNgons, leave_no_extension_in_the_answer) {
  GltfBuilder builder = seamed_quads();
  builder.document()["extensionsRequired"] = {"FB_ngon_encoding"};
  const OrderedJson json = parse_glb(must_refine(builder.glb()).bytes).json;
  EXPECT_FALSE(json.contains("extensionsUsed"));
  EXPECT_FALSE(json.contains("extensionsRequired"));
  EXPECT_FALSE(json["meshes"][0]["primitives"][0].contains("extensions"));
}

TEST(ReadNgons, elsewhere_than_on_triangles_is_ignored_with_a_warning) {
  for (const int mode : {0, 1, 3, 5, 6}) {
    SCOPED_TRACE(mode);
    GltfBuilder builder = seamed_quads();
    builder.primitive(primitive_of(builder)["attributes"], builder.values<std::uint8_t>({0, 1, 2, 3}, 1),
                      mode);
    encode_ngons(builder, 1);
    const Outcome outcome = must_refine(builder.glb());
    EXPECT_THAT(outcome.request.warnings,
                Contains(HasSubstr("FB_ngon_encoding tells of lists of triangles")));
    const OrderedJson json = parse_glb(outcome.bytes).json;
    // Points stay as they were.
    EXPECT_EQ(json.contains("extensionsUsed"), mode == 0);
    EXPECT_EQ(json["meshes"][0]["primitives"][1].contains("extensions"), mode == 0);
  }
}

TEST(ReadNgons, refuses_an_extension_that_is_no_object) {
  GltfBuilder builder = seamed_quads();
  primitive_of(builder)["extensions"]["FB_ngon_encoding"] = 5;
  const auto outcome = refine_gltf(builder.glb(), Format::glb, {});
  ASSERT_FALSE(outcome.ok());
  EXPECT_EQ(outcome.error().code, ErrorCode::wrong_type);
  EXPECT_EQ(to_pointer(outcome.error().where), "/meshes/0/primitives/0/extensions/FB_ngon_encoding");
}

TEST(ReadNgons, refuses_schemes_of_triangles_and_triangulates_on_request) {
  Options options;
  options.subdivision_scheme = 0;
  ASSERT_EQ(kSchemeNames[0], "loop");
  EXPECT_FALSE(refine_gltf(seamed_quads().glb(), Format::glb, options).ok());
  options.triangulate = true;
  const Outcome outcome = must_refine(seamed_quads().glb(), options);
  EXPECT_THAT(outcome.request.meshes.at(0).face_vertex_counts, IsEmpty());
  EXPECT_THAT(outcome.request.meshes.at(0).render_meshes.at(0).indices,
              ElementsAre(0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7));
}

TEST(ReadNgons, triangulates_every_primitive_of_a_mesh) {
  GltfBuilder builder = with_triangles({0, 1, 2, 1, 3, 4, 1, 4, 5}, 8);
  const OrderedJson attributes = primitive_of(builder)["attributes"];
  builder.primitive(attributes, builder.values<std::uint8_t>({5, 6, 7, 5, 7, 0}, 1));
  encode_ngons(builder, 1);
  Options options;
  options.triangulate = true;
  const Outcome outcome = must_refine(builder.glb(), options);
  const ControlMesh& mesh = outcome.request.meshes.at(0);
  ASSERT_THAT(mesh.render_meshes, SizeIs(2));
  EXPECT_EQ(mesh.render_meshes[0].face_end, 3u);
  EXPECT_EQ(mesh.render_meshes[1].face_end, 5u);
  EXPECT_THAT(mesh.render_meshes[1].indices, ElementsAre(1, 2, 3, 1, 3, 0));
}

TEST(ReadNgons, lose_skins_and_morph_targets_as_triangles_do) {
  GltfBuilder builder = seamed_quads();
  OrderedJson& document = builder.document();
  const OrderedJson position = primitive_of(builder)["attributes"]["POSITION"];
  const int joints = builder.values(std::vector<std::uint8_t>(32, 0), 4);
  const int weights = builder.values(std::vector<float>(32, 0.25f), 4);
  primitive_of(builder)["attributes"]["JOINTS_0"] = joints;
  primitive_of(builder)["attributes"]["WEIGHTS_0"] = weights;
  primitive_of(builder)["targets"] = {{{"POSITION", position}}};
  document["skins"] = {{{"joints", {0}}}};
  document["nodes"][0]["skin"] = 0;
  const Outcome outcome = must_refine(builder.glb());
  EXPECT_THAT(outcome.request.warnings, Contains(HasSubstr("Morph targets")));
  EXPECT_THAT(outcome.request.warnings, Contains(HasSubstr("skins")));
  EXPECT_THAT(outcome.request.meshes.at(0).face_vertex_counts, ElementsAre(4, 4));
}

// A face of 100,002 corners is read and refined in time and memory linear in them.
TEST(ReadNgons, takes_a_fan_of_a_hundred_thousand_triangles) {
  constexpr std::uint32_t kTriangles = 100000;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t k = 0; k < kTriangles; ++k) indices.insert(indices.end(), {0, k + 1, k + 2});
  GltfBuilder builder = with_triangles(indices, kTriangles + 2);
  Options options;
  options.level = 1;
  options.weld = proto::Weld::none;  // so many points on a circle of floats would meet
  const Outcome outcome = must_refine(builder.glb(), options);
  EXPECT_THAT(outcome.request.meshes.at(0).face_vertex_counts, ElementsAre(kTriangles + 2));
  EXPECT_LE(outcome.bytes.size(), outcome.predicted);
}

}  // namespace
}  // namespace subdivd::test

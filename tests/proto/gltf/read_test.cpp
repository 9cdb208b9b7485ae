#include <gmock/gmock.h>

#include "proto/gltf/read_lines.h"
#include "proto/gltf/read_triangles.h"
#include "tests/proto/gltf/pipeline.h"
#include "tests/proto/gltf/unlimited.h"
#include "tests/support/gltf_builder.h"

namespace subdivd::test {
namespace {

using proto::Options;
using proto::RefineRequest;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

// Faces of a unit square drawn in `mode` through these indices.
std::vector<Index> faces_of(int mode, const std::vector<std::uint8_t>& indices) {
  GltfBuilder builder;
  builder.mesh({{"POSITION", builder.values(kSquare, 3)}}, indices.empty() ? -1 : builder.values(indices, 1),
               mode);
  return must_read(builder.glb()).meshes.at(0).face_vertex_indices;
}

TEST(ReadTriangles, reads_an_indexed_list) {
  EXPECT_THAT(faces_of(4, {0, 1, 2, 0, 2, 3}), ElementsAre(0, 1, 2, 0, 2, 3));
}
TEST(ReadTriangles, keeps_the_winding_of_strips) {
  EXPECT_THAT(faces_of(5, {0, 1, 3, 2}), ElementsAre(0, 1, 3, 1, 2, 3));
}
TEST(ReadTriangles, keeps_the_winding_of_fans) {
  EXPECT_THAT(faces_of(6, {0, 1, 2, 3}), ElementsAre(1, 2, 0, 2, 3, 0));
}
TEST(ReadTriangles, reads_vertices_in_order_without_indices) {
  EXPECT_THAT(faces_of(6, {}), ElementsAre(1, 2, 0, 2, 3, 0));
}
TEST(ReadTriangles, leaves_out_triangles_that_join_strips) {
  EXPECT_THAT(faces_of(5, {0, 1, 2, 2, 3, 3, 0}), SizeIs(3));
}

TEST(ReadTriangles, reads_every_index_type) {
  const auto faces = [](auto component) {
    GltfBuilder builder;
    const std::vector<decltype(component)> indices = {0, 1, 2};
    const int accessor = builder.values(indices, 1);
    builder.mesh({{"POSITION", builder.values(kSquare, 3)}}, accessor);
    return must_read(builder.glb()).meshes.at(0).face_vertex_indices;
  };
  EXPECT_THAT(faces(std::uint8_t{}), ElementsAre(0, 1, 2));
  EXPECT_THAT(faces(std::uint16_t{}), ElementsAre(0, 1, 2));
  EXPECT_THAT(faces(std::uint32_t{}), ElementsAre(0, 1, 2));
}

TEST(ReadTriangles, reads_interleaved_views) {
  GltfBuilder builder;
  std::vector<float> interleaved;
  for (std::size_t v = 0; v < 3; ++v)
    interleaved.insert(interleaved.end(),
                       {kSquare[3 * v], kSquare[3 * v + 1], kSquare[3 * v + 2], float(v), 0.5f});
  const int view = builder.view(interleaved, 20);
  const int positions = builder.accessor(view, 5126, 3, "VEC3"),
            coordinates = builder.accessor(view, 5126, 3, "VEC2");
  builder.document()["accessors"][1]["byteOffset"] = 12;
  builder.mesh({{"POSITION", positions}, {"TEXCOORD_0", coordinates}});
  const ControlMesh mesh = must_read(builder.glb()).meshes.at(0);
  EXPECT_THAT(mesh.points, ElementsAre(0, 0, 0, 1, 0, 0, 1, 1, 0));
  EXPECT_THAT(mesh.primvars.at(0).values, ElementsAre(0, 0.5, 1, 0.5, 2, 0.5));
}

TEST(ReadTriangles, lays_sparse_values_over_dense_ones) {
  GltfBuilder builder;
  const int positions = builder.values(std::vector<float>(kSquare.begin(), kSquare.begin() + 9), 3);
  const int at = builder.view<std::uint16_t>({1}), with = builder.view<float>({7, 8, 9});
  builder.document()["accessors"][0]["sparse"] = {{"count", 1},
                                                  {"indices", {{"bufferView", at}, {"componentType", 5123}}},
                                                  {"values", {{"bufferView", with}}}};
  builder.mesh({{"POSITION", positions}});
  EXPECT_THAT(must_read(builder.glb()).meshes.at(0).points, ElementsAre(0, 0, 0, 7, 8, 9, 1, 1, 0));
}

TEST(ReadTriangles, lays_sparse_values_over_zeros) {
  GltfBuilder builder;
  const int positions = builder.accessor(-1, 5126, 3, "VEC3");
  const int at = builder.view<std::uint8_t>({1, 2}), with = builder.view<float>({1, 0, 0, 0, 1, 0});
  builder.document()["accessors"][0]["sparse"] = {{"count", 2},
                                                  {"indices", {{"bufferView", at}, {"componentType", 5121}}},
                                                  {"values", {{"bufferView", with}}}};
  builder.mesh({{"POSITION", positions}});
  EXPECT_THAT(must_read(builder.glb()).meshes.at(0).points, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
}

TEST(ReadTriangles, normalizes_integers) {
  GltfBuilder builder;
  const int positions = builder.values(std::vector<float>(kSquare.begin(), kSquare.begin() + 9), 3);
  const int colors =
      builder.values<std::uint8_t>({0, 51, 255, 255, 0, 0, 0, 255, 255, 255, 255, 255}, 4, true);
  builder.mesh({{"POSITION", positions}, {"COLOR_0", colors}});
  const Primvar color = must_read(builder.glb()).meshes.at(0).primvars.at(0);
  EXPECT_EQ(color.name, "COLOR_0");
  EXPECT_EQ(color.element_size, 4u);
  EXPECT_EQ(color.values[1], 51.0 / 255);
}

TEST(ReadTriangles, reads_quantized_positions) {
  GltfBuilder builder;
  builder.document()["extensionsUsed"] = {"KHR_mesh_quantization"};
  builder.document()["extensionsRequired"] = {"KHR_mesh_quantization"};
  const int view = builder.view<std::int16_t>({-32768, 0, 0, 0, 32767, 0, 0, 0, 0, 16384, 0, 0}, 8);
  const int positions = builder.accessor(view, 5122, 3, "VEC3");
  builder.document()["accessors"][0]["normalized"] = true;
  builder.mesh({{"POSITION", positions}});
  EXPECT_THAT(must_read(builder.glb()).meshes.at(0).points,
              ElementsAre(-1, 0, 0, 32767.0 / 32767, 0, 0, 0, 16384.0 / 32767, 0));
}

TEST(ReadTriangles, welds_equal_positions_across_primitives) {
  const RefineRequest request = must_read(seamed_octahedron().glb());
  ASSERT_THAT(request.meshes, SizeIs(1));
  const ControlMesh& mesh = request.meshes[0];
  EXPECT_EQ(mesh.point_count(), 6u);
  EXPECT_EQ(mesh.face_count(), 8u);
  ASSERT_THAT(mesh.render_meshes, SizeIs(2));
  EXPECT_EQ(mesh.render_meshes[1].face_begin, 4u);
  EXPECT_EQ(mesh.render_meshes[1].face_end, 8u);
  EXPECT_EQ(mesh.render_meshes[1].vertex_count, 6u);
}

TEST(ReadTriangles, keeps_vertices_apart_when_told_not_to_weld) {
  Options options;
  options.weld = proto::Weld::none;
  EXPECT_EQ(must_read(seamed_octahedron().glb(), options).meshes.at(0).point_count(), 12u);
}

TEST(ReadTriangles, welds_values_at_seams_only_when_they_are_equal) {
  const ControlMesh mesh = must_read(seamed_octahedron().glb()).meshes.at(0);
  // The equator's five coordinates serve both halves, the poles have one each.
  EXPECT_THAT(mesh.primvars.at(0).values, SizeIs(2 * 7));
  EXPECT_THAT(mesh.primvars.at(0).indices, SizeIs(24));
}

TEST(ReadTriangles, gives_primitives_without_an_attribute_values_of_their_own) {
  GltfBuilder builder = seamed_octahedron();
  builder.document()["meshes"][0]["primitives"][1]["attributes"].erase("TEXCOORD_0");
  const RefineRequest request = must_read(builder.glb());
  const Primvar& coordinates = request.meshes.at(0).primvars.at(0);
  EXPECT_THAT(coordinates.values, SizeIs(2 * (6 + 5)));
  for (const Index index : std::span(coordinates.indices).subspan(12)) EXPECT_GE(index, 6u);
}

TEST(ReadTriangles, leaves_out_unused_vertices_and_says_so) {
  GltfBuilder builder;
  builder.mesh({{"POSITION", builder.values(kSquare, 3)}}, builder.values<std::uint8_t>({0, 2, 3}, 1));
  const RefineRequest request = must_read(builder.glb());
  EXPECT_EQ(request.meshes.at(0).point_count(), 3u);
  EXPECT_THAT(request.warnings, ElementsAre(HasSubstr("left out: 1 (/meshes/0/primitives/0)")));
}

TEST(ReadTriangles, reads_of_a_long_accessor_what_is_used) {
  GltfBuilder builder;
  const int positions = builder.accessor(-1, 5126, 4000000000u, "VEC3");
  const int at = builder.view<std::uint32_t>({7, 8, 3000000000u}),
            with = builder.view<float>({1, 0, 0, 0, 1, 0, 5, 6, 7});
  builder.document()["accessors"][0]["sparse"] = {{"count", 3},
                                                  {"indices", {{"bufferView", at}, {"componentType", 5125}}},
                                                  {"values", {{"bufferView", with}}}};
  builder.mesh({{"POSITION", positions}}, builder.values<std::uint32_t>({3000000000u, 7, 9}, 1));
  const RefineRequest request = must_read(builder.glb());
  EXPECT_THAT(request.meshes.at(0).points, ElementsAre(1, 0, 0, 0, 0, 0, 5, 6, 7));
  EXPECT_THAT(request.meshes.at(0).face_vertex_indices, ElementsAre(2, 0, 1));
}

TEST(ReadTriangles, asks_for_normals_when_the_asset_had_them) {
  EXPECT_TRUE(must_read(seamed_octahedron().glb()).options.normals);
  GltfBuilder builder;
  builder.mesh({{"POSITION", builder.values(kSquare, 3)}},
               builder.values<std::uint8_t>({0, 1, 2, 0, 2, 3}, 1));
  EXPECT_FALSE(must_read(builder.glb()).options.normals);
}

TEST(ReadTriangles, reads_embedded_gltf_like_glb) {
  const GltfBuilder builder = seamed_octahedron();
  const RefineRequest a = must_read(builder.glb()), b = must_read(builder.gltf(), {}, proto::Format::gltf);
  EXPECT_EQ(a.meshes.at(0).points, b.meshes.at(0).points);
  EXPECT_EQ(a.meshes.at(0).face_vertex_indices, b.meshes.at(0).face_vertex_indices);
}

TEST(ReadTriangles, names_everything_that_is_left_behind) {
  GltfBuilder builder = seamed_octahedron();
  OrderedJson& primitive = builder.document()["meshes"][0]["primitives"][0];
  primitive["attributes"]["TANGENT"] = builder.values(std::vector<float>(24, 0.5f), 4);
  primitive["attributes"]["JOINTS_0"] = builder.values(std::vector<std::uint8_t>(24), 4);
  primitive["attributes"]["WEIGHTS_0"] = builder.values(std::vector<float>(24, 0.25f), 4);
  primitive["targets"] = {{{"POSITION", 0}}};
  const auto warnings = must_read(builder.glb()).warnings;
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("TANGENT")));
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("Joints and weights")));
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("Morph targets")));
}

std::vector<ControlCurves> curves_of(int mode, const std::vector<std::uint8_t>& indices) {
  GltfBuilder builder;
  builder.mesh({{"POSITION", builder.values(kSquare, 3)}}, builder.values(indices, 1), mode);
  return must_read(builder.glb()).curves;
}

TEST(ReadLines, takes_a_strip_for_a_pinned_curve) {
  const auto curves = curves_of(3, {3, 1, 0});
  ASSERT_THAT(curves, SizeIs(1));
  EXPECT_EQ(curves[0].wrap, CurveWrap::pinned);
  EXPECT_THAT(curves[0].points, ElementsAre(0, 1, 0, 1, 0, 0, 0, 0, 0));
}

TEST(ReadLines, takes_a_loop_for_a_periodic_curve) {
  const auto curves = curves_of(2, {0, 1, 2, 3});
  ASSERT_THAT(curves, SizeIs(1));
  EXPECT_EQ(curves[0].wrap, CurveWrap::periodic);
  EXPECT_EQ(curves[0].point_count(), 4u);
}

TEST(ReadLines, chains_segments_that_meet_two_by_two) {
  const auto curves = curves_of(1, {2, 1, 0, 1, 2, 3});
  ASSERT_THAT(curves, SizeIs(1));
  EXPECT_EQ(curves[0].wrap, CurveWrap::pinned);
  EXPECT_THAT(curves[0].points, ElementsAre(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0));
}

TEST(ReadLines, closes_chains_that_come_back) {
  const auto curves = curves_of(1, {0, 1, 1, 2, 2, 3, 3, 0});
  ASSERT_THAT(curves, SizeIs(1));
  EXPECT_EQ(curves[0].wrap, CurveWrap::periodic);
  EXPECT_EQ(curves[0].point_count(), 4u);
}

TEST(ReadLines, ends_chains_where_three_segments_meet) {
  Unlimited unlimited;
  const auto chains = proto::gltf::chain_segments({0, 1, 0, 2, 0, 3, 3, 4}, 5, unlimited.work);
  EXPECT_THAT(chains->open.lengths, SizeIs(3));
  EXPECT_THAT(chains->closed.lengths, IsEmpty());
}

TEST(ReadLines, does_not_close_two_segments_between_the_same_points) {
  Unlimited unlimited;
  const auto chains = proto::gltf::chain_segments({0, 1, 1, 0}, 2, unlimited.work);
  EXPECT_THAT(chains->open.vertices, ElementsAre(0, 1, 0));
  EXPECT_THAT(chains->open.lengths, ElementsAre(3));
}

TEST(ReadLines, refines_colours_along) {
  GltfBuilder builder;
  const int colors = builder.values(std::vector<float>(12, 0.5f), 3);
  builder.mesh({{"POSITION", builder.values(kSquare, 3)}, {"COLOR_0", colors}}, -1, 3);
  EXPECT_EQ(must_read(builder.glb()).curves.at(0).width, 6u);
}

TEST(ReadLines, leaves_a_loop_of_two_points_as_it_is) {
  GltfBuilder builder = seamed_octahedron();
  builder.primitive({{"POSITION", builder.values(kSquare, 3)}}, builder.values<std::uint8_t>({0, 1}, 1), 2);
  const RefineRequest request = must_read(builder.glb());
  EXPECT_THAT(request.curves, IsEmpty());
  EXPECT_THAT(request.warnings, ElementsAre(HasSubstr("too short")));
}

}  // namespace
}  // namespace subdivd::test

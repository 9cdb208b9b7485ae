// What JSON bodies are accepted, and what becomes of them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/schemes/all.h"
#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

RefineRequest read(std::string_view body) {
  Result<RefineRequest> request = decode(body);
  EXPECT_TRUE(request.ok()) << request.error().message;
  return request ? std::move(*request) : RefineRequest{};
}

ControlMesh first_mesh(std::string_view body) {
  RefineRequest request = read(body);
  return request.meshes.empty() ? ControlMesh{} : std::move(request.meshes.front());
}

// The triangle with further members.
std::string triangle(const std::string& members) {
  return R"({"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2],)" + members + "}";
}

TEST(read, a_mesh_may_stand_at_the_top) {
  const RefineRequest request = read(kTriangle);
  EXPECT_TRUE(request.single_mesh_at_top);
  ASSERT_THAT(request.meshes, SizeIs(1));
  EXPECT_THAT(request.meshes[0].points, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
  EXPECT_THAT(request.meshes[0].face_vertex_indices, ElementsAre(0, 1, 2));
}

TEST(read, several_meshes_stand_in_an_array) {
  const std::string one(kTriangle);
  const RefineRequest request = read(R"({"meshes":[)" + one + "," + one + "]}");
  EXPECT_FALSE(request.single_mesh_at_top);
  EXPECT_THAT(request.meshes, SizeIs(2));
}

TEST(read, members_may_come_in_any_order) {
  const ControlMesh mesh = first_mesh(
      R"({"creaseSharpnesses":[2],"faceVertexIndices":[[0,1,2]],"creaseLengths":[2],"options":{"level":1},
          "creaseIndices":[0,1],"points":[0,0,0,1,0,0,0,1,0]})");
  EXPECT_THAT(mesh.crease_indices, ElementsAre(0, 1));
}

TEST(read, flat_and_nested_points_are_the_same) {
  EXPECT_EQ(first_mesh(kTriangle).points,
            first_mesh(R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2]})").points);
}

TEST(read, remembers_how_arrays_were_written) {
  const RefineRequest request = read(R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[[0,1,2]],
               "primvars":{"a":{"values":[1,2,3]},"b":{"values":[[1],[2],[3]]}}})");
  EXPECT_EQ(request.mesh_forms[0].points, ArrayForm::flat);
  EXPECT_EQ(request.mesh_forms[0].faces, ArrayForm::nested);
  EXPECT_THAT(request.mesh_forms[0].primvars, ElementsAre(ArrayForm::flat, ArrayForm::nested));
}

TEST(read, nested_faces_bring_their_counts) {
  const RefineRequest request = read(
      R"({"points":[[0,0,0],[1,0,0],[1,1,0],[0,1,0]],"faceVertexIndices":[[0,1,2,3]],"options":{"triangulate":true}})");
  EXPECT_THAT(request.meshes[0].face_vertex_indices, ElementsAre(0, 1, 2, 0, 2, 3));
  EXPECT_THAT(request.face_origins, ElementsAre(ElementsAre(0, 0)));
}

TEST(read, nested_creases_bring_their_lengths) {
  const ControlMesh mesh =
      first_mesh(triangle(R"("creaseIndices":[[0,1,2],[2,0]],"creaseSharpnesses":[1,2])"));
  EXPECT_THAT(mesh.crease_lengths, ElementsAre(3, 2));
  EXPECT_THAT(mesh.crease_indices, ElementsAre(0, 1, 2, 2, 0));
}

TEST(read, sharpness_may_be_infinite) {
  const ControlMesh mesh =
      first_mesh(triangle(R"("cornerIndices":[0,1,2],"cornerSharpnesses":["infinite",1e38,2.3])"));
  EXPECT_THAT(mesh.corner_sharpnesses, ElementsAre(kInfiniteSharpness, 1e38f, 2.3f));
}

TEST(read, sharpness_beyond_floats_is_infinite_too) {
  const ControlMesh mesh = first_mesh(triangle(R"("cornerIndices":[0],"cornerSharpnesses":[1e300])"));
  EXPECT_GE(mesh.corner_sharpnesses.at(0), kInfiniteSharpness);
}

TEST(read, whole_numbers_may_be_written_as_reals) {
  EXPECT_THAT(
      first_mesh(R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0.0,1e0,20e-1]})").face_vertex_indices,
      ElementsAre(0, 1, 2));
}

TEST(read, defaults_are_openusds) {
  const ControlMesh mesh = first_mesh(kTriangle);
  const auto scheme = scheme_of_mesh(mesh.subdivision_scheme, {3, 3});
  ASSERT_TRUE(scheme.has_value());
  EXPECT_TRUE(std::holds_alternative<Loop>(*scheme));
  EXPECT_EQ(mesh.interpolate_boundary, BoundaryInterpolation::edge_and_corner);
  EXPECT_EQ(mesh.face_varying_linear_interpolation, FaceVaryingInterpolation::corners_plus1);
}

TEST(read, a_mesh_has_its_own_boundary_mode) {
  EXPECT_EQ(first_mesh(triangle(R"("interpolateBoundary":"none")")).interpolate_boundary,
            BoundaryInterpolation::none);
}

TEST(read, an_option_overrides_the_boundary_mode_of_every_mesh) {
  const auto request =
      decode(triangle(R"("interpolateBoundary":"none")"), {{"interpolateBoundary", "edgeOnly"}});
  ASSERT_TRUE(request.ok());
  EXPECT_EQ(request->meshes[0].interpolate_boundary, BoundaryInterpolation::edge_only);
}

TEST(read, primvars_of_all_interpolations) {
  const ControlMesh mesh = first_mesh(triangle(R"("primvars":{
      "c":{"interpolation":"constant","values":[1]}, "u":{"interpolation":"uniform","values":[1]},
      "v":{"interpolation":"varying","values":[1,2,3]}, "x":{"interpolation":"vertex","values":[1,2,3]},
      "st":{"interpolation":"faceVarying","elementSize":2,"values":[0,0,1,0,0,1],"indices":[0,1,2]}})"));
  ASSERT_THAT(mesh.primvars, SizeIs(5));
  EXPECT_EQ(mesh.primvars[0].interpolation, Interpolation::constant);
  EXPECT_EQ(mesh.primvars[4].interpolation, Interpolation::face_varying);
  EXPECT_EQ(mesh.primvars[4].element_size, 2u);
  EXPECT_THAT(mesh.primvars[4].indices, ElementsAre(0, 1, 2));
}

TEST(read, nested_values_tell_the_element_size) {
  const ControlMesh mesh = first_mesh(triangle(R"("primvars":{"a":{"values":[[1,2],[3,4],[5,6]]}})"));
  EXPECT_EQ(mesh.primvars.at(0).element_size, 2u);
}

TEST(read, a_primvar_is_a_vertex_primvar_by_default) {
  EXPECT_EQ(first_mesh(triangle(R"("primvars":{"a":{"values":[1,2,3]}})")).primvars.at(0).interpolation,
            Interpolation::vertex);
}

TEST(read, curves_may_have_points_of_any_width) {
  const RefineRequest request = read(R"({"curves":[{"points":[[0,1],[2,3],[4,5]]},{"points":[[1],[2]]}]})");
  ASSERT_THAT(request.curves, SizeIs(2));
  EXPECT_EQ(request.curves[0].width, 2u);
  EXPECT_EQ(request.curves[1].width, 1u);
  EXPECT_THAT(request.meshes, IsEmpty());
}

TEST(read, flat_curve_points_have_three_numbers) {
  const RefineRequest request = read(R"({"curves":[{"wrap":"periodic","points":[0,0,0,1,1,1,2,0,0]}]})");
  EXPECT_EQ(request.curves.at(0).width, 3u);
  EXPECT_EQ(request.curves.at(0).wrap, CurveWrap::periodic);
}

TEST(read, meshes_and_curves_may_come_together) {
  const RefineRequest request =
      read(R"({"curves":[{"points":[[0],[1]]}],"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2]})");
  EXPECT_TRUE(request.single_mesh_at_top);
  EXPECT_THAT(request.curves, SizeIs(1));
}

TEST(read, members_of_an_answer_are_looked_at_but_not_used) {
  EXPECT_EQ(refusal(triangle(
                R"("statistics":{"a":[1,{"b":null}]},"warnings":["x"],"verification":{"passed":true})")),
            "accepted");
}

TEST(read, normals_of_the_body_are_not_used_and_it_says_so) {
  const RefineRequest request = read(triangle(R"("normals":[[0,0,1],[0,0,1],[0,0,1]])"));
  ASSERT_THAT(request.warnings, SizeIs(1));
  EXPECT_THAT(request.warnings[0], testing::HasSubstr("normals"));
}

TEST(read, degenerate_faces_are_left_out_with_a_warning) {
  const RefineRequest request =
      read(R"({"name":"m","points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2,1,1,2,2,0,2]})");
  EXPECT_THAT(request.meshes[0].face_vertex_indices, ElementsAre(0, 1, 2));
  EXPECT_THAT(request.face_origins, ElementsAre(ElementsAre(0)));
  EXPECT_THAT(request.warnings,
              ElementsAre("mesh 0 (\"m\"): 2 faces repeat a vertex and were left out, the first is face 1"));
}

TEST(read, an_untouched_mesh_has_no_face_origins) { EXPECT_THAT(read(kTriangle).face_origins, IsEmpty()); }

TEST(read, a_byte_order_mark_is_skipped) {
  EXPECT_EQ(refusal("\xEF\xBB\xBF" + std::string(kTriangle)), "accepted");
}

TEST(read, white_space_around_the_document_is_fine) {
  EXPECT_EQ(refusal(" \n\t" + std::string(kTriangle) + "\r\n "), "accepted");
}

TEST(read, names_keep_their_escapes_and_letters) {
  EXPECT_EQ(first_mesh(triangle(R"("name":"a\"\\\n\u00e9\ud83d\ude00é")")).name, "a\"\\\né😀é");
}

}  // namespace
}  // namespace subdivd::proto::test

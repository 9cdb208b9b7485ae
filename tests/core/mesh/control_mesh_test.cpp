#include "core/mesh/control_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "tests/shapes/build.h"
#include "tests/shapes/polygons.h"

namespace subdivd {
namespace {

using shapes::cube;

void expect_fault(const ControlMesh& mesh, ErrorCode code, const Path& where) {
  const Result<void> result = mesh.check();
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(name_of(result.error().code), name_of(code)) << result.error().message;
  EXPECT_EQ(result.error().where, where) << result.error().message;
  EXPECT_FALSE(result.error().message.empty());
}

Path path(std::initializer_list<PathStep> steps) { return steps; }
PathStep index(std::uint64_t k) { return k; }

TEST(ControlMeshCheck, accepts_a_cube) { EXPECT_TRUE(cube().check().ok()); }

TEST(ControlMeshCheck, rejects_points_that_are_no_triples) {
  ControlMesh mesh = cube();
  mesh.points.push_back(1);
  expect_fault(mesh, ErrorCode::wrong_length, path({"points"}));
}

TEST(ControlMeshCheck, rejects_a_point_that_is_not_finite) {
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    ControlMesh mesh = cube();
    mesh.points[7] = bad;
    expect_fault(mesh, ErrorCode::not_finite, path({"points", index(7)}));
  }
}

TEST(ControlMeshCheck, rejects_a_mesh_without_faces) {
  ControlMesh mesh = cube();
  mesh.face_vertex_indices.clear();
  expect_fault(mesh, ErrorCode::wrong_length, path({"faceVertexIndices"}));
}

TEST(ControlMeshCheck, rejects_an_index_past_the_points) {
  ControlMesh mesh = cube();
  mesh.face_vertex_indices[10] = 8;
  expect_fault(mesh, ErrorCode::out_of_range, path({"faceVertexIndices", index(10)}));
}

TEST(ControlMeshCheck, rejects_corners_that_make_no_triangles) {
  ControlMesh mesh = cube();
  mesh.face_vertex_indices.pop_back();
  expect_fault(mesh, ErrorCode::wrong_length, path({"faceVertexIndices"}));
}

TEST(ControlMeshCheck, rejects_counts_that_do_not_add_up) {
  ControlMesh mesh = cube();
  mesh.face_vertex_counts.assign(11, 3);
  expect_fault(mesh, ErrorCode::wrong_length, path({"faceVertexCounts"}));
}

TEST(ControlMeshCheck, rejects_counts_that_add_up_only_in_32_bits) {
  ControlMesh mesh = cube();  // 36 corners; 2^31 + 2^31 + 36 wraps to 36
  mesh.face_vertex_counts = {0x80000000u, 0x80000000u, 36};
  expect_fault(mesh, ErrorCode::wrong_length, path({"faceVertexCounts"}));
}

TEST(ControlMeshCheck, rejects_a_face_of_two_vertices) {
  ControlMesh mesh = cube();
  mesh.face_vertex_counts.assign(10, 3);
  mesh.face_vertex_counts.insert(mesh.face_vertex_counts.end(), {4, 2});
  expect_fault(mesh, ErrorCode::not_a_triangle, path({"faceVertexCounts", index(11)}));
}

TEST(ControlMeshCheck, takes_faces_of_any_size) {
  for (const auto& [name, mesh] : shapes::polygon_shapes()) EXPECT_TRUE(mesh.check().ok()) << name;
}

TEST(ControlMeshCheck, rejects_a_polygon_that_repeats_a_vertex) {
  ControlMesh mesh = cube();
  mesh.face_vertex_counts = {3, 4, 5};
  mesh.face_vertex_indices = {0, 1, 2, 0, 1, 2, 3, 4, 5, 6, 7, 5};
  expect_fault(mesh, ErrorCode::not_a_triangle, path({"faceVertexIndices", index(11)}));
  mesh.face_vertex_indices = {0, 1, 2, 3, 4, 3, 5, 0, 1, 2, 6, 7};
  expect_fault(mesh, ErrorCode::not_a_triangle, path({"faceVertexIndices", index(5)}));
}

TEST(ControlMeshCheck, knows_the_edges_of_polygons) {
  ControlMesh mesh = cube();
  mesh.face_vertex_counts = {4, 5};
  mesh.face_vertex_indices = {0, 1, 2, 3, 2, 3, 4, 5, 6};
  mesh.crease_lengths = {2};
  mesh.crease_sharpnesses = {1};
  mesh.crease_indices = {6, 2};
  EXPECT_TRUE(mesh.check().ok());
  mesh.crease_indices = {0, 2};  // a diagonal
  expect_fault(mesh, ErrorCode::not_an_edge, path({"creaseIndices", index(1)}));
}

TEST(ControlMeshCheck, rejects_a_face_that_repeats_a_vertex) {
  ControlMesh mesh = cube();
  mesh.face_vertex_indices[4] = mesh.face_vertex_indices[3];
  expect_fault(mesh, ErrorCode::not_a_triangle, path({"faceVertexIndices", index(4)}));
}

// Whole blocks are judged at once: the fault may stand anywhere in one, or behind the last.
TEST(ControlMeshCheck, finds_a_repeated_vertex_in_any_face) {
  for (Index faces = 1; faces < 14; ++faces)
    for (Index bad = 0; bad < faces; ++bad)
      for (const auto& [from, to, blamed] : {std::array{0u, 1u, 1u}, {1u, 2u, 2u}, {0u, 2u, 2u}}) {
        ControlMesh mesh;
        mesh.points.assign(9 * faces, 0.5);
        for (Index corner = 0; corner < 3 * faces; ++corner) mesh.face_vertex_indices.push_back(corner);
        ASSERT_TRUE(mesh.check().ok());
        mesh.face_vertex_indices[3 * bad + to] = mesh.face_vertex_indices[3 * bad + from];
        expect_fault(mesh, ErrorCode::not_a_triangle, path({"faceVertexIndices", index(3 * bad + blamed)}));
      }
}

// Neighbours in different faces are no repetition.
TEST(ControlMeshCheck, accepts_faces_that_begin_where_the_one_before_ends) {
  ControlMesh mesh;
  mesh.points.assign(9, 0.5);
  for (int face = 0; face < 20; ++face)
    for (const Index corner : {0u, 1u, 2u})
      mesh.face_vertex_indices.push_back(face % 2 == 0 ? corner : 2 - corner);
  EXPECT_TRUE(mesh.check().ok());
}

TEST(ControlMeshCheck, finds_a_point_that_is_not_finite_anywhere) {
  for (std::size_t at = 0; at < cube().points.size(); ++at) {
    ControlMesh mesh = cube();
    mesh.points[at] = -std::numeric_limits<double>::infinity();
    expect_fault(mesh, ErrorCode::not_finite, path({"points", index(at)}));
  }
}

TEST(ControlMeshCheck, rejects_a_crease_of_one_point) {
  ControlMesh mesh = cube();
  mesh.crease_indices = {0};
  mesh.crease_lengths = {1};
  mesh.crease_sharpnesses = {1};
  expect_fault(mesh, ErrorCode::out_of_range, path({"creaseLengths", index(0)}));
}

TEST(ControlMeshCheck, rejects_crease_lengths_that_do_not_add_up) {
  ControlMesh mesh = cube();
  shapes::crease(mesh, {0, 1}, 1);
  mesh.crease_indices.push_back(3);
  expect_fault(mesh, ErrorCode::wrong_length, path({"creaseLengths"}));
}

TEST(ControlMeshCheck, rejects_sharpnesses_for_neither_creases_nor_edges) {
  ControlMesh mesh = cube();
  shapes::crease(mesh, {0, 1, 3, 2}, 1);
  mesh.crease_sharpnesses = {1, 1};
  expect_fault(mesh, ErrorCode::wrong_length, path({"creaseSharpnesses"}));
}

TEST(ControlMeshCheck, rejects_a_crease_between_points_without_an_edge) {
  ControlMesh mesh = cube();
  shapes::crease(mesh, {0, 1, 6}, 1);
  expect_fault(mesh, ErrorCode::not_an_edge, path({"creaseIndices", index(2)}));
}

TEST(ControlMeshCheck, rejects_a_crease_index_past_the_points) {
  ControlMesh mesh = cube();
  shapes::crease(mesh, {0, 8}, 1);
  expect_fault(mesh, ErrorCode::out_of_range, path({"creaseIndices", index(1)}));
}

TEST(ControlMeshCheck, rejects_sharpness_that_is_negative_or_nan) {
  for (float bad : {-1.0f, std::numeric_limits<float>::quiet_NaN()}) {
    ControlMesh mesh = cube();
    shapes::crease(mesh, {0, 1}, bad);
    expect_fault(mesh, ErrorCode::out_of_range, path({"creaseSharpnesses", index(0)}));
    mesh = cube();
    shapes::corner(mesh, 3, bad);
    expect_fault(mesh, ErrorCode::out_of_range, path({"cornerSharpnesses", index(0)}));
  }
}

TEST(ControlMeshCheck, accepts_infinite_sharpness) {
  ControlMesh mesh = cube();
  shapes::crease(mesh, {0, 1}, std::numeric_limits<float>::infinity());
  EXPECT_TRUE(mesh.check().ok());
}

TEST(ControlMeshCheck, rejects_a_corner_given_twice) {
  ControlMesh mesh = cube();
  shapes::corner(mesh, 3, 1);
  shapes::corner(mesh, 3, 2);
  expect_fault(mesh, ErrorCode::duplicate_tag, path({"cornerIndices", index(1)}));
}

TEST(ControlMeshCheck, rejects_corners_without_sharpness) {
  ControlMesh mesh = cube();
  mesh.corner_indices = {1};
  expect_fault(mesh, ErrorCode::wrong_length, path({"cornerSharpnesses"}));
}

TEST(ControlMeshCheck, rejects_a_corner_past_the_points) {
  ControlMesh mesh = cube();
  shapes::corner(mesh, 8, 1);
  expect_fault(mesh, ErrorCode::out_of_range, path({"cornerIndices", index(0)}));
}

TEST(ControlMeshCheck, rejects_a_hole_past_the_faces_or_given_twice) {
  ControlMesh mesh = cube();
  mesh.hole_indices = {12};
  expect_fault(mesh, ErrorCode::out_of_range, path({"holeIndices", index(0)}));
  mesh.hole_indices = {3, 3};
  expect_fault(mesh, ErrorCode::duplicate_tag, path({"holeIndices", index(1)}));
}

TEST(ControlMeshCheck, rejects_two_primvars_of_one_name) {
  ControlMesh mesh = cube();
  mesh.primvars = {shapes::plain_primvar(mesh, "a", Interpolation::vertex, 1),
                   shapes::plain_primvar(mesh, "a", Interpolation::varying, 1)};
  expect_fault(mesh, ErrorCode::duplicate_field, path({"primvars", "a"}));
}

TEST(ControlMeshCheck, rejects_primvars_that_do_not_fit_their_interpolation) {
  for (Interpolation interpolation : {Interpolation::constant, Interpolation::uniform, Interpolation::varying,
                                      Interpolation::vertex, Interpolation::face_varying}) {
    ControlMesh mesh = cube();
    mesh.primvars = {{"a", interpolation, 2, std::vector<double>(2 * 99, 0.0), {}}};
    expect_fault(mesh, ErrorCode::wrong_length, path({"primvars", "a", "values"}));
    mesh.primvars[0].indices.assign(98, 0);
    expect_fault(mesh, ErrorCode::wrong_length, path({"primvars", "a", "indices"}));
  }
}

TEST(ControlMeshCheck, rejects_an_element_size_of_zero_or_too_wide) {
  for (Index size : {Index{0}, kMaxElementSize + 1}) {
    ControlMesh mesh = cube();
    mesh.primvars = {{"a", Interpolation::constant, size, {1}, {}}};
    expect_fault(mesh, ErrorCode::out_of_range, path({"primvars", "a", "elementSize"}));
    // Creases are looked at first, by a cage that counts the values of such a primvar.
    mesh.primvars[0].interpolation = Interpolation::face_varying;
    mesh.crease_indices = {mesh.face_vertex_indices[0], mesh.face_vertex_indices[1]};
    mesh.crease_lengths = {2};
    mesh.crease_sharpnesses = {1};
    expect_fault(mesh, ErrorCode::out_of_range, path({"primvars", "a", "elementSize"}));
  }
}

TEST(ControlMeshCheck, rejects_a_face_varying_index_past_the_values) {
  ControlMesh mesh = cube();
  mesh.primvars = {{"st", Interpolation::face_varying, 2, {0, 0, 1, 1}, std::vector<Index>(36, 0)}};
  mesh.primvars[0].indices[17] = 2;
  expect_fault(mesh, ErrorCode::out_of_range, path({"primvars", "st", "indices", index(17)}));
}

TEST(ControlMeshCheck, rejects_a_primvar_value_that_is_not_finite) {
  ControlMesh mesh = cube();
  mesh.primvars = {shapes::plain_primvar(mesh, "a", Interpolation::vertex, 2)};
  mesh.primvars[0].values[5] = std::numeric_limits<double>::quiet_NaN();
  expect_fault(mesh, ErrorCode::not_finite, path({"primvars", "a", "values", index(5)}));
}

TEST(ControlMeshCheck, rejects_render_faces_that_repeat_a_vertex) {
  ControlMesh triangle;
  triangle.points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  triangle.face_vertex_indices = {0, 1, 2};
  triangle.render_meshes = {{0, 1, 2, {0, 0, 1}}};
  expect_fault(triangle, ErrorCode::not_a_triangle, path({"renderMeshes", index(0)}));
  triangle.face_vertex_counts = {3};
  expect_fault(triangle, ErrorCode::not_a_triangle, path({"renderMeshes", index(0)}));

  ControlMesh mixed = cube();
  mixed.face_vertex_counts = {3, 4, 5};
  mixed.face_vertex_indices = {0, 1, 2, 0, 1, 2, 3, 4, 5, 6, 7, 0};
  mixed.render_meshes = {{0, 1, 3, {0, 1, 2}}, {1, 3, 9, {0, 1, 2, 3, 4, 5, 6, 7, 8}}};
  EXPECT_TRUE(mixed.check().ok());
  mixed.render_meshes[1].indices = {0, 1, 2, 3, 1, 2, 3, 4, 0};  // vertices that two faces share
  EXPECT_TRUE(mixed.check().ok());
  mixed.render_meshes[1].indices[8] = 2;
  expect_fault(mixed, ErrorCode::not_a_triangle, path({"renderMeshes", index(1)}));
}

TEST(ControlMeshCheck, rejects_render_meshes_that_overlap) {
  ControlMesh mesh = cube();
  mesh.render_meshes = {{0, 6, 8, {}}, {5, 12, 8, {}}};
  mesh.render_meshes[0].indices.assign(mesh.face_vertex_indices.begin(),
                                       mesh.face_vertex_indices.begin() + 18);
  mesh.render_meshes[1].indices.assign(mesh.face_vertex_indices.begin() + 15, mesh.face_vertex_indices.end());
  expect_fault(mesh, ErrorCode::out_of_range, path({"renderMeshes", index(1)}));
}

}  // namespace
}  // namespace subdivd

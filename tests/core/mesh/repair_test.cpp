#include "core/mesh/repair.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/shapes/build.h"

namespace subdivd {
namespace {

// Faces 0 and 2 are triangles, face 1 repeats point 1.
ControlMesh with_degenerate_face() {
  ControlMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  mesh.face_vertex_indices = {0, 1, 2, 1, 1, 3, 0, 2, 3};
  mesh.hole_indices = {2};
  mesh.primvars = {{"id", Interpolation::uniform, 1, {10, 11, 12}, {}},
                   {"st", Interpolation::face_varying, 1, {0, 1, 2, 3, 4, 5, 6, 7, 8}, {}}};
  return mesh;
}

TEST(DropDegenerateFaces, leaves_a_sound_mesh_alone) {
  ControlMesh mesh = shapes::cube();
  const auto faces = drop_degenerate_faces(mesh);
  ASSERT_TRUE(faces.ok());
  EXPECT_TRUE(faces->empty());
  EXPECT_EQ(mesh.face_count(), 12u);
}

TEST(DropDegenerateFaces, drops_the_face_and_all_that_hangs_on_it) {
  ControlMesh mesh = with_degenerate_face();
  const auto faces = drop_degenerate_faces(mesh);
  ASSERT_TRUE(faces.ok());
  EXPECT_EQ(*faces, (std::vector<Index>{0, 2}));
  EXPECT_EQ(mesh.face_vertex_indices, (std::vector<Index>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(mesh.hole_indices, std::vector<Index>{1});
  EXPECT_EQ(mesh.primvars[0].indices, (std::vector<Index>{0, 2}));
  EXPECT_EQ(mesh.primvars[1].indices, (std::vector<Index>{0, 1, 2, 6, 7, 8}));
  EXPECT_TRUE(mesh.check().ok());
}

TEST(DropDegenerateFaces, drops_creases_along_vanished_edges_only) {
  ControlMesh mesh = with_degenerate_face();
  mesh.crease_indices = {0, 1, 3, 2};  // 1-3 was an edge of the dropped face alone
  mesh.crease_lengths = {4};
  mesh.crease_sharpnesses = {2};
  ASSERT_TRUE(drop_degenerate_faces(mesh).ok());
  EXPECT_EQ(mesh.crease_indices, (std::vector<Index>{0, 1, 3, 2}));
  EXPECT_EQ(mesh.crease_lengths, (std::vector<Index>{2, 2}));
  EXPECT_EQ(mesh.crease_sharpnesses, (std::vector<float>{2, 2}));
  EXPECT_TRUE(mesh.check().ok());
}

TEST(DropDegenerateFaces, moves_render_meshes_along) {
  ControlMesh mesh = with_degenerate_face();
  mesh.render_meshes = {{0, 2, 5, {0, 1, 2, 1, 3, 4}}, {2, 3, 3, {0, 1, 2}}};
  ASSERT_TRUE(drop_degenerate_faces(mesh).ok());
  EXPECT_EQ(mesh.render_meshes[0].indices, (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(mesh.render_meshes[1].face_begin, 1u);
  EXPECT_EQ(mesh.render_meshes[1].face_end, 2u);
  EXPECT_TRUE(mesh.check().ok());
}

TEST(DropDegenerateFaces, refuses_to_drop_every_face) {
  ControlMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0};
  mesh.face_vertex_indices = {0, 1, 1};
  const auto faces = drop_degenerate_faces(mesh);
  ASSERT_FALSE(faces.ok());
  EXPECT_EQ(faces.error().code, ErrorCode::not_a_triangle);
}

TEST(DropDegenerateFaces, reports_arrays_that_do_not_fit_instead_of_reading_past_them) {
  ControlMesh mesh = with_degenerate_face();
  mesh.primvars[1].values.resize(4);
  const auto faces = drop_degenerate_faces(mesh);
  ASSERT_FALSE(faces.ok());
  mesh = with_degenerate_face();
  mesh.hole_indices = {99};
  EXPECT_FALSE(drop_degenerate_faces(mesh).ok());
}

TEST(Triangulate, splits_faces_into_fans_from_their_first_vertex) {
  ControlMesh mesh;
  mesh.points.assign(15, 0.0);
  for (int k = 0; k < 15; ++k) mesh.points[static_cast<std::size_t>(k)] = k * k;
  mesh.face_vertex_counts = {3, 5};
  mesh.face_vertex_indices = {0, 1, 2, 0, 2, 3, 4, 1};
  mesh.hole_indices = {1};
  mesh.primvars = {{"st", Interpolation::face_varying, 1, {0, 1, 2, 3, 4, 5, 6, 7}, {}},
                   {"id", Interpolation::uniform, 1, {10, 11}, {}}};
  const auto faces = triangulate(mesh);
  ASSERT_TRUE(faces.ok());
  EXPECT_EQ(faces->faces, (std::vector<Index>{0, 1, 1, 1}));
  EXPECT_EQ(faces->corners, (std::vector<Index>{0, 1, 2, 3, 4, 5, 3, 5, 6, 3, 6, 7}));
  EXPECT_EQ(mesh.face_vertex_indices, (std::vector<Index>{0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1}));
  EXPECT_EQ(mesh.hole_indices, (std::vector<Index>{1, 2, 3}));
  EXPECT_EQ(mesh.primvars[0].indices, (std::vector<Index>{0, 1, 2, 3, 4, 5, 3, 5, 6, 3, 6, 7}));
  EXPECT_EQ(mesh.primvars[1].indices, (std::vector<Index>{0, 1, 1, 1}));
  EXPECT_TRUE(mesh.check().ok());
}

// The fan from the first corner covered 4 x 4 / 2 and folded back over half of it.
TEST(Triangulate, does_not_fold_a_concave_face_and_takes_everything_along) {
  ControlMesh mesh;
  mesh.points = {0, 0, 0, 4, 0, 0, 4, 4, 0, 3, 1, 0, 0, 4, 0};
  mesh.face_vertex_counts = {3, 4};
  mesh.face_vertex_indices = {0, 3, 4, 0, 1, 2, 3};
  mesh.hole_indices = {1};
  mesh.primvars = {{"st", Interpolation::face_varying, 1, {0, 1, 2, 3, 4, 5, 6}, {}},
                   {"id", Interpolation::uniform, 1, {10, 11}, {}}};
  const auto made = triangulate(mesh);
  ASSERT_TRUE(made.ok());
  EXPECT_EQ(made->faces, (std::vector<Index>{0, 1, 1}));
  EXPECT_EQ(made->corners, (std::vector<Index>{0, 1, 2, 3, 4, 6, 4, 5, 6}));
  EXPECT_EQ(mesh.face_vertex_indices, (std::vector<Index>{0, 3, 4, 0, 1, 3, 1, 2, 3}));
  EXPECT_EQ(mesh.hole_indices, (std::vector<Index>{1, 2}));
  EXPECT_EQ(mesh.primvars[0].indices, (std::vector<Index>{0, 1, 2, 3, 4, 6, 4, 5, 6}));
  EXPECT_EQ(mesh.primvars[1].indices, (std::vector<Index>{0, 1, 1}));
  EXPECT_TRUE(mesh.check().ok());
}

TEST(Triangulate, cuts_render_meshes_as_it_cuts_the_faces) {
  ControlMesh mesh;
  mesh.points = {0, 0, 0, 4, 0, 0, 4, 4, 0, 3, 1, 0, 0, 4, 0};
  mesh.face_vertex_counts = {4, 3, 4};
  mesh.face_vertex_indices = {0, 1, 2, 3, 0, 3, 4, 3, 2, 1, 0};
  mesh.render_meshes = {{0, 0, 1, {}}, {0, 2, 6, {5, 4, 3, 2, 0, 1, 2}}, {2, 3, 4, {0, 1, 2, 3}}};
  ASSERT_TRUE(triangulate(mesh).ok());
  EXPECT_EQ(mesh.face_vertex_indices, (std::vector<Index>{0, 1, 3, 1, 2, 3, 0, 3, 4, 3, 2, 1, 3, 1, 0}));
  EXPECT_EQ(mesh.render_meshes[0].face_end, 0u);
  EXPECT_EQ(mesh.render_meshes[1].face_begin, 0u);
  EXPECT_EQ(mesh.render_meshes[1].face_end, 3u);
  EXPECT_EQ(mesh.render_meshes[1].indices, (std::vector<Index>{5, 4, 2, 4, 3, 2, 0, 1, 2}));
  EXPECT_EQ(mesh.render_meshes[2].face_begin, 3u);
  EXPECT_EQ(mesh.render_meshes[2].face_end, 5u);
  EXPECT_EQ(mesh.render_meshes[2].indices, (std::vector<Index>{0, 1, 2, 0, 2, 3}));
  EXPECT_TRUE(mesh.check().ok());
}

TEST(Triangulate, leaves_it_to_check_to_say_that_a_point_does_not_exist_or_is_not_finite) {
  ControlMesh mesh;
  mesh.points = {0, 0, 0, 4, 0, 0, 4, 4, 0, 3, 1, 0};
  mesh.face_vertex_counts = {4};
  mesh.face_vertex_indices = {0, 1, 2, 9};
  ASSERT_TRUE(triangulate(mesh).ok());
  EXPECT_EQ(mesh.check().error().code, ErrorCode::out_of_range);
  mesh.face_vertex_counts = {4};
  mesh.face_vertex_indices = {0, 1, 2, 3};
  mesh.points[10] = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(triangulate(mesh).ok());
  EXPECT_EQ(mesh.face_vertex_indices, (std::vector<Index>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(mesh.check().error().code, ErrorCode::not_finite);
}

TEST(Triangulate, refuses_a_face_of_two_vertices) {
  ControlMesh mesh;
  mesh.points.assign(12, 1.0);
  mesh.face_vertex_counts = {4, 2};
  mesh.face_vertex_indices = {0, 1, 2, 3, 0, 1};
  const auto faces = triangulate(mesh);
  ASSERT_FALSE(faces.ok());
  EXPECT_EQ(faces.error().where, (Path{"faceVertexCounts", std::uint64_t{1}}));
}

TEST(Triangulate, reports_arrays_that_do_not_fit_instead_of_reading_past_them) {
  ControlMesh mesh;
  mesh.points.assign(12, 1.0);
  mesh.face_vertex_counts = {4};
  mesh.face_vertex_indices = {0, 1, 2};
  EXPECT_FALSE(triangulate(mesh).ok());
  mesh.face_vertex_indices = {0, 1, 2, 3};
  mesh.primvars = {{"st", Interpolation::face_varying, 1, {0, 1}, {}}};
  EXPECT_FALSE(triangulate(mesh).ok());
}

}  // namespace
}  // namespace subdivd

#include "core/mesh/winding.h"

#include <gtest/gtest.h>

namespace subdivd {
namespace {

ControlMesh two_triangles() {
  ControlMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  mesh.face_vertex_indices = {0, 1, 2, 0, 2, 3};
  mesh.hole_indices = {1};
  mesh.primvars = {{"id", Interpolation::uniform, 1, {10, 11}, {}},
                   {"st", Interpolation::face_varying, 1, {0, 1, 2, 3, 4, 5}, {}},
                   {"uv", Interpolation::face_varying, 1, {7, 8}, {0, 1, 0, 1, 1, 0}}};
  return mesh;
}

TEST(ReverseWindings, turns_faces_round_their_first_corner_and_values_with_their_corners) {
  ControlMesh mesh = two_triangles();
  mesh.render_meshes = {{0, 2, 6, {0, 1, 2, 3, 4, 5}}};
  ASSERT_TRUE(reverse_windings(mesh).ok());
  EXPECT_EQ(mesh.face_vertex_indices, (std::vector<Index>{0, 2, 1, 0, 3, 2}));
  EXPECT_EQ(mesh.hole_indices, std::vector<Index>{1});
  EXPECT_TRUE(mesh.primvars[0].indices.empty());
  EXPECT_EQ(mesh.primvars[1].indices, (std::vector<Index>{0, 2, 1, 3, 5, 4}));
  EXPECT_EQ(mesh.primvars[2].indices, (std::vector<Index>{0, 0, 1, 1, 0, 1}));
  EXPECT_EQ(mesh.render_meshes[0].indices, (std::vector<Index>{0, 2, 1, 3, 5, 4}));
  EXPECT_TRUE(mesh.check().ok());
}

TEST(ReverseWindings, twice_is_the_mesh_itself) {
  ControlMesh mesh = two_triangles();
  ASSERT_TRUE(reverse_windings(mesh).ok());
  ASSERT_TRUE(reverse_windings(mesh).ok());
  EXPECT_EQ(mesh.face_vertex_indices, two_triangles().face_vertex_indices);
  EXPECT_EQ(mesh.primvars[2].indices, two_triangles().primvars[2].indices);
}

}  // namespace
}  // namespace subdivd

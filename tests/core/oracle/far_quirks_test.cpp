// Why the comparison leaves some of Far's answers out: each exception's reason, shown by Far itself.

#include <cmath>
#include <numbers>

#include "tests/core/oracle/far_vectors.h"
#include "tests/core/oracle/fixtures.h"

namespace subdivd::oracle::testing {
namespace {

// Far's vertex that is control point 0, the corner (0, 0) of face 0 in the shapes used here.
std::size_t vertex_0(const FarLevel<double>& far) {
  for (std::size_t v = 0; v < far.vertices.size(); ++v) {
    const Provenance& place = far.vertices[v].place;
    if (place.face == 0 && place.i == 0 && place.j == 0) return v;
  }
  ADD_FAILURE() << "no vertex at the corner of face 0";
  return 0;
}

ControlMesh with_dart() {
  ControlMesh mesh = shapes::disk(7);
  shapes::crease(mesh, {0, 1}, kInfiniteSharpness);
  return mesh;
}

// A limit does not depend on the level at which it is asked for. Far's does, at a dart, and creeps to ours.
TEST(FarQuirks, the_limit_of_a_dart_moves_from_level_to_level_towards_ours) {
  std::vector<double> distances;
  for (const Index level : {0u, 2u, 4u, 6u, 8u}) {
    const auto both = both_of(with_dart(), everything(level));
    distances.push_back(
        distance(at(both.far.limit_points, vertex_0(both.far)), at(both.ours.limit_points, 0)));
  }
  EXPECT_GT(distances.front(), 1e-3);
  for (std::size_t k = 1; k < distances.size(); ++k) EXPECT_LT(distances[k], 0.5 * distances[k - 1]) << k;
}

TEST(FarQuirks, our_limit_of_a_dart_does_not_move) {
  const auto coarse = both_of(with_dart(), everything(0)), fine = both_of(with_dart(), everything(6));
  EXPECT_LT(distance(at(coarse.ours.limit_points, 0), at(fine.ours.limit_points, 0)), 1e-14);
}

TEST(FarQuirks, darts_are_left_out_of_limits_and_counted) {
  const Deviation limits = find(both_of(with_dart()).compared(), "limitPoints");
  EXPECT_EQ(limits.excepted, 1u);
  EXPECT_NE(limits.exception.find("dart"), std::string::npos);
}

double angle_on_a_border_of(Index faces, Index level) {
  ControlMesh mesh = shapes::open_fan(faces);
  mesh.interpolate_boundary = BoundaryInterpolation::edge_only;
  for (std::size_t k = 2; k < mesh.points.size(); k += 3) mesh.points[k] += 0.1 * std::sin(5.0 * double(k));
  const auto both = both_of(mesh, everything(level));
  const double sine = distance(normal_of(both.far, vertex_0(both.far)), at(both.ours.normals, 0));
  return sine * 180 / std::numbers::pi;
}

TEST(FarQuirks, border_normals_of_up_to_three_faces_are_exact) {
  for (const Index faces : {1u, 2u, 3u})
    for (const Index level : {0u, 3u}) EXPECT_LT(angle_on_a_border_of(faces, level), 1e-9) << faces;
}

// A tangent mask that is a left eigenvector gives the same direction at every level.
TEST(FarQuirks, border_normals_of_more_faces_turn_from_level_to_level_towards_ours) {
  for (const Index faces : {4u, 5u, 6u}) {
    EXPECT_GT(angle_on_a_border_of(faces, 0), 2) << faces;
    for (Index level = 1; level <= 6; ++level)
      EXPECT_LT(angle_on_a_border_of(faces, level), 0.5 * angle_on_a_border_of(faces, level - 1)) << faces;
  }
}

// Two values in turns around point 0: 0 1 0 1.
ControlMesh with_values_in_turns() {
  ControlMesh mesh = shapes::disk(4);
  Primvar st = shapes::unindexed(mesh, "st", 2);
  st.indices.resize(12);
  for (Index c = 0; c < 12; ++c) st.indices[c] = c % 3 == 0 ? c / 3 % 2 : c;
  mesh.primvars = {st};
  return mesh;
}

TEST(FarQuirks, a_value_that_two_groups_of_faces_share_is_torn) {
  const auto both = both_of(with_values_in_turns(), everything(1));
  std::vector<Index> at_center;
  for (std::size_t c = 0; c < both.far.corners.size(); ++c)
    if (both.far.corners[c].i == 0 && both.far.corners[c].j == 0)
      at_center.push_back(both.far.primvars[0].indices[c]);
  std::sort(at_center.begin(), at_center.end());
  EXPECT_EQ(std::unique(at_center.begin(), at_center.end()) - at_center.begin(), 3);  // of two values
}

TEST(FarQuirks, faces_around_a_torn_value_are_left_out_and_counted) {
  const Deviation st = find(both_of(with_values_in_turns(), everything(1)).compared(), "primvars/st");
  EXPECT_EQ(st.verdict, Verdict::nothing_compared);
  EXPECT_EQ(st.excepted, 3u * 4 * 4);
  EXPECT_NE(st.exception.find("tears"), std::string::npos);
}

TEST(FarQuirks, values_without_turns_are_not_torn) {
  EXPECT_EQ(find(both_of(rich_mesh()).compared(), "primvars/st").excepted, 0u);
}

TEST(FarQuirks, face_varying_limits_are_single_precision_in_the_double_refiner) {
  const double deviation = find(both_of(rich_mesh()).compared(), "primvars/st/limit").max_relative;
  EXPECT_GT(deviation, 1e-10);
  EXPECT_LT(deviation, 1e-7);
}

// LimitFaceVarying at level 0 would read another value's tag, or past the end of the tags: 1000 values, 10
// used.
TEST(FarQuirks, face_varying_limits_of_the_control_mesh_are_not_asked_for) {
  ControlMesh mesh = rich_mesh();
  mesh.primvars[4].values.resize(2000, 0);
  const LevelReport report = both_of(mesh, everything(0)).compared();
  EXPECT_EQ(missed(report), "");
  EXPECT_EQ(report.deviations.back().quantity, "primvars/st");
}

TEST(FarQuirks, sharpness_rounds_where_three_semi_sharp_edges_meet) {
  ControlMesh mesh = shapes::icosahedron();
  const auto edges = shapes::edges_of(mesh);
  shapes::crease(mesh, {edges[0].first, edges[0].second}, 1.5f);
  EXPECT_FALSE(sharpness_rounds(mesh, patient()));
  for (const auto& [a, b] : edges) shapes::crease(mesh, {a, b}, 0.7f);
  EXPECT_TRUE(sharpness_rounds(mesh, patient()));
}

TEST(FarQuirks, infinite_creases_do_not_round) {
  ControlMesh mesh = shapes::icosahedron();
  for (const auto& [a, b] : shapes::edges_of(mesh)) shapes::crease(mesh, {a, b}, 1e38f);
  EXPECT_FALSE(sharpness_rounds(mesh, patient()));
}

}  // namespace
}  // namespace subdivd::oracle::testing

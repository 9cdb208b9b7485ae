// Why the comparison leaves some of Far's answers for quads and polygons out: each exception's reason, shown
// by Far itself.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/oracle/verify.h"
#include "tests/core/oracle/far_vectors.h"
#include "tests/core/oracle/polygon_fixtures.h"

namespace subdivd::oracle::testing {
namespace {

// Far's vertex at that place.
std::size_t vertex_at(const FarLevel<double>& far, const Provenance& place) {
  for (std::size_t v = 0; v < far.vertices.size(); ++v)
    if (far.vertices[v].place == place) return v;
  ADD_FAILURE() << "no vertex there";
  return 0;
}

// How far Far's limit of a control point is from ours, asked for at that level.
double limit_distance(const ControlMesh& mesh, Index point, Index level) {
  const auto both = both_of(mesh, everything(level));
  return distance(at(both.far.limit_points, vertex_at(both.far, both.ours.provenance[point])),
                  at(both.ours.limit_points, point));
}

// Ours is the same at every level.
void expect_our_limit_to_stay(const ControlMesh& mesh, Index point) {
  const auto coarse = refine<double>(mesh, everything(0), Budget{}),
             fine = refine<double>(mesh, everything(5), Budget{});
  EXPECT_LT(distance(at(coarse->limit_points, point), at(fine->limit_points, point)), 1e-13);
}

// Degrees between Far's normal at a control point and ours.
double normal_angle(const ControlMesh& mesh, Index point, Index level) {
  const auto both = both_of(mesh, everything(level));
  const double chord = distance(normal_of(both.far, vertex_at(both.far, both.ours.provenance[point])),
                                at(both.ours.normals, point));
  return 2 * std::asin(std::min(1.0, chord / 2)) * 180 / std::numbers::pi;
}

void expect_exception(const ControlMesh& mesh, Index level, const std::string& quantity, const char* words) {
  const Deviation deviation = find(both_of(mesh, everything(level)).compared(), quantity);
  EXPECT_GT(deviation.excepted, 0u);
  EXPECT_NE(deviation.exception.find(words), std::string::npos) << deviation.exception;
}

// --- Catmull and Clark's scheme ---

// A limit does not depend on the level at which it is asked for.
TEST(PolygonQuirks, the_limit_of_a_dart_moves_from_level_to_level_towards_ours) {
  const ControlMesh mesh = polygon_shape("cube_dart_100");
  double before = limit_distance(mesh, 0, 0);
  EXPECT_GT(before, 1e-3);
  for (const Index level : {2u, 4u, 6u}) {
    const double now = limit_distance(mesh, 0, level);
    EXPECT_LT(now, 0.5 * before) << level;
    before = now;
  }
  expect_our_limit_to_stay(mesh, 0);
  expect_exception(mesh, 1, "limitPoints", "dart");
}

TEST(PolygonQuirks, the_limit_of_a_point_of_two_faces_is_the_point_and_so_moves_towards_ours) {
  const ControlMesh mesh = polygon_shape("valence_two");
  const auto far = far_refine<double>(mesh, everything(1), Budget{});
  ASSERT_TRUE(far.ok());
  Count seen = 0;
  for (std::size_t v = 0; v < far->vertices.size(); ++v)
    if (far->vertices[v].faces == 2 && far->vertices[v].rule == FarRule::smooth) {
      EXPECT_LT(distance(at(far->limit_points, v), at(far->points, v)), 1e-15);
      ++seen;
    }
  EXPECT_EQ(seen, 2u);
  for (const Index point : {8u, 9u}) {
    EXPECT_GT(limit_distance(mesh, point, 1), 1e-3);
    EXPECT_LT(limit_distance(mesh, point, 5), 0.1 * limit_distance(mesh, point, 1));
    expect_our_limit_to_stay(mesh, point);
  }
  expect_exception(mesh, 1, "limitPoints", "two faces");
}

// Far's masks are of rings of quads: the level is the control mesh's own.
TEST(PolygonQuirks, limits_of_the_control_mesh_are_wrong_at_faces_other_than_quads) {
  for (const char* name : {"octahedron", "prism_of_5", "pole_of_5_triangles"}) {
    ControlMesh mesh = polygon_shape(name);
    mesh.subdivision_scheme = "catmullClark";
    EXPECT_GT(limit_distance(mesh, 0, 0), 1e-3) << name;
    EXPECT_LT(limit_distance(mesh, 0, 1), 1e-13) << name;
    expect_our_limit_to_stay(mesh, 0);
    expect_exception(mesh, 0, "limitPoints", "quads");
    EXPECT_EQ(find(both_of(mesh, everything(1)).compared(), "limitPoints").excepted, 0u) << name;
  }
  EXPECT_EQ(find(both_of(polygon_shape("quad_cube"), everything(0)).compared(), "limitPoints").excepted, 0u);
}

// `faces` quads around point 0, which lies on the border; neither flat nor regular.
ControlMesh border_of(Index faces) {
  ControlMesh mesh = polygon_shape("pole_of_8_quads");
  mesh.face_vertex_counts.resize(faces);
  mesh.face_vertex_indices.resize(std::size_t{4} * faces);
  mesh.interpolate_boundary = BoundaryInterpolation::edge_only;
  for (std::size_t k = 2; k < mesh.points.size(); k += 3) mesh.points[k] += 0.1 * std::sin(5.0 * double(k));
  return mesh;
}

TEST(PolygonQuirks, border_normals_of_up_to_two_faces_are_exact) {
  for (const Index faces : {1u, 2u})
    for (const Index level : {0u, 3u}) EXPECT_LT(normal_angle(border_of(faces), 0, level), 1e-6) << faces;
}

// A tangent mask that is a left eigenvector gives the same direction at every level.
TEST(PolygonQuirks, border_normals_of_more_faces_turn_from_level_to_level_towards_ours) {
  for (const Index faces : {3u, 4u, 6u}) {
    double before = normal_angle(border_of(faces), 0, 0);
    EXPECT_GT(before, 0.05) << faces;
    for (Index level = 1; level <= 5; ++level) {
      const double now = normal_angle(border_of(faces), 0, level);
      EXPECT_LT(now, 0.8 * before) << faces << " faces, level " << level;
      before = now;
    }
    expect_exception(border_of(faces), 1, "normals", "eigenvector");
  }
}

// --- tangents that would leave Far's buffers ---

// An edge of `faces` quads from point 0 to point 1.
ControlMesh book(Index faces) {
  ControlMesh mesh = shapes::mesh_of({{0, 0, 0}, {0, 0, 1}}, {});
  for (Index f = 0; f < faces; ++f) {
    const double angle = 6.0 * f / faces;
    mesh.points.insert(mesh.points.end(),
                       {std::cos(angle), std::sin(angle), 1.1, std::cos(angle), std::sin(angle), 0.2});
    mesh.face_vertex_counts.push_back(4);
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {0, 1, 2 * f + 2, 2 * f + 3});
  }
  return mesh;
}

ControlMesh beside(const ControlMesh& a, const ControlMesh& b) {
  ControlMesh both = shapes::join(a, b, {5, 0, 0});
  both.face_vertex_counts.insert(both.face_vertex_counts.end(), b.face_vertex_counts.begin(),
                                 b.face_vertex_counts.end());
  return both;
}

// Far has no room for the weights of a point of 200 faces and 102 edges: with sanitizers this is seen.
TEST(PolygonQuirks, tangents_beside_an_edge_of_many_faces_are_compared) {
  for (const Index faces : {3u, 14u, 100u}) {
    const auto both = both_of(beside(book(faces), polygon_shape("quad_torus")), everything(2));
    const LevelReport report = both.compared();
    EXPECT_EQ(missed(report), "") << faces;
    EXPECT_GT(find(report, "normals").compared, 100u) << faces;
  }
}

// Where a pole gives Far the room, it takes the tangents itself: they are the same.
TEST(PolygonQuirks, tangents_by_masks_are_those_of_fars_limit) {
  ControlMesh mesh = beside(book(5), polygon_shape("pole_of_5_quads"));
  const auto ours = far_refine<double>(mesh, everything(1), Budget{});
  const auto fars =
      far_refine<double>(beside(mesh, polygon_shape("pole_of_360_quads")), everything(1), Budget{});
  ASSERT_TRUE(ours.ok() && fars.ok());
  Count compared = 0;
  for (std::size_t v = 0; v < ours->vertices.size(); ++v) {
    if (ours->vertices[v].non_manifold) continue;
    const std::size_t same = vertex_at(*fars, ours->vertices[v].place);
    EXPECT_LT(distance(at(ours->tangents_u, v), at(fars->tangents_u, same)), 1e-14);
    EXPECT_LT(distance(at(ours->tangents_v, v), at(fars->tangents_v, same)), 1e-14);
    ++compared;
  }
  EXPECT_GT(compared, 50u);
}

// --- bilinear subdivision ---

// Two quads that meet at an angle along the edge of points 1 and 4.
ControlMesh roof() {
  ControlMesh mesh = shapes::mesh_of({{0, 0, 0}, {1, 0, 1}, {2, 0, 0}, {0, 1, 0}, {1, 1, 1}, {2, 1, 0}}, {});
  mesh.face_vertex_counts = {4, 4};
  mesh.face_vertex_indices = {0, 1, 4, 3, 1, 2, 5, 4};
  return bilinear(mesh);
}

TEST(PolygonQuirks, tangents_where_bilinear_pieces_meet_are_those_of_one_piece) {
  const auto far = far_refine<double>(roof(), everything(1), Budget{});
  ASSERT_TRUE(far.ok());
  const Vector middle = normal_of(*far, vertex_at(*far, {0, 2, 1}));
  std::vector<double> to_pieces;
  for (const Index face : {0u, 1u})
    to_pieces.push_back(distance(middle, normal_of(*far, vertex_at(*far, {face, 1, 1}))));
  std::sort(to_pieces.begin(), to_pieces.end());
  EXPECT_LT(to_pieces[0], 0.2);  // the points are moved a little: no piece is flat
  EXPECT_GT(to_pieces[1], 1);
  expect_exception(roof(), 1, "normals", "bilinear pieces");
  EXPECT_EQ(find(both_of(roof(), everything(1)).compared(), "normals").excepted,
            15u - 4 - 2);  // points of one face
}

// The points of a bilinear surface are its limits, those of a channel alone are moved by a cubic curve's
// rule.
TEST(PolygonQuirks, limits_of_bilinear_values_move_at_seams) {
  ControlMesh mesh = bilinear(polygon_shape("quad_torus"));
  mesh.primvars = {shapes::unindexed(mesh, "st", 2)};
  const auto both = both_of(mesh, everything(1));
  EXPECT_EQ(both.ours.primvars[0].values, both.ours.primvars[0].limit_values);
  EXPECT_EQ(both.far.points, both.far.limit_points);
  EXPECT_NE(both.far.primvars[0].values, both.far.primvars[0].limit_values);
  expect_exception(mesh, 1, "primvars/st/limit", "seams");
  mesh.face_varying_linear_interpolation = FaceVaryingInterpolation::all;
  const auto linear = both_of(mesh, everything(1));
  EXPECT_EQ(linear.far.primvars[0].values, linear.far.primvars[0].limit_values);
}

// Catmull and Clark's border faces have no surface then; bilinear ones have.
TEST(PolygonQuirks, bilinear_faces_at_an_open_border_are_no_holes) {
  ControlMesh mesh = polygon_shape("grid_border_none");
  const auto smooth = far_refine<double>(mesh, everything(1), Budget{}),
             linear = far_refine<double>(bilinear(mesh), everything(1), Budget{});
  ASSERT_TRUE(smooth.ok() && linear.ok());
  EXPECT_EQ(std::count(smooth->holes.begin(), smooth->holes.end(), 1), 24);
  EXPECT_EQ(std::count(linear->holes.begin(), linear->holes.end(), 1), 0);
  EXPECT_TRUE(both_of(bilinear(mesh), everything(1)).compared().connectivity_identical);
  const auto ours = refine<double>(bilinear(mesh), everything(1), Budget{});
  ASSERT_TRUE(ours.ok());
  EXPECT_EQ(ours->face_count, linear->base_faces.size());
  const auto report = verify<double>(bilinear(mesh), everything(1), Budget{});
  ASSERT_TRUE(report.ok());
  EXPECT_NE(report->verdict, Verdict::failed);
}

}  // namespace
}  // namespace subdivd::oracle::testing

// What would keep Far busy for long, or is more than it can count, is refused before Far is called.

#include "core/oracle/far_cost.h"

#include <algorithm>
#include <atomic>
#include <string>

#include "core/oracle/verify.h"
#include "core/refine/plan.h"
#include "tests/core/oracle/polygon_fixtures.h"

namespace subdivd::oracle::testing {
namespace {

// `faces` triangles on one edge, from point 0 to point 1.
ControlMesh book(Index faces) {
  std::vector<shapes::Point> points{{0, 0, 0}, {0, 0, 1}};
  std::vector<shapes::Triangle> triangles;
  for (Index f = 0; f < faces; ++f) {
    points.push_back({1, f / 7.0, f % 7 / 7.0});
    triangles.push_back({0, 1, 2 + f});
  }
  return shapes::mesh_of(points, triangles);
}

// Single faces that share nothing.
ControlMesh confetti(Index faces) {
  std::vector<shapes::Point> points;
  std::vector<shapes::Triangle> triangles;
  for (Index f = 0; f < faces; ++f) {
    const double x = f;
    points.insert(points.end(), {{x, 0, 0}, {x + 0.9, 0, 0.1}, {x, 0.9, 0.2}});
    triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  return shapes::mesh_of(points, triangles);
}

FarLoad load_of(const ControlMesh& mesh) {
  const auto load = far_load(mesh, Budget{});
  EXPECT_TRUE(load.ok());
  return load ? *load : FarLoad{};
}

// Of verify(), which may not begin: should the refusal fail, far_refine would run for a minute.
Error refusal(const ControlMesh& mesh, Index level) {
  const auto checked = check_far_size(mesh, level, Budget{});
  EXPECT_FALSE(checked.ok());
  return checked ? Error{} : checked.error();
}

TEST(FarCost, counts_what_far_searches) {
  const FarLoad fan = load_of(shapes::disk(1000));
  EXPECT_EQ(fan.points, 1001u);
  EXPECT_EQ(fan.edges, 2000u);
  EXPECT_EQ(fan.faces, 1000u);
  EXPECT_EQ(fan.searches, 1000u * 1000 + 1000 * 2 * 3);
  EXPECT_EQ(fan.busiest_point, 0u);
  EXPECT_EQ(fan.busiest_faces, 1000u);
  EXPECT_EQ(fan.busiest_edges, 1000u);
  EXPECT_EQ(fan.crowded_corners, 1000u);
  EXPECT_EQ(fan.torn_searches, 0u);
}

TEST(FarCost, counts_faces_of_an_edge_once_per_channel) {
  ControlMesh mesh = book(10);
  EXPECT_EQ(load_of(mesh).torn_searches, 0u);
  mesh.primvars = {shapes::unindexed(mesh, "a", 2), shapes::unindexed(mesh, "b", 1)};
  EXPECT_EQ(load_of(mesh).most_faces_of_an_edge, 10u);
  EXPECT_EQ(load_of(mesh).torn_searches, 2u * 3 * 10 * 10);
}

// Far begins its search at the end of a crease that is named first; we name the one with fewer edges.
TEST(FarCost, a_spoke_is_looked_for_at_the_rim) {
  ControlMesh mesh = shapes::disk(1000);
  for (Index k = 1; k <= 1000; ++k) shapes::crease(mesh, {0, k}, 2);
  EXPECT_EQ(load_of(mesh).crease_searches, 3000u);
}

TEST(FarCost, points_near_the_last_face_are_not_distant) {
  EXPECT_EQ(load_of(shapes::grid(20, 200)).distant_corners, 0u);
  ControlMesh mesh = shapes::grid(20, 200);
  for (std::size_t f = 0; f < mesh.face_count() / 2; f += 2)  // first and last in turns
    std::swap_ranges(mesh.face_vertex_indices.begin() + std::ptrdiff_t(3 * f),
                     mesh.face_vertex_indices.begin() + std::ptrdiff_t(3 * f + 3),
                     mesh.face_vertex_indices.end() - std::ptrdiff_t(3 * f + 3));
  EXPECT_GT(load_of(mesh).distant_corners, mesh.face_vertex_indices.size() / 2);
}

// 400,000 faces on one edge took 53 s in Far until it found that a point has too many faces.
TEST(FarCost, refuses_points_of_more_faces_than_far_counts_and_names_one) {
  const Error error = refusal(book(400000), 1);
  EXPECT_EQ(error.code, ErrorCode::unsupported);
  EXPECT_EQ(error.where, (Path{"points", 0u}));
  EXPECT_NE(error.message.find("400000 faces"), std::string::npos) << error.message;
  EXPECT_NE(error.message.find("65535"), std::string::npos) << error.message;
}

// Half a minute for eight levels, all of it searching.
TEST(FarCost, refuses_a_fan_of_the_most_faces_that_far_counts_and_names_its_point) {
  const Error error = refusal(shapes::disk(65535), 1);
  EXPECT_EQ(error.code, ErrorCode::too_large);
  EXPECT_EQ(error.where, (Path{"points", 0u}));
  EXPECT_NE(error.message.find("65535 faces"), std::string::npos) << error.message;
  EXPECT_EQ(error.allowed, 1000u);
  EXPECT_GT(error.predicted, 1000u);
}

TEST(FarCost, refuses_many_points_of_many_faces) {
  ControlMesh mesh = shapes::disk(15000);
  for (int k = 0; k < 5; ++k) mesh = shapes::join(mesh, shapes::disk(15000), {3.0 * k, 0, 0});
  EXPECT_EQ(refusal(shapes::join(mesh, mesh, {0, 5, 0}), 1).code, ErrorCode::too_large);
}

// Each new point along the edge has 3 faces for every face of the edge, and is asked for each of them.
TEST(FarCost, refuses_values_torn_along_an_edge_of_many_faces) {
  ControlMesh mesh = book(8000);
  EXPECT_TRUE(check_far_size(mesh, 4, Budget{}).ok());
  mesh.primvars = {shapes::unindexed(mesh, "st", 2)};
  const Error error = refusal(mesh, 4);
  EXPECT_EQ(error.code, ErrorCode::too_large);
  EXPECT_NE(error.message.find("an edge of 8000 faces"), std::string::npos) << error.message;
}

TEST(FarCost, refuses_more_faces_than_far_refines_in_one_go) {
  const Error error = refusal(shapes::big_torus(40, 40, 1), 8);
  EXPECT_EQ(error.code, ErrorCode::too_large);
  EXPECT_NE(error.message.find("3200 faces to level 8"), std::string::npos) << error.message;
  EXPECT_TRUE(check_far_size(shapes::icosahedron(), 8, Budget{}).ok());
  EXPECT_TRUE(check_far_size(shapes::big_torus(300, 300, 1), 2, Budget{}).ok());
}

TEST(FarCost, refuses_many_channels_sooner) {
  ControlMesh mesh = shapes::big_torus(40, 40, 1);
  EXPECT_TRUE(check_far_size(mesh, 5, Budget{}).ok());
  for (int k = 0; k < 40; ++k) mesh.primvars.push_back(shapes::unindexed(mesh, std::to_string(k), 1));
  EXPECT_EQ(refusal(mesh, 5).code, ErrorCode::too_large);
}

TEST(FarCost, refuses_a_million_faces_in_random_order) {
  ControlMesh mesh = shapes::big_torus(400, 400, 1);
  EXPECT_TRUE(check_far_size(mesh, 1, Budget{}).ok());
  const std::size_t faces = mesh.face_count();
  for (std::size_t f = 0; f < faces; ++f) {
    const std::size_t other = f * 7919 % faces;
    std::swap_ranges(mesh.face_vertex_indices.begin() + std::ptrdiff_t(3 * f),
                     mesh.face_vertex_indices.begin() + std::ptrdiff_t(3 * f + 3),
                     mesh.face_vertex_indices.begin() + std::ptrdiff_t(3 * other));
  }
  EXPECT_EQ(refusal(mesh, 1).code, ErrorCode::too_large);
}

TEST(FarCost, takes_points_of_a_few_thousand_faces) {
  for (const ControlMesh& mesh : {shapes::disk(3000), shapes::double_pyramid(3000), book(3000)}) {
    const auto report = verify<double>(mesh, everything(1), Budget{});
    ASSERT_TRUE(report.ok());
    EXPECT_NE(report->verdict, Verdict::failed);
  }
}

TEST(FarCost, takes_many_tiny_components) {
  const auto report = verify<double>(confetti(20000), everything(1), Budget{});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->verdict, Verdict::passed);
}

// --- quads and polygons ---

// One face of so many corners, and a triangle at its first edge.
ControlMesh large_face(Index corners) {
  ControlMesh mesh;
  for (Index k = 0; k <= corners; ++k) mesh.points.insert(mesh.points.end(), {1.0 * k, k % 7 / 7.0, 0});
  mesh.face_vertex_counts = {3, corners};
  mesh.face_vertex_indices = {1, 0, corners};
  for (Index k = 0; k < corners; ++k) mesh.face_vertex_indices.push_back(k);
  mesh.subdivision_scheme = "catmullClark";
  return mesh;
}

TEST(FarCost, counts_what_far_searches_of_quads) {
  const FarLoad fan = load_of(polygon_shape("pole_of_360_quads"));
  EXPECT_EQ(fan.shape, GridShape::quads);
  EXPECT_EQ(fan.points, 721u);
  EXPECT_EQ(fan.edges, 360u + 720);
  EXPECT_EQ(fan.faces, 360u);
  EXPECT_EQ(fan.corners, 1440u);
  EXPECT_EQ(fan.searches, 360u * 360 + 360 * 2 * 3 + 360 * 1 * 2);
  EXPECT_EQ(fan.corner_searches, 360u * 4 * 4);
  EXPECT_EQ(fan.busiest_point, 0u);
  EXPECT_EQ(fan.most_corners, 4u);
}

TEST(FarCost, counts_what_far_searches_of_polygons) {
  const FarLoad prism = load_of(polygon_shape("prism_of_7"));
  EXPECT_EQ(prism.shape, GridShape::corners);
  EXPECT_EQ(prism.edges, 21u);
  EXPECT_EQ(prism.corners, 2u * 7 + 7 * 4);
  EXPECT_EQ(prism.corner_searches, 2u * 7 * 7 + 7 * 4 * 4);
  EXPECT_EQ(prism.largest_face, 0u);
  EXPECT_EQ(prism.most_corners, 7u);
}

// The elements of a level are those that are there.
TEST(FarCost, predicts_the_refinement_of_quads_and_polygons_by_what_far_makes_of_them) {
  for (const char* name : {"quad_torus", "prism_of_7", "octahedron"}) {
    ControlMesh mesh = polygon_shape(name);
    mesh.subdivision_scheme = "catmullClark";
    Count elements = 0;
    for (Index level = 1; level <= 3; ++level) {
      const auto plan = Plan::build(mesh, {}, Budget{});
      ASSERT_TRUE(plan.ok());
      const LevelCounts counts = plan->mesh().lattice()->counts(level);
      elements += counts.vertices + counts.edges + counts.faces;
      EXPECT_EQ(far_refine_time(load_of(mesh), level), elements * 60'000) << name;
    }
  }
}

// Far keeps corners in 16 bits.
TEST(FarCost, refuses_faces_of_more_corners_than_far_counts_and_names_one) {
  const Error error = refusal(large_face(65536), 1);
  EXPECT_EQ(error.code, ErrorCode::unsupported);
  EXPECT_EQ(error.where, (Path{"faceVertexCounts", 1u}));
  EXPECT_NE(error.message.find("65536"), std::string::npos) << error.message;
  EXPECT_NE(error.message.find("65535"), std::string::npos) << error.message;
  EXPECT_EQ(refusal(large_face(100000), 1).code, ErrorCode::unsupported);
}

// 65,535 corners took 2.9 s in Create, of which nobody can stop it.
TEST(FarCost, refuses_a_face_that_far_would_search_for_long_and_names_it) {
  const Error error = refusal(large_face(65535), 1);
  EXPECT_EQ(error.code, ErrorCode::too_large);
  EXPECT_EQ(error.where, (Path{"faceVertexCounts", 1u}));
  EXPECT_NE(error.message.find("65535"), std::string::npos) << error.message;
  EXPECT_GT(error.predicted, 1000u);
}

TEST(FarCost, takes_a_face_of_many_corners) {
  const auto report = verify<double>(large_face(5000), everything(1), Budget{});
  ASSERT_TRUE(report.ok()) << report.error().message;
  EXPECT_EQ(report->verdict, Verdict::passed);
}

TEST(FarCost, refuses_many_large_faces) {
  ControlMesh mesh = large_face(20000);
  const ControlMesh one = mesh;
  EXPECT_TRUE(check_far_size(one, 1, Budget{}).ok());
  for (int k = 0; k < 7; ++k) {
    mesh.face_vertex_counts.push_back(20000);
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), one.face_vertex_indices.begin() + 3,
                                    one.face_vertex_indices.end());
  }
  EXPECT_EQ(refusal(mesh, 1).code, ErrorCode::too_large);
}

TEST(FarCost, refuses_more_quads_than_far_refines_in_one_go) {
  ControlMesh mesh = polygon_shape("quad_torus");  // 20 quads
  EXPECT_TRUE(check_far_size(mesh, 8, Budget{}).ok());
  const Error error = refusal(mesh, 9);
  EXPECT_EQ(error.code, ErrorCode::too_large);
  EXPECT_NE(error.message.find("20 faces to level 9"), std::string::npos) << error.message;
}

TEST(FarCost, refuses_schemes_of_other_names) {
  ControlMesh mesh = polygon_shape("quad_torus");
  mesh.subdivision_scheme = "none";
  EXPECT_EQ(refusal(mesh, 1).where, (Path{"subdivisionScheme"}));
}

TEST(FarCost, refuses_schemes_that_far_does_not_have) {
  ControlMesh mesh = shapes::icosahedron();
  mesh.subdivision_scheme = "butterfly";
  const Error error = refusal(mesh, 1);
  EXPECT_EQ(error.code, ErrorCode::unsupported);
  EXPECT_NE(error.message.find("OpenSubdiv does not know this scheme"), std::string::npos) << error.message;
  EXPECT_EQ(far_refine<double>(mesh, everything(1), Budget{}).error().code, ErrorCode::unsupported);
  EXPECT_EQ(verify<double>(mesh, everything(1), Budget{}).error().code, ErrorCode::unsupported);
}

TEST(FarCost, curves_and_surfaces_are_refused_before_they_begin) {
  ControlCurves curves;
  curves.width = 1;
  curves.wrap = CurveWrap::pinned;
  curves.vertex_counts = {200000};
  curves.points.assign(200000, 1);
  const auto curve = verify<double>(curves, {.level = 5}, Budget{});
  ASSERT_FALSE(curve.ok());
  EXPECT_EQ(curve.error().code, ErrorCode::too_large);

  ControlPatch patch{"", 100, 100, 3, 3, CurveWrap::pinned, CurveWrap::pinned, 1, {}};
  patch.points.assign(10000, 1);
  const auto surface = verify<double>(patch, {.level = 5}, Budget{});
  ASSERT_FALSE(surface.ok());
  EXPECT_EQ(surface.error().code, ErrorCode::too_large);
  EXPECT_NE(surface.error().message.find("quads"), std::string::npos) << surface.error().message;
}

TEST(FarCost, stops_counting_when_nobody_waits_any_more) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  const auto load = far_load(shapes::icosahedron(), budget);
  ASSERT_FALSE(load.ok());
  EXPECT_EQ(load.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace subdivd::oracle::testing

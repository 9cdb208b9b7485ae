#include "core/oracle/far.h"

#include <atomic>
#include <thread>

#include "tests/core/oracle/fixtures.h"

namespace subdivd::oracle::testing {
namespace {

ErrorCode refusal(const ControlMesh& mesh, Index level, const Budget& budget = {}) {
  const auto refined = far_refine<float>(mesh, everything(level), budget);
  return refined ? ErrorCode::internal : refined.error().code;
}

TEST(Far, counts_are_the_closed_forms) {
  for (Index level = 0; level <= 4; ++level) {
    const auto far = far_refine<double>(shapes::icosahedron(), everything(level), Budget{});
    ASSERT_TRUE(far.ok());
    const LevelCounts counts = refined_counts(12, 30, 20, level);
    EXPECT_EQ(far->vertices.size(), counts.vertices);
    EXPECT_EQ(far->base_faces.size(), counts.faces);
  }
}

TEST(Far, corners_of_a_face_are_neighbours_on_the_grid) {
  const auto far = far_refine<double>(rich_mesh(), everything(3), Budget{});
  ASSERT_TRUE(far.ok());
  for (std::size_t f = 0; f < far->base_faces.size(); ++f) {
    const GridPoint* c = &far->corners[3 * f];
    // Twice the area in grid units: 1 for a triangle of the grid, counter-clockwise.
    const auto area = (std::int64_t{c[1].i} - c[0].i) * (std::int64_t{c[2].j} - c[0].j) -
                      (std::int64_t{c[2].i} - c[0].i) * (std::int64_t{c[1].j} - c[0].j);
    ASSERT_EQ(area, 1);
    for (int k = 0; k < 3; ++k) ASSERT_LE(c[k].i + c[k].j, 8u);
  }
}

TEST(Far, unreferenced_points_stay_where_they_are) {
  ControlMesh mesh = shapes::icosahedron();
  mesh.points.insert(mesh.points.end(), {7, 8, 9});
  const auto both = both_of(mesh);
  EXPECT_EQ(missed(both.compared()), "");
  EXPECT_EQ(both.ours.points[3 * 12 + 2], 9);
  EXPECT_EQ(find(both.compared(), "normals").excepted, 1u);
}

TEST(Far, the_last_sharpness_given_to_an_edge_counts) {
  ControlMesh mesh = shapes::icosahedron();
  shapes::crease(mesh, {0, 1, 2}, 10);
  shapes::crease(mesh, {1, 0}, 0);
  EXPECT_EQ(missed(both_of(mesh).compared()), "");
}

TEST(Far, refuses_levels_that_do_not_fit_its_four_bits) {
  EXPECT_EQ(refusal(shapes::tetrahedron(), kMaxFarLevel + 1), ErrorCode::out_of_range);
  EXPECT_EQ(refusal(shapes::tetrahedron(), 16), ErrorCode::out_of_range);  // 16 & 15 == 0
}

TEST(Far, refuses_a_mesh_without_faces) {
  ControlMesh mesh;
  mesh.points = {0, 0, 0};
  EXPECT_EQ(refusal(mesh, 1), ErrorCode::unsupported);
}

TEST(Far, refuses_more_corners_than_an_int_counts) {
  EXPECT_EQ(refusal(shapes::big_torus(20, 20, 1), 10), ErrorCode::too_large);
}

TEST(Far, refuses_more_memory_than_allowed_before_taking_it) {
  Budget budget;
  budget.max_bytes = 1000000;
  EXPECT_EQ(refusal(shapes::icosahedron(), 4, budget), ErrorCode::too_large);
  EXPECT_TRUE(far_refine<float>(shapes::icosahedron(), everything(2), budget).ok());
}

TEST(Far, refuses_coordinates_that_single_precision_cannot_hold) {
  ControlMesh mesh = shapes::tetrahedron();
  mesh.points[4] = 1e39;
  EXPECT_EQ(refusal(mesh, 1), ErrorCode::out_of_range);
}

TEST(Far, stops_when_nobody_waits_any_more) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_EQ(refusal(shapes::tetrahedron(), 1, budget), ErrorCode::cancelled);
}

// What Far has to say it says through a process-wide callback: it must reach the thread that asked, and
// nobody else. Its words are not for callers; they get ours. (check() would have refused this crease, which
// runs along no edge. Nothing that has passed it is known to come to a refusal by Far.)
TEST(Far, reports_a_refusal_to_the_thread_that_caused_it) {
  ControlMesh mesh = shapes::icosahedron();
  shapes::crease(mesh, {0, 11}, 2);
  Error error;
  bool other_failed = false;
  std::thread guilty([&] {
    const auto refused = far_refine<float>(mesh, everything(1), Budget{});
    if (!refused) error = refused.error();
  });
  std::thread innocent([&] {
    for (int k = 0; k < 200; ++k)
      other_failed |= !far_refine<float>(shapes::icosahedron(), everything(1), Budget{}).ok();
  });
  guilty.join();
  innocent.join();
  EXPECT_EQ(error.code, ErrorCode::unsupported);
  EXPECT_EQ(error.message, "OpenSubdiv refuses this topology; it can be refined here, but not verified");
  EXPECT_FALSE(other_failed);
}

TEST(Far, the_estimate_of_memory_grows_with_primvars) {
  EXPECT_GT(far_mesh_bytes(rich_mesh(), 3), far_mesh_bytes(shapes::double_pyramid(5), 3));
}

}  // namespace
}  // namespace subdivd::oracle::testing

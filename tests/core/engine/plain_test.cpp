// The plain engine's own properties; that it agrees with the fast one is tested in tests/core/refine.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <vector>

#include "core/base/budget.h"
#include "core/engine/plain/level.h"
#include "core/engine/plain/split.h"
#include "tests/core/engine/levels.h"
#include "tests/shapes/build.h"
#include "tests/shapes/shapes.h"

namespace subdivd::plain {
namespace {

TEST(PlainRows, sum_to_one_for_every_scheme) {
  for (const auto& [name, mesh] : shapes::all_shapes())
    for_each_scheme(AllGridSchemes(), [&]<class S>(const S& scheme) {
      SCOPED_TRACE(name);
      Level level = base_level(mesh);
      for (int depth = 0; depth < 2; ++depth, level = next_level(level, S::split, CreaseMethod::uniform)) {
        const SparseRows rows = written_out(rows_of(scheme, CreaseMethod::uniform, level, false));
        ASSERT_EQ(rows.row_count(), child_count(S::split, level.faces));
        for (Count r = 0; r < rows.row_count(); ++r) {
          double sum = 0;
          for (Count k = rows.offsets[r]; k < rows.offsets[r + 1]; ++k) sum += rows.weights[k];
          ASSERT_NEAR(sum, 1, 1e-12) << r;
        }
      }
    });
}

TEST(PlainRows, are_midpoints_when_linear) {
  const Level level = base_level(shapes::icosahedron());
  const SparseRows rows = written_out(rows_of(AnyGridScheme(), CreaseMethod::uniform, level, true));
  for (Count r = 0; r < rows.row_count(); ++r)
    for (Count k = rows.offsets[r]; k < rows.offsets[r + 1]; ++k)
      EXPECT_EQ(rows.weights[k], r < level.faces.vertex_count() ? 1 : 0.5);
}

TEST(PlainRows, apply_to_values_of_any_width) {
  SparseRows rows;
  rows.add(1, 0.25);
  rows.add(0, 0.75);
  rows.end_row();
  rows.end_row();  // an empty row is zero
  const std::vector<double> values{1, 2, 5, 6};
  EXPECT_EQ(apply<double>(rows, values, 2), (std::vector<double>{2, 3, 0, 0}));
}

// The row of a hub may have millions of columns.
TEST(PlainRows, application_stops_within_a_row) {
  SparseRows rows;
  for (int k = 0; k < 40000; ++k) rows.add(0, 1);
  rows.end_row();
  std::atomic<bool> gone = false;
  Budget budget;
  budget.cancelled = &gone;
  const std::vector<double> values{1};
  const auto applied = stoppable(budget, [&](const Pace& pace) {
    pace.spend(1);  // the first call polls
    gone = true;
    return apply<double>(rows, values, 1, pace);
  });
  ASSERT_FALSE(applied.ok());
  EXPECT_EQ(applied.error().code, ErrorCode::cancelled);
}

TEST(PlainLevel, keeps_every_edge_that_the_step_before_made) {
  for (const auto& [name, mesh] : shapes::all_shapes()) {
    SCOPED_TRACE(name);
    const Level level = base_level(mesh), next = next_level(level, Split::triangles, CreaseMethod::uniform);
    ASSERT_EQ(next.faces.edge_count(), 2 * level.faces.edge_count() + level.faces.half_edge_count());
    for (Index h = 0; h < next.faces.half_edge_count(); ++h) {
      const auto ends = next.faces.edge_vertices(next.faces.half_edge_edge(h));
      const Index a = next.faces.corner_vertex(h), b = next.faces.corner_vertex(next.faces.next(h));
      ASSERT_EQ(ends[0], std::min(a, b));
      ASSERT_EQ(ends[1], std::max(a, b));
    }
  }
}

TEST(PlainLevel, stops_when_the_budget_says_so) {
  Level level = base_level(shapes::icosahedron());
  for (int depth = 0; depth < 4; ++depth) level = next_level(level, Split::triangles, CreaseMethod::uniform);
  Budget budget;
  budget.deadline = Budget::Clock::now();
  const auto rows = stoppable(
      budget, [&](const Pace& pace) { rows_of(AnyGridScheme(), CreaseMethod::uniform, level, false, pace); });
  ASSERT_FALSE(rows.ok());
  EXPECT_EQ(rows.error().code, ErrorCode::deadline_exceeded);
  EXPECT_FALSE(stoppable(budget, [&](const Pace& pace) {
                 next_level(level, Split::triangles, CreaseMethod::uniform, pace);
               }).ok());
}

}  // namespace
}  // namespace subdivd::plain

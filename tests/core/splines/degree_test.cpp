#include "core/splines/degree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/core/splines/sample_splines.h"

namespace subdivd {
namespace {

TEST(DegreeElevation, keeps_the_curve) {
  for (const auto& [name, spline] : samples::all_splines())
    for (const Index times : {0u, 1u, 3u}) {
      const auto elevated = elevate_degree(spline, times, {});
      ASSERT_TRUE(elevated) << name;
      ASSERT_TRUE(elevated->check()) << name << elevated->check().error().message;
      EXPECT_EQ(elevated->degree, spline.degree + times);
      EXPECT_LT(samples::deviation(spline, *elevated), 1e-12 * extent(spline)) << name << ' ' << times;
      for (const double t : spline.knots)
        if (t > spline.begin() && t < spline.end()) {
          EXPECT_EQ(multiplicity(elevated->knots, t), multiplicity(spline.knots, t) + times) << name;
        }
    }
}

// The Bezier rule: Q_i = i / (p + 1) P_{i-1} + (1 - i / (p + 1)) P_i.
TEST(DegreeElevation, of_one_piece_is_exact) {
  const Spline piece{3, 1, false, false, {0, 0, 0, 0, 1, 1, 1, 1}, {0, 4, 8, 4}};
  const auto elevated = elevate_degree(piece, 1, {});
  ASSERT_TRUE(elevated);
  EXPECT_EQ(elevated->points, (std::vector<double>{0, 3, 6, 7, 4}));
}

TEST(DegreeElevation, goes_up_to_the_highest_degree) {
  const Spline line{1, 2, false, false, {0, 0, 1, 2, 2}, {0, 0, 1, 1, 2, 0}};
  const auto elevated = elevate_degree(line, kMaxDegree - 1, {});
  ASSERT_TRUE(elevated);
  EXPECT_LT(samples::deviation(line, *elevated), 1e-12);
  EXPECT_EQ(elevate_degree(line, kMaxDegree, {}).error().where, Path{"degree"});
}

TEST(DegreeElevation, leaves_a_circle_a_circle) {
  const auto elevated = elevate_degree(samples::circle(), 4, {});
  ASSERT_TRUE(elevated);
  for (const double t : samples::parameters(*elevated)) {
    const auto point = samples::point_at(*elevated, t);
    EXPECT_NEAR(std::hypot(point[0], point[1]), 1, 1e-14) << t;
  }
}

TEST(DegreeReduction, takes_back_an_elevation) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const auto elevated = elevate_degree(spline, 1, {});
    ASSERT_TRUE(elevated);
    const auto reduced = reduce_degree(*elevated, {});
    ASSERT_TRUE(reduced) << name;
    EXPECT_EQ(reduced->spline.degree, spline.degree);
    EXPECT_LT(reduced->bound, 1e-12) << name;
    EXPECT_LT(samples::deviation(spline, reduced->spline), 1e-12 * extent(spline)) << name;
  }
}

TEST(DegreeReduction, stays_within_the_bound_it_states_and_keeps_the_ends) {
  for (const auto& [name, spline] : samples::all_splines()) {
    if (spline.degree < 2) continue;
    const auto reduced = reduce_degree(spline, {});
    if (!reduced) {
      EXPECT_EQ(reduced.error().code, ErrorCode::unsupported) << name;
      continue;
    }
    ASSERT_TRUE(reduced->spline.check()) << name;
    EXPECT_LE(samples::deviation(spline, reduced->spline), reduced->bound + 1e-13) << name;
    for (const double t : {spline.begin(), spline.end()})
      EXPECT_LT(samples::distance(samples::point_at(spline, t), samples::point_at(reduced->spline, t)), 1e-14)
          << name;
  }
}

TEST(DegreeReduction, ends_at_polylines) {
  const Spline line{1, 2, false, false, {0, 0, 1, 2, 2}, {0, 0, 1, 1, 2, 0}};
  EXPECT_EQ(reduce_degree(line, {}).error().where, Path{"degree"});
  const auto bent = reduce_degree({2, 1, false, false, {0, 0, 0, 1, 1, 1}, {0, 1, 0}}, {});
  ASSERT_TRUE(bent);
  EXPECT_EQ(bent->spline.points, (std::vector<double>{0, 0}));
  EXPECT_EQ(bent->bound, 1);
}

TEST(Degree, stops_when_nobody_waits) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_EQ(elevate_degree(samples::circle(), 1, budget).error().code, ErrorCode::cancelled);
  EXPECT_EQ(reduce_degree(samples::circle(), budget).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace subdivd

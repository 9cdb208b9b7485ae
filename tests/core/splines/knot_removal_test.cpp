#include "core/splines/knot_removal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "core/splines/knot_insertion.h"
#include "tests/core/splines/sample_splines.h"

namespace subdivd {
namespace {

TEST(KnotRemoval, takes_back_an_insertion) {
  for (const auto& [name, spline] : samples::all_splines())
    for (const Index times : {1u, spline.degree}) {
      const double t = (2 * spline.begin() + spline.end()) / 3;
      const auto inserted = insert_knot(spline, t, times);
      ASSERT_TRUE(inserted) << name;
      const auto removal = remove_knot(*inserted, t, times, 1e-9);
      ASSERT_TRUE(removal) << name;
      EXPECT_EQ(removal->times, times) << name;
      EXPECT_LT(removal->result.bound, 1e-12) << name;
      EXPECT_EQ(removal->result.spline.knots, spline.knots) << name;
      for (std::size_t k = 0; k < spline.points.size(); ++k)
        EXPECT_NEAR(removal->result.spline.points[k], spline.points[k], 1e-12) << name;
      EXPECT_LT(samples::deviation(spline, removal->result.spline), 1e-12 * extent(spline)) << name;
    }
}

TEST(KnotRemoval, stays_within_the_bound_it_states) {
  int removed = 0;
  for (const auto& [name, spline] : samples::all_splines()) {
    const std::set<double> knots(spline.knots.begin(), spline.knots.end());
    for (const double t : knots) {
      if (!(t > spline.begin() && t < spline.end())) continue;
      for (const double tolerance : {0.0, 0.1, 1.0, 100.0}) {
        const auto removal = remove_knot(spline, t, 2, tolerance);
        ASSERT_TRUE(removal);
        EXPECT_LE(removal->result.bound, tolerance) << name;
        ASSERT_TRUE(removal->result.spline.check()) << name;
        EXPECT_LE(samples::deviation(spline, removal->result.spline), removal->result.bound + 1e-13)
            << name << ' ' << t << ' ' << tolerance;
        EXPECT_EQ(multiplicity(removal->result.spline.knots, t),
                  multiplicity(spline.knots, t) - removal->times);
        removed += static_cast<int>(removal->times);
        if (removal->times == 0) {
          EXPECT_EQ(removal->result.spline.points, spline.points);
        }
      }
    }
  }
  EXPECT_GT(removed, 300);
}

// The bound is of use: it is not far above what is measured.
TEST(KnotRemoval, states_a_bound_that_is_near_the_truth) {
  const Spline spline = samples::random_spline(9, 3, 3, false, true, 1);
  const auto removal = remove_knot(spline, spline.knots[5], 1, 100);
  ASSERT_EQ(removal->times, 1);
  EXPECT_GT(samples::deviation(spline, removal->result.spline), removal->result.bound / 5);
}

TEST(KnotRemoval, refuses_what_is_no_knot_inside) {
  const Spline circle = samples::circle();
  for (const double t : {0.5, 0.0, 4.0, -1.0, std::nan("")})
    EXPECT_EQ(remove_knot(circle, t, 1, 1).error().code, ErrorCode::out_of_range) << t;
  for (const double tolerance : {-1.0, std::nan(""), static_cast<double>(INFINITY)})
    EXPECT_EQ(remove_knot(circle, 1, 1, tolerance).error().where, Path{"tolerance"});
}

// The circle's pieces meet with one derivative only in the parameter: its knots are double and stay so.
TEST(KnotRemoval, leaves_a_circle_a_circle) {
  const auto thinned = remove_knots(samples::circle(), 1e-12, {});
  ASSERT_TRUE(thinned);
  for (const double t : samples::parameters(thinned->result.spline)) {
    const auto point = samples::point_at(thinned->result.spline, t);
    EXPECT_NEAR(std::hypot(point[0], point[1]), 1, 1e-12);
  }
}

TEST(KnotRemoval, finds_all_the_knots_that_carry_nothing) {
  for (const auto& [name, spline] : samples::all_splines()) {
    std::vector<double> knots;
    for (int k = 1; k < 40; ++k)
      if (const double t = spline.begin() + (spline.end() - spline.begin()) * k / 40;
          multiplicity(spline.knots, t) == 0)
        knots.push_back(t);
    const auto refined = refine_knots(spline, knots, {});
    ASSERT_TRUE(refined);
    const auto thinned = remove_knots(*refined, 1e-6, {});
    ASSERT_TRUE(thinned);
    EXPECT_GE(thinned->removed, knots.size()) << name;
    EXPECT_LE(thinned->result.bound, 1e-6);
    EXPECT_LT(samples::deviation(spline, thinned->result.spline), thinned->result.bound + 1e-12) << name;
  }
}

TEST(KnotRemoval, of_many_takes_time_by_their_number) {
  Spline spline{3, 2, false, false, {}, {}};
  constexpr int kPoints = 100000;
  for (int k = 0; k < kPoints + 4; ++k) spline.knots.push_back(k);
  for (int k = 0; k < kPoints; ++k) {  // a straight line
    spline.points.push_back(k);
    spline.points.push_back(2 * k);
  }
  const auto thinned = remove_knots(spline, 1e-3, {});
  ASSERT_TRUE(thinned);
  EXPECT_EQ(thinned->result.spline.point_count(), 4);
}

// As if every knot were removed from what the one before it has left, to the bit.
TEST(KnotRemoval, of_a_list_is_that_of_its_knots_one_by_one) {
  Count removed = 0;
  for (const auto& [name, spline] : samples::all_splines())
    for (const double tolerance : {0.0, 0.05, 1.0, 100.0}) {
      std::vector<double> listed;
      for (const double t : spline.knots)
        if (t > spline.begin() && t < spline.end()) listed.push_back(t);
      shapes::Random random(7);
      for (std::size_t k = listed.size(); k > 1; --k) std::swap(listed[k - 1], listed[random.below(k)]);
      listed.push_back(listed.front());  // it may be gone by then, or not
      Approximation expected{spline, 0};
      Count times = 0;
      for (const double t : listed) {
        if (multiplicity(expected.spline.knots, t) == 0) continue;
        const auto removal = remove_knot(expected.spline, t, 1, tolerance - expected.bound);
        ASSERT_TRUE(removal) << name;
        expected.spline = removal->result.spline;
        expected.bound += removal->result.bound;
        times += removal->times;
      }
      const auto thinned = remove_knots(spline, listed, tolerance, {});
      ASSERT_TRUE(thinned) << name;
      EXPECT_EQ(thinned->removed, times) << name;
      EXPECT_EQ(thinned->result.bound, expected.bound) << name;
      EXPECT_EQ(thinned->result.spline.knots, expected.spline.knots) << name;
      EXPECT_EQ(thinned->result.spline.points, expected.spline.points) << name;
      removed += times;
    }
  EXPECT_GT(removed, 300u);
}

TEST(KnotRemoval, of_a_list_says_which_of_them_is_no_knot) {
  const std::vector<double> listed{1, 2, 2.5};
  const auto refused = remove_knots(samples::circle(), listed, 0, {});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::out_of_range);
  EXPECT_EQ(refused.error().where, Path{std::uint64_t{2}});
}

TEST(KnotRemoval, stops_when_nobody_waits) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_EQ(remove_knots(samples::circle(), 1, budget).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace subdivd

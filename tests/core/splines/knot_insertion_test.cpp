#include "core/splines/knot_insertion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/core/splines/fraction.h"
#include "tests/core/splines/sample_splines.h"

namespace subdivd {
namespace {

// Inside every span, and at every knot that has room.
std::vector<double> places(const Spline& spline) {
  std::vector<double> all;
  for (Count k = spline.degree; k <= spline.point_count(); ++k) {
    const double t = spline.knots[k];
    const bool at_end = t == spline.begin() || t == spline.end();
    if (multiplicity(spline.knots, t) < spline.degree + (at_end ? 1 : 0)) all.push_back(t);
    if (k < spline.point_count() && t < spline.knots[k + 1])
      all.push_back(t + 0.37 * (spline.knots[k + 1] - t));
  }
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

TEST(KnotInsertion, keeps_the_curve) {
  for (const auto& [name, spline] : samples::all_splines())
    for (const double t : places(spline)) {
      const auto inserted = insert_knot(spline, t, 1);
      ASSERT_TRUE(inserted) << name << ' ' << t;
      ASSERT_TRUE(inserted->check()) << name << ' ' << t << ' ' << inserted->check().error().message;
      EXPECT_EQ(inserted->point_count(), spline.point_count() + 1);
      EXPECT_EQ(multiplicity(inserted->knots, t), multiplicity(spline.knots, t) + 1);
      EXPECT_LT(samples::deviation(spline, *inserted), 1e-12 * extent(spline)) << name << ' ' << t;
    }
}

// A quadratic over 0 0 0 1 2 2 2 with points 0, 1, 5, 7: the knot 1/2 makes 0, 1/2, 2, 5, 7.
TEST(KnotInsertion, is_exact_where_numbers_are) {
  const Spline spline{2, 1, false, false, {0, 0, 0, 1, 2, 2, 2}, {0, 1, 5, 7}};
  const auto inserted = insert_knot(spline, 0.5, 1);
  ASSERT_TRUE(inserted);
  EXPECT_EQ(inserted->points, (std::vector<double>{0, 0.5, 2, 5, 7}));
  EXPECT_EQ(inserted->knots, (std::vector<double>{0, 0, 0, 0.5, 1, 2, 2, 2}));
}

TEST(KnotInsertion, as_often_as_the_degree_puts_a_point_onto_the_curve) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const double t = (spline.begin() + 2 * spline.end()) / 3;
    const auto inserted = insert_knot(spline, t, spline.degree);
    ASSERT_TRUE(inserted) << name;
    const std::vector<double> expected = samples::point_at(spline, t), all = control_points_of(*inserted);
    double nearest = 1e300;
    for (Count i = 0; i < inserted->point_count(); ++i) {
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(i * spline.dimension());
      nearest = std::min(nearest, samples::distance({first, first + spline.dimension()}, expected));
    }
    EXPECT_LT(nearest, 1e-14) << name;
  }
}

TEST(KnotInsertion, of_many_is_one_after_the_other) {
  for (const auto& [name, spline] : samples::all_splines()) {
    std::vector<double> knots;
    for (const double t : places(spline)) {
      const bool at_end = t == spline.begin() || t == spline.end();
      const Index room = spline.degree + (at_end ? 1 : 0) - multiplicity(spline.knots, t);
      knots.insert(knots.end(), std::min<Index>(room, 3), t);
    }
    std::ranges::sort(knots);
    const auto together = refine_knots(spline, knots, {});
    ASSERT_TRUE(together) << name;
    Spline one = spline;
    for (const double t : knots) {
      auto next = insert_knot(one, t, 1);
      ASSERT_TRUE(next);
      one = *std::move(next);
    }
    EXPECT_EQ(together->knots, one.knots) << name;
    ASSERT_EQ(together->points.size(), one.points.size());
    for (std::size_t k = 0; k < one.points.size(); ++k)
      EXPECT_NEAR(together->points[k], one.points[k], 1e-14);
    EXPECT_LT(samples::deviation(spline, *together), 1e-12 * extent(spline)) << name;
  }
}

TEST(KnotInsertion, stays_inside_the_control_points) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const double largest = *std::ranges::max_element(spline.points);
    for (const double t : places(spline))
      EXPECT_LE(*std::ranges::max_element(insert_knot(spline, t, 1)->points), largest) << name;
  }
}

TEST(KnotInsertion, refuses_too_many_and_what_lies_outside) {
  const Spline circle = samples::circle();
  EXPECT_EQ(insert_knot(circle, 1, 1).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(insert_knot(circle, 0.5, 3).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(insert_knot(circle, 0, 1).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(insert_knot(circle, -1, 1).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(insert_knot(circle, std::nan(""), 1).error().code, ErrorCode::out_of_range);
  EXPECT_TRUE(insert_knot(circle, 0.5, 2));
  const std::vector<double> falling{0.5, 0.25}, full{0.5, 0.5, 0.5}, late{0.25, 0.5, 1}, none{std::nan("")};
  EXPECT_EQ(refine_knots(circle, falling, {}).error().where, Path{std::uint64_t{1}});
  EXPECT_EQ(refine_knots(circle, full, {}).error().where, Path{std::uint64_t{0}});
  EXPECT_EQ(refine_knots(circle, late, {}).error().where, Path{std::uint64_t{2}});
  EXPECT_FALSE(refine_knots(circle, none, {}).ok());
}

// A quarter of a million of knots: in linear time it takes no time at all.
TEST(KnotInsertion, of_many_takes_time_by_their_number) {
  Spline spline{3, 2, false, false, {}, {}};
  constexpr int kPoints = 200000;
  for (int k = 0; k < kPoints + 4; ++k) spline.knots.push_back(k);
  for (int k = 0; k < 2 * kPoints; ++k) spline.points.push_back(std::sin(k));
  std::vector<double> knots;
  for (int k = 3; k < kPoints; ++k) knots.push_back(k + 0.5);
  const auto refined = refine_knots(spline, knots, {});
  ASSERT_TRUE(refined);
  for (const double t : {3.0, 777.25, 150000.75, double(kPoints)})
    EXPECT_LT(samples::distance(samples::point_at(spline, t), samples::point_at(*refined, t)), 1e-14);
}

TEST(RefineSpans, halves_every_span_and_keeps_the_curve) {
  for (const auto& [name, spline] : samples::all_splines())
    for (const Index level : {0u, 1u, 3u}) {
      const auto refined = refine_spans(spline, level, {});
      ASSERT_TRUE(refined) << name;
      ASSERT_TRUE(refined->check()) << name;
      EXPECT_EQ(refined->point_count(), refined_point_count(spline, level)) << name;
      EXPECT_LT(samples::deviation(spline, *refined), 1e-12 * extent(spline)) << name;
    }
}

TEST(RefineSpans, step_by_step_is_at_once) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const auto twice = refine_spans(*refine_spans(spline, 1, {}), 1, {}),
               at_once = refine_spans(spline, 2, {});
    EXPECT_EQ(twice->knots, at_once->knots) << name;
    for (std::size_t k = 0; k < twice->points.size(); ++k)
      EXPECT_NEAR(twice->points[k], at_once->points[k], 1e-14);
  }
}

TEST(RefineSpans, knows_its_size_beforehand_and_stops) {
  const Spline circle = samples::circle();
  EXPECT_EQ(refine_spans(circle, 30, {}).error().code, ErrorCode::too_large);
  Budget small;
  small.max_bytes = 1000;
  EXPECT_EQ(refine_spans(circle, 5, small).error().code, ErrorCode::too_large);
  const std::atomic<bool> gone = true;
  Budget cancelled;
  cancelled.cancelled = &gone;
  EXPECT_EQ(refine_spans(circle, 5, cancelled).error().code, ErrorCode::cancelled);
  Spline tiny = circle;
  for (double& t : tiny.knots) t = 1 + t * 0x1p-52;
  EXPECT_EQ(refine_spans(tiny, 3, {}).error().code, ErrorCode::out_of_range);
}

}  // namespace
}  // namespace subdivd

#include "core/curves/flatten_subdivided.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "tests/core/curves/sample_curves.h"

namespace subdivd::testing {
namespace {

ControlCurves curve_of_scheme(const CurveBasis& basis, CurveWrap wrap, Index more, Index width = 2) {
  ControlCurves rule;
  rule.basis = basis;
  rule.wrap = wrap;
  return random_curve(rule, more, width);
}

std::vector<ControlCurves> all_curves() {
  std::vector<ControlCurves> all;
  for (const CurveWrap wrap : kAllWraps)
    for (const Index more : {0u, 4u}) {
      for (const double tension : {0.0, 1.0 / 16, 0.12, 0.19})
        all.push_back(curve_of_scheme(FourPoint{tension}, wrap, more));
      for (const double ratio : {0.05, 0.25, 1.0 / 3, 0.45})
        all.push_back(curve_of_scheme(CornerCutting{ratio}, wrap, more, 3));
    }
  return all;
}

SubdividedCurve only(const ControlCurves& curves) { return *subdivided_curve(curves, 0, {}); }

Result<Polyline> flat(const ControlCurves& curves, double tolerance, const Budget& budget = {}) {
  return flatten(only(curves), {.tolerance = tolerance}, budget);
}

std::vector<double> point_at(const ControlCurves& curves, double t) {
  std::vector<double> point(curves.width);
  if (!derivatives(only(curves), t, 0, point)) point.assign(point.size(), std::nan(""));
  return point;
}

double distance_from_segment(const std::vector<double>& p, const double* a, const double* b) {
  double along = 0, length = 0, square = 0;
  for (Count k = 0; k < p.size(); ++k)
    along += (p[k] - a[k]) * (b[k] - a[k]), length += std::pow(b[k] - a[k], 2);
  const double share = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
  for (Count k = 0; k < p.size(); ++k) square += std::pow(p[k] - (a[k] + share * (b[k] - a[k])), 2);
  return std::sqrt(square);
}

// The farthest that the curve gets from its polyline, each part from its own chord.
double worst_distance(const ControlCurves& curves, const Polyline& polyline, int count) {
  double worst = 0;
  for (Count i = 0; i + 1 < polyline.parameters.size(); ++i) {
    const double begin = polyline.parameters[i], end = polyline.parameters[i + 1];
    const double* a = &polyline.points[i * curves.width];
    for (int k = 0; k <= count; ++k) {
      const double t = begin + (end - begin) * k / count;
      worst = std::max(worst, distance_from_segment(point_at(curves, t), a, a + curves.width));
    }
  }
  return worst;
}

TEST(FlattenSubdivided, never_exceeds_its_tolerance_and_comes_near_it) {
  for (const ControlCurves& curves : all_curves())
    for (const double tolerance : {0.1, 1e-3}) {
      const auto polyline = flat(curves, tolerance);
      ASSERT_TRUE(polyline.ok()) << polyline.error().message << name_of_rule(curves);
      EXPECT_EQ(polyline->points.size(), polyline->parameters.size() * curves.width);
      EXPECT_TRUE(std::ranges::is_sorted(polyline->parameters));
      EXPECT_EQ(polyline->parameters.front(), only(curves).begin());
      EXPECT_EQ(polyline->parameters.back(), only(curves).end());
      const double worst = worst_distance(curves, *polyline, 5);
      ASSERT_LE(worst, tolerance) << name_of_rule(curves);
      // The polygon, and the straight line between two points.
      const FourPoint* four_point = std::get_if<FourPoint>(&curves.basis);
      const bool exact = four_point != nullptr && (four_point->tension == 0 || curves.point_count() == 2);
      ASSERT_TRUE(exact || tolerance == 0.1 || worst > tolerance / 200) << name_of_rule(curves);
    }
}

TEST(FlattenSubdivided, corners_are_points_of_the_curve) {
  for (const ControlCurves& curves : all_curves()) {
    const auto polyline = flat(curves, 1e-3);
    ASSERT_TRUE(polyline.ok());
    for (Count i = 0; i < polyline->parameters.size(); ++i) {
      const auto point = point_at(curves, polyline->parameters[i]);
      for (Index k = 0; k < curves.width; ++k)
        ASSERT_NEAR(polyline->points[i * curves.width + k], point[k], 1e-14) << name_of_rule(curves);
    }
  }
}

// A smooth curve is off a chord by the square of its length.
TEST(FlattenSubdivided, a_sixteenth_of_the_tolerance_takes_some_four_times_the_corners) {
  for (const ControlCurves& curves : {curve_of_scheme(FourPoint{1.0 / 16}, CurveWrap::periodic, 4),
                                      curve_of_scheme(CornerCutting{0.25}, CurveWrap::periodic, 4)}) {
    const auto coarse = flat(curves, 1e-4), fine = flat(curves, 1e-4 / 256);
    ASSERT_TRUE(coarse.ok() && fine.ok());
    const double growth = double(fine->parameters.size()) / double(coarse->parameters.size());
    EXPECT_GT(growth, 12);
    EXPECT_LT(growth, 20);
  }
}

TEST(FlattenSubdivided, control_points_of_four_point_are_corners_to_the_bit) {
  for (const CurveWrap wrap : kAllWraps) {
    ControlCurves curves = curve_of_scheme(FourPoint{0.1}, wrap, 3);
    for (double& x : curves.points) x = 1e3 + x / 3;
    curves.points[4] = 1e-5 / 3;  // loses bits on the way to the curve's centre and back
    const auto polyline = flat(curves, 1e-3);
    ASSERT_TRUE(polyline.ok());
    for (Count i = 0; i < polyline->parameters.size(); ++i) {
      const double t = polyline->parameters[i];
      if (t != std::floor(t)) continue;
      const Count control = static_cast<Count>(t) % curves.point_count();
      for (Index k = 0; k < 2; ++k) EXPECT_EQ(polyline->points[2 * i + k], curves.points[2 * control + k]);
    }
  }
}

TEST(FlattenSubdivided, tension_zero_is_the_control_polygon_whatever_the_tolerance) {
  const auto curves = curve_of_scheme(FourPoint{0}, CurveWrap::pinned, 5);
  const auto polyline = flat(curves, 1e-300);
  ASSERT_TRUE(polyline.ok());
  EXPECT_EQ(polyline->points, curves.points);
}

TEST(FlattenSubdivided, equal_points_are_as_many_corners_as_cells_have_ends) {
  for (ControlCurves curves : all_curves()) {
    std::ranges::fill(curves.points, 0.1);
    const auto polyline = flat(curves, 1e-300);
    ASSERT_TRUE(polyline.ok());
    EXPECT_EQ(double(polyline->parameters.size()), only(curves).end() - only(curves).begin() + 1);
    for (const double x : polyline->points) EXPECT_EQ(x, 0.1);
  }
}

TEST(FlattenSubdivided, a_pinned_curve_keeps_its_ends_to_the_bit) {
  ControlCurves curves = curve_of_scheme(CornerCutting{0.3}, CurveWrap::pinned, 4);
  for (double& x : curves.points) x = 1e3 + x / 3;
  curves.points.front() = curves.points.back() = 1e-5 / 3;
  const auto polyline = flat(curves, 1e-3);
  ASSERT_TRUE(polyline.ok());
  for (Index k = 0; k < 2; ++k) {
    EXPECT_EQ(polyline->points[k], curves.points[k]);
    EXPECT_EQ(polyline->points[polyline->points.size() - 2 + k], curves.points[curves.points.size() - 2 + k]);
  }
}

// Interpolating curves leave the box of their control points; so must corners.
TEST(FlattenSubdivided, corners_may_lie_outside_the_control_points) {
  ControlCurves curves = curve_of_scheme(FourPoint{1.0 / 16}, CurveWrap::pinned, 2, 1);
  curves.points = {0, 1, 1, 0};
  const auto polyline = flat(curves, 1e-4);
  ASSERT_TRUE(polyline.ok());
  EXPECT_GT(*std::ranges::max_element(polyline->points), 1.1);
}

TEST(FlattenSubdivided, scaling_by_a_power_of_two_scales_the_corners) {
  for (const ControlCurves& curves : all_curves())
    for (const int exponent : {-900, 900}) {
      ControlCurves scaled = curves;
      for (double& x : scaled.points) x = std::ldexp(x, exponent);
      const auto there = flat(curves, 1e-3), here = flat(scaled, std::ldexp(1e-3, exponent));
      ASSERT_TRUE(there.ok() && here.ok());
      std::vector<double> expected = there->points;
      for (double& x : expected) x = std::ldexp(x, exponent);
      EXPECT_EQ(here->points, expected);
      EXPECT_EQ(here->parameters, there->parameters);
    }
}

ErrorCode refusal_of(const ControlCurves& curves, const FlattenOptions& options, const Budget& budget = {}) {
  const auto polyline = flatten(only(curves), options, budget);
  return polyline ? ErrorCode::internal : polyline.error().code;
}

TEST(FlattenSubdivided, refuses_tolerances_that_rounding_does_not_allow) {
  const auto curves = curve_of_scheme(FourPoint{1.0 / 16}, CurveWrap::pinned, 3);
  for (const double tolerance : {0.0, -1.0, std::nan(""), HUGE_VAL, 1e-16, 5e-15})
    EXPECT_EQ(refusal_of(curves, {.tolerance = tolerance}), ErrorCode::out_of_range) << tolerance;
  ControlCurves far = curves;
  for (double& x : far.points) x += 1e9;
  EXPECT_EQ(refusal_of(far, {.tolerance = 1e-8}), ErrorCode::out_of_range);
  EXPECT_TRUE(flat(far, 1e-5).ok());
}

TEST(FlattenSubdivided, refuses_more_corners_than_allowed) {
  const auto curves = curve_of_scheme(CornerCutting{0.25}, CurveWrap::periodic, 4);
  const auto polyline = flat(curves, 1e-3);
  ASSERT_TRUE(polyline.ok());
  const Count corners = polyline->parameters.size();
  EXPECT_EQ(refusal_of(curves, {1e-3, corners - 1}), ErrorCode::too_large);
  EXPECT_EQ(refusal_of(curves, {1e-3, 3}), ErrorCode::too_large);
  EXPECT_TRUE(flatten(only(curves), {1e-3, corners}, {}).ok());
  Budget small;
  small.max_bytes = corners * 3 * sizeof(double) - 1;
  EXPECT_EQ(refusal_of(curves, {.tolerance = 1e-3}, small), ErrorCode::too_large);
}

TEST(FlattenSubdivided, stops_when_the_caller_is_gone) {
  const std::atomic<bool> gone{true};
  Budget budget;
  budget.cancelled = &gone;
  const auto curves = curve_of_scheme(FourPoint{0.1}, CurveWrap::pinned, 300);
  EXPECT_EQ(refusal_of(curves, {.tolerance = 1e-6}, budget), ErrorCode::cancelled);
}

// Near its bound a cut at almost the middle crawls: halves shrink by two thousandths. Refused or done, not
// for ever.
TEST(FlattenSubdivided, extreme_ratios_and_sizes_come_to_an_end) {
  for (const double ratio : {1e-6, 0.499}) {
    const auto curves = curve_of_scheme(CornerCutting{ratio}, CurveWrap::pinned, 2);
    const auto polyline = flatten(only(curves), {1e-3, 20000}, {});
    EXPECT_TRUE(!polyline || worst_distance(curves, *polyline, 3) <= 1e-3);
  }
  constexpr double kMax = std::numeric_limits<double>::max();
  ControlCurves large = curve_of_scheme(FourPoint{0.1}, CurveWrap::pinned, 2, 1);
  large.points = {-kMax, kMax, kMax, -kMax};
  EXPECT_EQ(refusal_of(large, {.tolerance = kMax / 100}), ErrorCode::out_of_range);
}

}  // namespace
}  // namespace subdivd::testing

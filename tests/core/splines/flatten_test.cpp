#include "core/splines/flatten.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/splines/bspline.h"
#include "tests/core/splines/sample_splines.h"

namespace subdivd {
namespace {

using samples::bezier;

Polyline flattened(const Spline& spline, double tolerance) {
  auto polyline = flatten(spline, {tolerance}, Budget{});
  EXPECT_TRUE(polyline.ok());
  return polyline ? *std::move(polyline) : Polyline{};
}

ErrorCode refusal(const Spline& spline, const FlattenOptions& options, const Budget& budget = {}) {
  const auto polyline = flatten(spline, options, budget);
  return polyline ? ErrorCode::internal : polyline.error().code;
}

std::vector<double> corner(const Polyline& polyline, Count i) {
  const Count d = polyline.points.size() / polyline.parameters.size();
  const auto first = polyline.points.begin() + static_cast<std::ptrdiff_t>(i * d);
  return {first, first + static_cast<std::ptrdiff_t>(d)};
}

double distance_from_segment(const std::vector<double>& p, const std::vector<double>& a,
                             std::vector<double> b) {
  double along = 0, square = 0;
  for (Count k = 0; k < p.size(); ++k)
    along += (p[k] - a[k]) * (b[k] - a[k]), square += (b[k] - a[k]) * (b[k] - a[k]);
  const double share = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
  for (Count k = 0; k < p.size(); ++k) b[k] = a[k] + share * (b[k] - a[k]);
  return samples::distance(p, b);
}

// The farthest that the curve gets from the segment over the same parameters, at `count` places of each.
double worst_distance(const Spline& spline, const Polyline& polyline, int count) {
  double worst = 0;
  for (Count i = 0; i + 1 < polyline.parameters.size(); ++i) {
    const double begin = polyline.parameters[i], end = polyline.parameters[i + 1];
    const auto a = corner(polyline, i), b = corner(polyline, i + 1);
    for (int k = 0; k <= count; ++k)
      worst = std::max(
          worst, distance_from_segment(
                     samples::point_at(spline, std::min(end, begin + (end - begin) * k / count)), a, b));
  }
  return worst;
}

TEST(Flatten, never_exceeds_its_tolerance) {
  for (const auto& [name, spline] : samples::all_splines())
    for (const double tolerance : {1.0, 1e-1, 1e-2, 1e-4})
      ASSERT_LE(worst_distance(spline, flattened(spline, tolerance), 20), tolerance) << name;
}

// Where rounding is a good part of the tolerance.
TEST(Flatten, never_exceeds_a_tolerance_close_to_rounding) {
  Spline line = bezier(2, {0.1, 0.2, 1.1 / 3, 0.7, 1.7, 2.9, 0.3, 1e-3});
  for (double& x : line.points) x += 1e6;
  const auto polyline = flatten(line, {1e-9}, Budget{});
  ASSERT_TRUE(polyline.ok());
  // evaluate() itself is off by some last bits of 1e6.
  EXPECT_LE(worst_distance(line, *polyline, 3), 1e-9 + 1e-9 / 2);
}

TEST(Flatten, takes_no_more_than_four_times_the_fewest_points_of_a_circle) {
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    const double fewest = std::numbers::pi / std::acos(1 - tolerance);
    const auto points = static_cast<double>(flattened(samples::circle(), tolerance).parameters.size());
    EXPECT_GE(points, fewest);
    EXPECT_LE(points, 4 * fewest) << tolerance;
  }
}

TEST(Flatten, has_its_corners_on_the_curve) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const Polyline polyline = flattened(spline, 1e-2);
    ASSERT_EQ(polyline.points.size(), polyline.parameters.size() * spline.dimension());
    for (Count i = 0; i < polyline.parameters.size(); ++i)
      ASSERT_LT(samples::distance(corner(polyline, i), samples::point_at(spline, polyline.parameters[i])),
                1e-13)
          << name;
  }
}

TEST(Flatten, rises_from_the_begin_to_the_end_through_all_knots) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const Polyline polyline = flattened(spline, 1e-2);
    EXPECT_EQ(polyline.parameters.front(), spline.begin()) << name;
    EXPECT_EQ(polyline.parameters.back(), spline.end()) << name;
    for (Count i = 1; i < polyline.parameters.size(); ++i)
      ASSERT_LT(polyline.parameters[i - 1], polyline.parameters[i]) << name;
    for (const double knot : spline.knots) {
      const bool inside = knot >= spline.begin() && knot <= spline.end();
      EXPECT_TRUE(!inside || std::ranges::binary_search(polyline.parameters, knot)) << name;
    }
  }
}

TEST(Flatten, keeps_clamped_ends_to_the_bit) {
  const Spline spline = bezier(2, {0.1, 0.2, 3, 4, 0.7, 0.9});
  const Polyline polyline = flattened(spline, 1e-3);
  EXPECT_EQ(corner(polyline, 0), (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(corner(polyline, polyline.parameters.size() - 1), (std::vector<double>{0.7, 0.9}));
}

TEST(Flatten, of_a_line_is_its_ends) {
  EXPECT_EQ(flattened(bezier(3, {0, 0, 0, 1, 2, 3, 2, 4, 6, 3, 6, 9}), 1e-9).parameters.size(), 2u);
}

// All control points lie on the line through the ends, but the curve goes beyond them and turns: the distance
// from a line would miss that.
TEST(Flatten, follows_a_curve_beyond_the_ends_of_its_chord) {
  const Spline spline = bezier(1, {0, 5, -4, 1});
  const Polyline polyline = flattened(spline, 1e-3);
  double highest = 0;
  for (const double t : samples::parameters(spline))
    highest = std::max(highest, samples::point_at(spline, t)[0]);
  EXPECT_GT(highest, 1.2);
  EXPECT_GE(*std::ranges::max_element(polyline.points), highest - 1e-3);
}

TEST(Flatten, of_a_closed_piece_does_not_stop_at_its_empty_chord) {
  const Spline loop = bezier(2, {0, 0, 2, 2, -2, 2, 0, 0});
  EXPECT_LE(worst_distance(loop, flattened(loop, 1e-3), 50), 1e-3);
}

TEST(Flatten, of_coincident_points_is_two_corners) {
  const Polyline polyline = flattened(bezier(2, {5, 6, 5, 6, 5, 6}), 1e-300);
  EXPECT_EQ(polyline.points, (std::vector<double>{5, 6, 5, 6}));
}

TEST(Flatten, of_a_cusp_keeps_the_tolerance) {
  const Spline cusp = bezier(2, {1, -1, -1.0 / 3, 1, -1.0 / 3, -1, 1, 1});
  EXPECT_LE(worst_distance(cusp, flattened(cusp, 1e-5), 20), 1e-5);
}

TEST(Flatten, is_the_same_at_every_scale) {
  const Spline spline = samples::random_spline(3, 5, 3, false, true, 2);
  const Polyline plain = flattened(spline, 0x1p-10);
  for (const int exponent : {-500, -332, 332, 500}) {
    Spline scaled = spline;
    for (double& x : scaled.points) x = std::ldexp(x, exponent);
    EXPECT_EQ(flattened(scaled, std::ldexp(0x1p-10, exponent)).parameters, plain.parameters) << exponent;
  }
}

TEST(Flatten, takes_any_large_tolerance) {
  Spline tiny = bezier(2, {0, 0, 1e-300, 1e-300, 2e-300, 0});
  EXPECT_EQ(flattened(tiny, std::numeric_limits<double>::max()).parameters.size(), 2u);
}

TEST(Flatten, of_high_degrees_and_dimensions_keeps_the_tolerance) {
  for (const Index degree : {15u, 63u})
    for (const Index dimension : {1u, 7u}) {
      const Spline spline = samples::random_spline(degree, degree, dimension, true, true, 1);
      EXPECT_LE(worst_distance(spline, flattened(spline, 1e-3), 5), 1e-3) << degree << ' ' << dimension;
    }
}

TEST(Flatten, refuses_tolerances_that_are_no_lengths) {
  for (const double tolerance : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_EQ(refusal(samples::circle(), {tolerance}), ErrorCode::out_of_range) << tolerance;
}

TEST(Flatten, refuses_a_tolerance_below_rounding) {
  const auto polyline = flatten(samples::circle(), {1e-17}, Budget{});
  ASSERT_FALSE(polyline.ok());
  EXPECT_EQ(polyline.error().code, ErrorCode::out_of_range);
  EXPECT_EQ(polyline.error().where, (Path{std::string("tolerance")}));
}

TEST(Flatten, refuses_more_points_than_allowed_and_says_both_numbers) {
  const auto polyline = flatten(samples::circle(), {1e-8, 1000}, Budget{});
  ASSERT_FALSE(polyline.ok());
  EXPECT_EQ(polyline.error().code, ErrorCode::too_large);
  EXPECT_GT(polyline.error().predicted, 1000u);
  EXPECT_EQ(polyline.error().allowed, 1000u);
}

TEST(Flatten, gives_exactly_as_many_points_as_allowed) {
  const Count points = flattened(samples::circle(), 1e-4).parameters.size();
  EXPECT_TRUE(flatten(samples::circle(), {1e-4, points}, Budget{}).ok());
  EXPECT_EQ(refusal(samples::circle(), {1e-4, points - 1}), ErrorCode::too_large);
}

TEST(Flatten, refuses_more_bytes_than_the_budget_has) {
  Budget budget;
  budget.max_bytes = 4800;  // 200 corners of two coordinates and a parameter
  EXPECT_EQ(refusal(samples::circle(), {1e-8}, budget), ErrorCode::too_large);
}

TEST(Flatten, stops_when_nobody_waits) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_EQ(refusal(samples::circle(), {1e-3}, budget), ErrorCode::cancelled);
}

}  // namespace
}  // namespace subdivd

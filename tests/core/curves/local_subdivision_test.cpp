#include "core/curves/local_subdivision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/splines/bspline.h"
#include "tests/core/curves/sample_curves.h"

namespace subdivd::testing {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTensions[] = {0.0, 1e-3, 1.0 / 16, 0.1, 0.15, 0.19, 0.1927};
constexpr double kRatios[] = {0.01, 0.2, 0.25, 0.3, 1.0 / 3, 0.4, 0.49};

ControlCurves random_of(const CurveBasis& basis, CurveWrap wrap, Index more, Index width) {
  ControlCurves rule;
  rule.basis = basis;
  rule.wrap = wrap;
  return random_curve(rule, more, width);
}
ControlCurves four_point(CurveWrap wrap, double tension, Index more, Index width = 2) {
  return random_of(FourPoint{tension}, wrap, more, width);
}
ControlCurves corner_cutting(CurveWrap wrap, double ratio, Index more, Index width = 2) {
  return random_of(CornerCutting{ratio}, wrap, more, width);
}

// Both schemes, all wraps, few points and more.
std::vector<ControlCurves> all_curves() {
  std::vector<ControlCurves> all;
  for (const CurveWrap wrap : kAllWraps)
    for (const Index more : {0u, 1u, 5u}) {
      for (const double tension : kTensions) all.push_back(four_point(wrap, tension, more));
      for (const double ratio : kRatios) all.push_back(corner_cutting(wrap, ratio, more));
    }
  return all;
}

bool is_polygon(const ControlCurves& curves) {
  const FourPoint* kind = std::get_if<FourPoint>(&curves.basis);
  return kind != nullptr && kind->tension == 0;
}

bool has_derivative(const ControlCurves& curves) {
  const CornerCutting* cutting = std::get_if<CornerCutting>(&curves.basis);
  return cutting == nullptr || cutting->ratio == 0.25;
}

SubdividedCurve only(const ControlCurves& curves) { return *subdivided_curve(curves, 0, {}); }

// order + 1 rows, or NaNs where that fails.
std::vector<double> rows_at(const ControlCurves& curves, double t, Index order) {
  std::vector<double> rows((order + 1) * curves.width);
  if (!derivatives(only(curves), t, order, rows)) rows.assign(rows.size(), std::nan(""));
  return rows;
}
std::vector<double> point_at(const ControlCurves& curves, double t) { return rows_at(curves, t, 0); }

Error refused(const ControlCurves& curves, double t, Index order) {
  std::vector<double> rows((order + 1) * curves.width);
  const auto done = derivatives(only(curves), t, order, rows);
  return done ? Error{} : done.error();
}

double random_parameter(const ControlCurves& curves, shapes::Random& random) {
  const SubdividedCurve curve = only(curves);
  return curve.begin() + (curve.end() - curve.begin()) * random.unit();
}

// --- Beside what refining gives ---------------------------------------------------------------------------

// The points of a level that have limits.
struct Inner {
  Count begin, end;
};
Inner inner_points(const ControlCurves& curves, Count count) {
  if (curves.wrap != CurveWrap::nonperiodic) return {0, count};
  const Count outer = std::holds_alternative<FourPoint>(curves.basis) ? 2 : 1;
  return {outer, count - outer};
}

// Coordinates are up to 1. Refining rounds every level's points and so does the sum here.
TEST(LocalSubdivision, points_are_the_limits_that_refining_gives) {
  for (const ControlCurves& curves : all_curves())
    for (const Index level : {0u, 1u, 3u, 6u}) {
      const auto fine = refined(curves, level);
      const Inner inner = inner_points(curves, fine.points.size() / 2);
      for (Count j = inner.begin; j < inner.end; ++j) {
        const double t = point_parameter(curves, curves.point_count(), level, j);
        ASSERT_TRUE(t >= only(curves).begin() && t <= only(curves).end()) << name_of_rule(curves);
        const std::vector<double> point = point_at(curves, t);
        for (Index k = 0; k < 2; ++k)
          ASSERT_NEAR(point[k], fine.limit_points[2 * j + k], 4 * kEpsilon)
              << name_of_rule(curves) << " level " << level << " t " << t;
      }
    }
}

// The tangents of a level are differences of its points, 2^l times as large as what they are rounded to.
TEST(LocalSubdivision, derivatives_are_the_tangents_that_refining_gives) {
  for (const ControlCurves& curves : all_curves()) {
    if (!has_derivative(curves)) continue;
    for (const Index level : {0u, 1u, 3u, 6u}) {
      const auto fine = refined(curves, level);
      const Inner inner = inner_points(curves, fine.points.size() / 2);
      for (Count j = inner.begin; j < inner.end; ++j) {
        const double t = point_parameter(curves, curves.point_count(), level, j);
        // Refining gives the mean of both sides.
        const bool end = curves.wrap == CurveWrap::pinned && (j == inner.begin || j + 1 == inner.end);
        const bool polygon = is_polygon(curves);
        if (polygon && t == std::floor(t) && !end) continue;
        const std::vector<double> rows = rows_at(curves, t, 1);
        for (Index k = 0; k < 2; ++k)
          ASSERT_NEAR(rows[2 + k], fine.tangents[2 * j + k], std::ldexp(24 * kEpsilon, int(level)))
              << name_of_rule(curves) << " level " << level << " t " << t;
      }
    }
  }
}

// --- Beside other ways ------------------------------------------------------------------------------------

// The polygon around t step by step in long double, from the front: `reach` points on either side of the cell
// are kept, and what t is of the cell is read off after every step. Open curves with t far from their ends.
struct Stepped {
  long double point, derivative;
};

Stepped stepped_four_point(std::vector<long double> c, double w, double t, int steps) {
  long double share = t - std::floor(t);
  const auto i = static_cast<std::size_t>(t);
  std::vector<long double> near(c.begin() + long(i) - 2, c.begin() + long(i) + 4);
  for (int step = 0; step < steps; ++step) {
    std::vector<long double> children;  // of places -3 to 5, from between c_{-2} and c_{-1}
    for (std::size_t k = 1; k + 2 < near.size(); ++k) {
      children.push_back(near[k]);
      children.push_back((0.5L + w) * (near[k] + near[k + 1]) - w * (near[k - 1] + near[k + 2]));
    }
    children.push_back(near[4]);  // c_{-1}, between, c_0, ..., c_2
    share *= 2;
    const bool right = share >= 1;
    if (right) share -= 1;
    near.assign(children.begin() + right, children.begin() + right + 6);
  }
  return {near[2] + share * (near[3] - near[2]), std::ldexp(near[3] - near[2], steps)};
}

Stepped stepped_corner_cutting(std::vector<long double> c, double r, double t, int steps) {
  const long double from_half = t + 0.5L;
  const auto m = static_cast<std::size_t>(from_half);
  long double share = from_half - static_cast<long double>(m);
  std::vector<long double> near(c.begin() + long(m) - 1, c.begin() + long(m) + 2);
  for (int step = 0; step < steps; ++step) {
    const long double a = near[0], b = near[1], d = near[2];
    const std::vector<long double> children{a + r * (b - a), b - r * (b - a), b + r * (d - b),
                                            d - r * (d - b)};
    share *= 2;
    const bool right = share >= 1;
    if (right) share -= 1;
    near.assign(children.begin() + right, children.begin() + right + 3);
  }
  const long double first = near[1] - near[0], second = near[2] - near[1];
  return {(near[0] + near[1]) / 2 + share * (first + second) / 2,
          std::ldexp(first + share * (second - first), steps)};
}

// After 60 steps t is the begin of a cell, but only a polygon's; so derivatives are compared where they have
// converged after 30, which leaves half of the 64 bits to differences.
TEST(LocalSubdivision, points_and_derivatives_are_where_long_doubles_arrive_step_by_step) {
  shapes::Random random(kCurveSeed);
  for (int round = 0; round < 200; ++round)
    for (const double parameter : {1e-3, 1.0 / 16, 0.1, 0.15, 0.25, 0.2, 0.3, 1.0 / 3}) {
      const bool cut = parameter > 0.19;
      const auto curves = cut ? corner_cutting(CurveWrap::nonperiodic, parameter, 5, 1)
                              : four_point(CurveWrap::nonperiodic, parameter, 5, 1);
      const double t = random_parameter(curves, random);
      const std::vector<long double> points(curves.points.begin(), curves.points.end());
      const Stepped there = cut ? stepped_corner_cutting(points, parameter, t, 60)
                                : stepped_four_point(points, parameter, t, 60);
      EXPECT_NEAR(point_at(curves, t)[0], double(there.point), 8 * kEpsilon) << parameter << " t " << t;
      const Stepped before = cut ? stepped_corner_cutting(points, parameter, t, 30)
                                 : stepped_four_point(points, parameter, t, 30);
      if (!has_derivative(curves) || parameter == 0.1 || parameter == 0.15) continue;
      EXPECT_NEAR(rows_at(curves, t, 1)[1], double(before.derivative), 2e-7) << parameter << " t " << t;
    }
}

TEST(LocalSubdivision, a_quarter_is_the_quadratic_spline_and_its_derivative) {
  shapes::Random random(kCurveSeed);
  for (const CurveWrap wrap : kAllWraps)
    for (const Index more : {0u, 1u, 6u}) {
      const auto curves = corner_cutting(wrap, 0.25, more, 3);
      const auto spline = spline_of(curves, 0, {});
      ASSERT_TRUE(spline.ok());
      EXPECT_EQ(spline->begin(), only(curves).begin());
      EXPECT_EQ(spline->end(), only(curves).end());
      std::vector<double> ts{spline->begin(), spline->end(), 1, 0.5 + kEpsilon};
      for (int k = 0; k < 200; ++k) ts.push_back(random_parameter(curves, random));
      for (const double t : ts) {
        std::vector<double> expected(6);
        ASSERT_TRUE(derivatives(*spline, t, 1, expected).ok());
        const auto rows = rows_at(curves, t, 1);
        for (Index k = 0; k < 6; ++k) ASSERT_NEAR(rows[k], expected[k], 8 * kEpsilon) << t;
      }
    }
}

TEST(LocalSubdivision, a_sixteenth_reproduces_cubics_and_their_derivatives_everywhere) {
  const auto cubic = [](double t) { return ((t / 8 - 1) * t + 0.5) * t - 3; };
  ControlCurves curves = four_point(CurveWrap::nonperiodic, 1.0 / 16, 4, 1);
  for (Count i = 0; i < curves.points.size(); ++i) curves.points[i] = cubic(double(i));
  shapes::Random random(kCurveSeed);
  for (int k = 0; k < 500; ++k) {
    const double t = random_parameter(curves, random);
    const auto rows = rows_at(curves, t, 1);
    EXPECT_NEAR(rows[0], cubic(t), 1e-13) << t;
    EXPECT_NEAR(rows[1], (3 * t / 8 - 2) * t + 0.5, 1e-13) << t;
  }
}

TEST(LocalSubdivision, tension_zero_is_the_polygon_with_one_sided_derivatives) {
  ControlCurves curves = four_point(CurveWrap::pinned, 0, 2, 1);
  curves.points = {0, 4, -4, 2};
  EXPECT_EQ(rows_at(curves, 0.25, 1), (std::vector<double>{1, 4}));
  EXPECT_EQ(rows_at(curves, 1, 1), (std::vector<double>{4, -8}));
  EXPECT_EQ(rows_at(curves, 3, 1), (std::vector<double>{2, 6}));
  curves.wrap = CurveWrap::periodic;
  EXPECT_EQ(rows_at(curves, 4, 1), (std::vector<double>{0, -2}));
  EXPECT_EQ(rows_at(curves, 0, 1), (std::vector<double>{0, 4}));
}

// The slope is that of the curve, not of any polygon.
TEST(LocalSubdivision, derivatives_are_the_limits_of_difference_quotients) {
  shapes::Random random(kCurveSeed);
  for (const CurveWrap wrap : kAllWraps)
    for (const double tension : {0.02, 1.0 / 16, 0.1}) {
      const auto curves = four_point(wrap, tension, 4, 1);
      for (int k = 0; k < 50; ++k) {
        const double t = 2.2 + 0.7 * random.unit();
        const double h = 1e-6;
        const double quotient = (point_at(curves, t + h)[0] - point_at(curves, t - h)[0]) / (2 * h);
        EXPECT_NEAR(rows_at(curves, t, 1)[1], quotient, tension > 0.0625 ? 5e-2 : 1e-3)
            << tension << " " << t;
      }
    }
}

// --- Properties -------------------------------------------------------------------------------------------

TEST(LocalSubdivision, control_points_of_four_point_are_met_to_the_bit) {
  for (const CurveWrap wrap : kAllWraps)
    for (const double tension : kTensions) {
      const auto curves = four_point(wrap, tension, 5);
      const Count outer = wrap == CurveWrap::nonperiodic ? 2 : 0;
      for (Count i = outer; i < curves.point_count() - outer; ++i)
        EXPECT_EQ(point_at(curves, double(i)), std::vector<double>(curves.points.begin() + long(2 * i),
                                                                   curves.points.begin() + long(2 * i) + 2));
    }
}

TEST(LocalSubdivision, equal_points_stay_that_point_to_the_bit) {
  shapes::Random random(kCurveSeed);
  for (ControlCurves curves : all_curves()) {
    for (Count k = 0; k < curves.points.size(); ++k) curves.points[k] = k % 2 == 0 ? 0.1 : -1e200;
    for (int k = 0; k < 10; ++k) {
      const auto rows = rows_at(curves, random_parameter(curves, random), has_derivative(curves) ? 1 : 0);
      EXPECT_EQ(rows[0], 0.1);
      EXPECT_EQ(rows[1], -1e200);
      for (std::size_t d = 2; d < rows.size(); ++d) EXPECT_EQ(rows[d], 0);
    }
  }
}

TEST(LocalSubdivision, a_straight_line_run_evenly_is_run_evenly) {
  shapes::Random random(kCurveSeed);
  for (ControlCurves curves : all_curves()) {
    if (curves.wrap == CurveWrap::periodic || !has_derivative(curves)) continue;
    const bool shifted =
        std::holds_alternative<CornerCutting>(curves.basis) && curves.wrap == CurveWrap::pinned;
    const Count n = curves.point_count();
    for (Count i = 0; i < n; ++i) {
      double at = double(i);
      if (shifted) at = i == 0 ? 0 : i + 1 == n ? double(n) - 2 : at - 0.5;
      curves.points[2 * i] = at;
      curves.points[2 * i + 1] = 1 - 3 * at;
    }
    for (int k = 0; k < 20; ++k) {
      const double t = random_parameter(curves, random);
      const auto rows = rows_at(curves, t, 1);
      const std::vector<double> expected{t, 1 - 3 * t, 1, -3};
      for (Index d = 0; d < 4; ++d) ASSERT_NEAR(rows[d], expected[d], 1e-13) << name_of_rule(curves);
    }
  }
}

TEST(LocalSubdivision, a_reversed_curve_is_run_backwards) {
  shapes::Random random(kCurveSeed);
  for (const ControlCurves& curves : all_curves()) {
    ControlCurves back = curves;
    const Count n = curves.point_count();
    for (Count i = 0; i < n; ++i)
      std::copy_n(curves.points.begin() + long(2 * i), 2, back.points.begin() + long(2 * (n - 1 - i)));
    // A periodic curve's points keep their numbers from the last to the first.
    const double last =
        curves.wrap == CurveWrap::periodic ? double(n) - 1 : only(curves).begin() + only(curves).end();
    for (int k = 0; k < 10; ++k) {
      const double t = std::round(random_parameter(curves, random) * 0x1p40) / 0x1p40;
      const Index order = has_derivative(curves) && !is_polygon(curves) ? 1 : 0;
      const auto there = rows_at(curves, t, order), here = rows_at(back, last - t, order);
      for (Index d = 0; d < there.size(); ++d)
        ASSERT_NEAR(d < 2 ? there[d] : -there[d], here[d], 1e-13) << name_of_rule(curves) << " t " << t;
    }
  }
}

// Periodic curves go round: any number of turns away is the same point.
TEST(LocalSubdivision, periodic_curves_repeat) {
  for (const ControlCurves& curves : all_curves()) {
    if (curves.wrap != CurveWrap::periodic) continue;
    const auto n = double(curves.point_count());
    for (const double t : {0.0, 0.375, 1.25, 2.5}) {
      EXPECT_EQ(point_at(curves, t), point_at(curves, t + 3 * n));
      EXPECT_EQ(point_at(curves, t), point_at(curves, t - 5 * n));
    }
    const SubdividedCurve curve = only(curves);
    for (Index k = 0; k < 2; ++k)
      EXPECT_NEAR(point_at(curves, curve.begin())[k], point_at(curves, curve.end())[k], 2 * kEpsilon);
  }
}

TEST(LocalSubdivision, coordinates_do_not_know_each_other) {
  const auto wide = four_point(CurveWrap::pinned, 0.11, 4, 5);
  const auto rows = rows_at(wide, 2.7, 1);
  for (Index k = 0; k < 5; ++k) {
    ControlCurves thin = wide;
    thin.width = 1;
    thin.points.clear();
    for (Count i = 0; i < wide.point_count(); ++i) thin.points.push_back(wide.points[5 * i + k]);
    EXPECT_EQ(rows_at(thin, 2.7, 1), (std::vector<double>{rows[k], rows[5 + k]}));
  }
}

TEST(LocalSubdivision, curves_of_one_body_are_told_apart) {
  auto both = four_point(CurveWrap::periodic, 1.0 / 16, 6);
  both.vertex_counts = {4, 5};
  const auto places = curve_places(both);
  auto second = both;
  second.vertex_counts.clear();
  second.points.erase(second.points.begin(), second.points.begin() + 8);
  std::vector<double> point(2);
  ASSERT_TRUE(derivatives(*subdivided_curve(both, 1, places[1]), 1.3, 0, point).ok());
  EXPECT_EQ(point, point_at(second, 1.3));
}

// --- Ends of what numbers hold ----------------------------------------------------------------------------

TEST(LocalSubdivision, the_smallest_and_the_nearest_parameters_are_exact) {
  for (const ControlCurves& curves : all_curves()) {
    const SubdividedCurve curve = only(curves);
    for (const double t : {5e-324, 1e-300, 0x1p-60, 0.5 + kEpsilon / 2, std::nextafter(0.5, 0)}) {
      if (t < curve.begin()) continue;
      // A cutting ratio of nearly 1/2 crawls: 0.98^53 of an edge is left where 2^-53 of the parameter pass.
      const CornerCutting* cutting = std::get_if<CornerCutting>(&curves.basis);
      const bool crawls = cutting != nullptr && std::max(2 * cutting->ratio, 1 - 2 * cutting->ratio) > 0.61;
      const double near = t < 0.4 ? 0 : 0.5;
      for (Index k = 0; k < 2; ++k)
        EXPECT_NEAR(point_at(curves, t)[k], point_at(curves, near)[k], crawls ? 0.8 : 1e-11)
            << name_of_rule(curves) << " t " << t;
    }
    const double before = std::nextafter(curve.end(), 0);
    for (const double x : rows_at(curves, before, has_derivative(curves) ? 1 : 0))
      EXPECT_TRUE(std::isfinite(x));
  }
}

// 5e-324 takes 1074 halvings; every one of them halves an interval that begins at the same point.
TEST(LocalSubdivision, derivatives_stay_where_halving_goes_on_for_ever) {
  for (const double tension : {1e-3, 1.0 / 16, 0.15}) {
    const auto curves = four_point(CurveWrap::pinned, tension, 5);
    const auto at = rows_at(curves, 0, 1), beside = rows_at(curves, 5e-324, 1);
    for (Index k = 0; k < 4; ++k) EXPECT_NEAR(beside[k], at[k], 1e-12);
  }
}

TEST(LocalSubdivision, scaling_by_a_power_of_two_scales_the_answer) {
  for (const ControlCurves& curves : all_curves())
    for (const int exponent : {-900, 900}) {
      ControlCurves scaled = curves;
      for (double& x : scaled.points) x = std::ldexp(x, exponent);
      const Index order = has_derivative(curves) ? 1 : 0;
      const double t = 0.7 * only(curves).begin() + 0.3 * only(curves).end();
      auto expected = rows_at(curves, t, order);
      for (double& x : expected) x = std::ldexp(x, exponent);
      EXPECT_EQ(rows_at(scaled, t, order), expected);
    }
}

TEST(LocalSubdivision, differences_that_outgrow_a_double_do_no_harm_and_results_that_do_are_refused) {
  auto curves = corner_cutting(CurveWrap::nonperiodic, 0.25, 0, 1);
  curves.points = {1.5e308, -1.5e308, 1.5e308};
  EXPECT_NEAR(point_at(curves, 1)[0] / 1e308, 0.75 * -1.5 + 0.25 * 1.5, 1e-15);
  EXPECT_EQ(refused(curves, 0.5, 1).code, ErrorCode::out_of_range);
  auto interpolating = four_point(CurveWrap::periodic, 0.1, 1, 1);
  interpolating.points = {1.7e308, 1.7e308, -1.7e308, -1.7e308};
  EXPECT_EQ(point_at(interpolating, 1)[0], 1.7e308);
  EXPECT_EQ(refused(interpolating, 0.5, 0).code, ErrorCode::out_of_range);
}

TEST(LocalSubdivision, parameters_outside_the_domain_are_refused) {
  const auto curves = four_point(CurveWrap::nonperiodic, 1.0 / 16, 3);
  for (const double t : {1.999, 6.001, -1.0, 1e300}) {
    const Error error = refused(curves, t, 0);
    EXPECT_EQ(error.code, ErrorCode::out_of_range) << t;
    EXPECT_EQ(error.where, (Path{"t"}));
  }
  for (const double t : {std::nan(""), kInfinity, -kInfinity}) {
    EXPECT_EQ(refused(curves, t, 0).code, ErrorCode::not_finite);
    EXPECT_EQ(refused(four_point(CurveWrap::periodic, 0.1, 3), t, 0).code, ErrorCode::not_finite);
  }
}

TEST(LocalSubdivision, derivatives_that_do_not_exist_are_refused) {
  const auto smooth = four_point(CurveWrap::pinned, 1.0 / 16, 3);
  EXPECT_EQ(refused(smooth, 1, 2).code, ErrorCode::unsupported);
  EXPECT_EQ(refused(smooth, 1, 2).where, (Path{"order"}));
  EXPECT_EQ(refused(corner_cutting(CurveWrap::pinned, 0.25, 3), 1, 2).code, ErrorCode::unsupported);
  for (const double ratio : {0.2, 0.3}) {
    const Error error = refused(corner_cutting(CurveWrap::pinned, ratio, 3), 1, 1);
    EXPECT_EQ(error.code, ErrorCode::unsupported);
    EXPECT_NE(error.message.find("1/4"), std::string::npos);
  }
}

TEST(LocalSubdivision, curves_that_are_splines_are_refused) {
  for (const CurveBasis& basis : std::vector<CurveBasis>{UniformBSpline{}, Bezier{}, Nurbs{}}) {
    ControlCurves curves = random_curve(CurveWrap::pinned, 7);
    curves.basis = basis;
    const auto made = subdivided_curve(curves, 0, {});
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().code, ErrorCode::unsupported);
  }
}

}  // namespace
}  // namespace subdivd::testing

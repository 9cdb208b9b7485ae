#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/curves/piecewise.h"
#include "core/curves/subdivision.h"
#include "core/splines/bspline.h"
#include "tests/core/curves/knot_reference.h"
#include "tests/core/curves/sample_curves.h"

namespace subdivd::testing {
namespace {

struct Sample {
  std::vector<double> point, derivative;
};

Sample at(const ControlCurves& curves, double t, Index curve = 0) {
  const Spline spline = *spline_of(curves, curve, curve_places(curves)[curve]);
  std::vector<double> rows(2 * std::size_t{curves.width});
  EXPECT_TRUE(derivatives(spline, t, 1, rows).ok()) << t;
  const auto middle = rows.begin() + curves.width;
  return {{rows.begin(), middle}, {middle, rows.end()}};
}

ErrorCode refusal(const ControlCurves& curves, double t) {
  std::vector<double> point(curves.width);
  const auto done = evaluate(*spline_of(curves, 0, {}), t, point);
  return done ? ErrorCode::internal : done.error().code;
}

double domain_begin(const ControlCurves& curves) { return curves.wrap == CurveWrap::nonperiodic ? 1 : 0; }
double domain_end(const ControlCurves& curves) {
  const auto n = static_cast<double>(curves.point_count());
  return curves.wrap == CurveWrap::periodic ? n : curves.wrap == CurveWrap::pinned ? n - 1 : n - 2;
}

TEST(Evaluate, agrees_with_the_sum_over_all_basis_functions) {
  for (const CurveWrap wrap : kAllWraps)
    for (Index points = fewest_points(wrap); points < 9; ++points) {
      const auto curves = random_curve(wrap, points);
      const double begin = domain_begin(curves), end = domain_end(curves);
      for (int step = 0; step < 211; ++step) {
        const double t = begin + (end - begin) * step / 211;
        const auto expected = all_basis_point(curves, t);
        const auto found = at(curves, t).point;
        for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(found[k], expected[k], 1e-12) << t;
      }
    }
}

TEST(Evaluate, derivative_agrees_with_a_central_difference) {
  for (const CurveWrap wrap : kAllWraps) {
    const auto curves = random_curve(wrap, 6);
    constexpr double kStep = 1e-5;
    for (double t = domain_begin(curves) + 0.01; t < domain_end(curves) - 0.01; t += 0.0719) {
      const auto before = at(curves, t - kStep).point, after = at(curves, t + kStep).point;
      const auto slope = at(curves, t).derivative;
      // The difference errs by kStep^2 and by rounding, 1e-16 / kStep.
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_NEAR(slope[k], (after[k] - before[k]) / (2 * kStep), 1e-9) << t;
    }
  }
}

TEST(Evaluate, whole_parameters_give_the_limit_and_the_tangent_of_the_control_points) {
  for (const CurveWrap wrap : kAllWraps)
    for (Index points = fewest_points(wrap); points < 9; ++points) {
      const auto curves = random_curve(wrap, points);
      const auto mask = refined(curves, 0);
      const auto first = static_cast<Index>(domain_begin(curves)), last = points - 1 - first;
      for (Index i = first; i <= last; ++i) {
        const auto sample = at(curves, i);
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_NEAR(sample.point[k], mask.limit_points[i * 3 + k], 1e-15);
          EXPECT_NEAR(sample.derivative[k], mask.tangents[i * 3 + k], 1e-15);
        }
      }
    }
}

TEST(Evaluate, pinned_curves_begin_and_end_exactly_at_their_end_points) {
  for (Index points = 2; points < 7; ++points) {
    const auto curves = random_curve(CurveWrap::pinned, points);
    const auto begin = at(curves, 0).point, end = at(curves, points - 1).point;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(begin[k], curves.points[k]);
      EXPECT_EQ(end[k], curves.points[(points - 1) * 3 + k]);
    }
  }
}

TEST(Evaluate, periodic_curves_repeat) {
  const auto curves = random_curve(CurveWrap::periodic, 5);
  const auto once = at(curves, 1.25).point;
  EXPECT_EQ(at(curves, 1.25 + 5).point, once);
  EXPECT_EQ(at(curves, 1.25 - 5000).point, once);
}

TEST(Evaluate, a_hair_before_a_periodic_curves_start_is_its_start) {
  const auto curves = random_curve(CurveWrap::periodic, 5);
  const auto start = at(curves, 0).point, hair = at(curves, -1e-300).point;
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(hair[k], start[k], 1e-15);
}

TEST(Evaluate, finds_the_second_of_two_curves) {
  auto both = random_curve(CurveWrap::pinned, 9);
  auto second = both;
  both.vertex_counts = {4, 5};
  second.points.erase(second.points.begin(), second.points.begin() + 12);
  EXPECT_EQ(at(both, 1.7, 1).point, at(second, 1.7).point);
}

// Only the (at most four) points around t may count: the others may be anything.
TEST(Evaluate, far_points_do_not_matter) {
  auto curves = random_curve(CurveWrap::pinned, 10);
  const auto before = at(curves, 4.5);
  for (const std::size_t far : {0u, 1u, 2u, 7u, 8u, 9u}) curves.points[far * 3] += 1e6;
  const auto after = at(curves, 4.5);
  EXPECT_EQ(after.point, before.point);
  EXPECT_EQ(after.derivative, before.derivative);
}

TEST(Evaluate, refuses_parameters_outside_the_domain) {
  const auto pinned = random_curve(CurveWrap::pinned, 5);
  EXPECT_EQ(refusal(pinned, -1e-9), ErrorCode::out_of_range);
  EXPECT_EQ(refusal(pinned, 4.000001), ErrorCode::out_of_range);
  const auto nonperiodic = random_curve(CurveWrap::nonperiodic, 5);
  EXPECT_EQ(refusal(nonperiodic, 0.999), ErrorCode::out_of_range);
  EXPECT_EQ(refusal(nonperiodic, 3.001), ErrorCode::out_of_range);
}

TEST(Evaluate, refuses_parameters_that_are_not_finite) {
  for (const CurveWrap wrap : kAllWraps)
    for (const double t : {std::nan(""), std::numeric_limits<double>::infinity()})
      EXPECT_EQ(refusal(random_curve(wrap, 5), t), ErrorCode::not_finite);
}

}  // namespace
}  // namespace subdivd::testing

#include "core/curves/convergence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/curves/knot_reference.h"
#include "tests/core/curves/sample_curves.h"

namespace subdivd::testing {
namespace {

ControlCurves rule_of(Index degree, CurveWrap wrap) {
  ControlCurves rule;
  rule.basis = UniformBSpline{degree};
  rule.wrap = wrap;
  return rule;
}

Convergence measured(const ControlCurves& curves, Index levels) {
  auto result = measure_convergence(curves, 0, levels, Budget{});
  EXPECT_TRUE(result.ok()) << name_of_rule(curves);
  return result ? std::move(*result) : Convergence{};
}

// Second differences are 2 everywhere: B-splines of t^2 are t^2 + (p+1)/12, the polygon is at most so far.
TEST(Convergence, a_parabola_keeps_the_distance_of_the_basis_functions_variance) {
  for (Index degree = 2; degree <= kMaxCurveDegree; ++degree) {
    auto curves = rule_of(degree, CurveWrap::nonperiodic);
    curves.width = 1;
    for (int i = 0; i < int(degree) + 3; ++i) curves.points.push_back(i * i);
    const auto found = measured(curves, 5);
    for (Index level = 0; level <= 5; ++level) {
      const double expected = (degree + 1) / 12.0 * std::ldexp(1.0, -2 * int(level));
      EXPECT_NEAR(found.distances[level] / expected, 1, 2e-9) << degree << " level " << level;
    }
    for (const double ratio : found.ratios) EXPECT_NEAR(ratio, 0.25, 1e-9);
  }
}

// By points of the curve as the sum of all basis functions: never farther than measured, and almost as far.
TEST(Convergence, no_sample_is_farther_and_some_are_as_far) {
  for (const CurveWrap wrap : kAllWraps)
    for (Index degree = 2; degree <= 7; ++degree)
      for (const Index more : {0u, 1u, 4u}) {
        const auto curves = random_curve(rule_of(degree, wrap), more, 2);
        const double distance = measured(curves, 0).distances[0];
        const Count n = curves.point_count();
        const double low = wrap == CurveWrap::nonperiodic ? (degree - 1) / 2.0 : 0;
        double worst = 0;
        for (Count i = 0; i + 1 < n; ++i) {
          const double a = point_parameter(curves, n, 0, i), b = point_parameter(curves, n, 0, i + 1);
          for (int s = 0; s <= 60; ++s) {
            const double u = s / 60.0, t = a + (b - a) * u;
            if (t < low || t > double(n) - 1 - low) continue;
            const auto point = all_basis_point(curves, t);
            double square = 0;
            for (Index k = 0; k < 2; ++k) {
              const double polygon = curves.points[i * 2 + k] * (1 - u) + curves.points[(i + 1) * 2 + k] * u;
              square += (point[k] - polygon) * (point[k] - polygon);
            }
            worst = std::max(worst, std::sqrt(square));
          }
        }
        ASSERT_LE(worst, distance * (1 + 2e-9) + 1e-15) << name_of_rule(curves);
        if (wrap != CurveWrap::periodic) {  // its closing edge is not sampled
          ASSERT_GE(worst, distance * 0.995) << name_of_rule(curves);
        }
      }
}

TEST(Convergence, a_refined_curve_is_as_far_at_level_0_as_the_control_curve_later) {
  for (const CurveWrap wrap : kAllWraps)
    for (Index degree = 2; degree <= kMaxCurveDegree; ++degree) {
      const auto curves = random_curve(rule_of(degree, wrap), 1 + degree % 5, 3);
      const auto found = measured(curves, 3);
      for (Index level = 1; level <= 3; ++level) {
        const auto later = measured(as_control(refined(curves, level)), 0);
        ASSERT_NEAR(later.distances[0] / found.distances[level], 1, 1e-8) << name_of_rule(curves) << level;
      }
    }
}

TEST(Convergence, ratios_come_to_a_quarter) {
  for (const CurveWrap wrap : kAllWraps)
    for (const Index degree : {2u, 3u, 4u, 5u, 9u}) {
      const auto found = measured(random_curve(rule_of(degree, wrap), 3, 3), 10);
      ASSERT_EQ(found.ratios.size(), 10u);
      EXPECT_NEAR(found.ratios.back(), 0.25, 3e-3) << degree << " wrap " << int(wrap);
    }
}

// 4^-24 is below the rounding of coordinates: a difference of points would see nothing.
TEST(Convergence, the_last_levels_still_have_all_their_digits) {
  auto curves = rule_of(3, CurveWrap::nonperiodic);
  curves.width = 1;
  curves.points = {0, 1, 4, 9};
  const auto found = measured(curves, 20);
  EXPECT_NEAR(found.distances[20] / std::ldexp(1.0 / 3, -40), 1, 2e-9);
}

TEST(Convergence, polygons_and_lines_are_their_own_limits) {
  EXPECT_EQ(measured(random_curve(rule_of(1, CurveWrap::pinned), 5), 3).distances,
            (std::vector<double>{0, 0, 0, 0}));
  for (Index degree = 2; degree <= kMaxCurveDegree; ++degree) {
    auto line = random_curve(rule_of(degree, CurveWrap::pinned), 4, 2);
    for (Count i = 0; i < line.point_count(); ++i)
      for (Index k = 0; k < 2; ++k)
        line.points[i * 2 + k] = (k + 1.0) * point_parameter(line, line.point_count(), 0, i);
    const auto found = measured(line, 2);
    EXPECT_EQ(found.distances, (std::vector<double>{0, 0, 0})) << degree;
    EXPECT_EQ(found.ratios, (std::vector<double>{0, 0}));
  }
}

TEST(Convergence, scale_changes_distances_alone) {
  for (const int exponent : {-900, -500, 500, 1020}) {
    const auto curves = random_curve(rule_of(4, CurveWrap::pinned), 5, 2);
    auto scaled = curves;
    for (double& value : scaled.points) value = std::ldexp(value, exponent);
    const auto plain = measured(curves, 2), found = measured(scaled, 2);
    for (std::size_t l = 0; l < 3; ++l)
      EXPECT_EQ(found.distances[l], std::ldexp(plain.distances[l], exponent)) << exponent;
  }
}

TEST(Convergence, the_curve_asked_for_is_measured) {
  const auto one = random_curve(rule_of(3, CurveWrap::pinned), 2), two = random_curve(one, 6);
  auto both = one;
  both.points.insert(both.points.end(), two.points.begin(), two.points.end());
  both.vertex_counts = {static_cast<Index>(one.point_count()), static_cast<Index>(two.point_count())};
  const auto found = measure_convergence(both, 1, 1, Budget{});
  ASSERT_TRUE(found.ok());
  EXPECT_EQ(found->distances, measured(two, 1).distances);
}

TEST(Convergence, refuses_what_it_cannot_measure) {
  const auto code = [](const ControlCurves& curves, Index curve, Index levels, const Budget& budget) {
    const auto result = measure_convergence(curves, curve, levels, budget);
    return result ? ErrorCode::internal : result.error().code;
  };
  auto curves = random_curve(rule_of(3, CurveWrap::pinned), 5);
  EXPECT_EQ(code(curves, 1, 0, Budget{}), ErrorCode::out_of_range);
  EXPECT_EQ(code(curves, 0, kMaxCurveLevel + 1, Budget{}), ErrorCode::out_of_range);
  Budget small, dead;
  small.max_bytes = 1 << 20;
  EXPECT_EQ(code(curves, 0, kMaxCurveLevel, small), ErrorCode::too_large);
  const std::atomic<bool> gone = true;
  dead.cancelled = &gone;
  EXPECT_EQ(code(curves, 0, 3, dead), ErrorCode::cancelled);
  curves.basis = FourPoint{};
  EXPECT_EQ(code(curves, 0, 0, Budget{}), ErrorCode::unsupported);
}

}  // namespace
}  // namespace subdivd::testing

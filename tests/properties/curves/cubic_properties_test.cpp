// What must hold for every uniform cubic curve.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/curves/bspline.h"
#include "core/curves/piecewise.h"
#include "core/curves/subdivision.h"
#include "tests/core/curves/sample_curves.h"

namespace subdivd::testing {
namespace {

std::vector<double> limits_of(const ControlCurves& curves, Index level) {
  return refined(curves, level).limit_points;
}

// The limit of a control point is a point of every finer curve too; where it is found in the refined
// numbering.
Index place_after(CurveWrap wrap, Index i, Index level) {
  const Index n = 1u << level;
  return wrap == CurveWrap::nonperiodic ? (i - 1) * n + 1 : i * n;
}

TEST(CubicProperties, refinement_keeps_the_limit) {
  for (const CurveWrap wrap : kAllWraps)
    for (const Index points : {4u, 5u, 9u}) {
      const auto curves = random_curve(wrap, points);
      const auto coarse = limits_of(curves, 0);
      const Index skip = wrap == CurveWrap::nonperiodic ? 1 : 0;
      for (Index level = 1; level <= 6; ++level) {
        const auto fine = limits_of(curves, level);
        for (Index i = skip; i < points - skip; ++i)
          for (Index k = 0; k < 3; ++k)
            ASSERT_NEAR(fine[place_after(wrap, i, level) * 3 + k], coarse[i * 3 + k], 1e-15);
      }
    }
}

TEST(CubicProperties, refinement_keeps_the_tangent) {
  for (const CurveWrap wrap : kAllWraps) {
    const auto curves = random_curve(wrap, 7);
    const auto coarse = refined(curves, 0).tangents;
    for (Index level = 1; level <= 4; ++level) {
      const auto fine = refined(curves, level).tangents;
      for (Index i = 1; i < 6; ++i)
        for (Index k = 0; k < 3; ++k)
          // 2^level times a difference: the rounding grows with it.
          ASSERT_NEAR(fine[place_after(wrap, i, level) * 3 + k], coarse[i * 3 + k], 1e-15 * (4u << level));
    }
  }
}

TEST(CubicProperties, limits_lie_on_the_evaluated_curve) {
  for (const CurveWrap wrap : kAllWraps) {
    const auto curves = random_curve(wrap, 6);
    const Spline spline = *spline_of(curves, 0, {});
    const auto fine = refined(curves, 3);
    const Count first = wrap == CurveWrap::nonperiodic ? 1 : 0;
    const Count count = fine.points.size() / 3;
    for (Count i = first; i < count - first; ++i) {
      const double t = static_cast<double>(i - first) / 8 + static_cast<double>(first);
      std::array<double, 6> rows{};  // the point, then the derivative
      ASSERT_TRUE(derivatives(spline, t, 1, rows).ok());
      for (Index k = 0; k < 3; ++k) {
        ASSERT_NEAR(fine.limit_points[i * 3 + k], rows[k], 1e-15 * 4);
        ASSERT_NEAR(fine.tangents[i * 3 + k], rows[3 + k], 1e-14);
      }
    }
  }
}

TEST(CubicProperties, two_single_steps_are_one_double_step) {
  for (const CurveWrap wrap : kAllWraps) {
    const auto curves = random_curve(wrap, 7);
    EXPECT_EQ(refined(as_control(refined(curves, 2)), 3).points, refined(curves, 5).points);
  }
}

TEST(CubicProperties, affine_maps_commute_with_refinement) {
  const auto map = [](const std::vector<double>& p) {
    std::vector<double> q;
    for (std::size_t i = 0; i < p.size(); i += 3) {
      q.push_back(2 * p[i] - 0.5 * p[i + 1] + 3);
      q.push_back(0.25 * p[i] + p[i + 1] - p[i + 2] - 1);
      q.push_back(-p[i] + 1.5 * p[i + 2] + 7);
    }
    return q;
  };
  for (const CurveWrap wrap : kAllWraps) {
    const auto curves = random_curve(wrap, 6);
    auto mapped = curves;
    mapped.points = map(curves.points);
    const auto expected = map(refined(curves, 4).limit_points), found = limits_of(mapped, 4);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) ASSERT_NEAR(found[k], expected[k], 1e-14);
  }
}

// To the bit: the masks add what lies before and after symmetrically.
TEST(CubicProperties, reversing_a_curve_reverses_its_refinement) {
  for (const CurveWrap wrap : {CurveWrap::pinned, CurveWrap::nonperiodic}) {
    auto curves = random_curve(wrap, 8, 1);
    auto forward = refined(curves, 4);
    std::reverse(curves.points.begin(), curves.points.end());
    auto backward = refined(curves, 4);
    std::reverse(backward.points.begin(), backward.points.end());
    std::reverse(backward.limit_points.begin(), backward.limit_points.end());
    EXPECT_EQ(forward.points, backward.points);
    EXPECT_EQ(forward.limit_points, backward.limit_points);
  }
}

TEST(CubicProperties, rotating_a_periodic_curve_rotates_its_refinement) {
  auto curves = random_curve(CurveWrap::periodic, 6, 1);
  auto expected = refined(curves, 3).points;
  std::rotate(curves.points.begin(), curves.points.begin() + 2, curves.points.end());
  std::rotate(expected.begin(), expected.begin() + 16, expected.end());
  EXPECT_EQ(refined(curves, 3).points, expected);
}

TEST(CubicProperties, evenly_spaced_points_on_a_line_stay_evenly_spaced) {
  for (const CurveWrap wrap : {CurveWrap::pinned, CurveWrap::nonperiodic}) {
    ControlCurves curves;
    curves.wrap = wrap;
    curves.width = 1;
    curves.points = {0, 16, 32, 48, 64};
    const auto fine = refined(curves, 4);
    for (std::size_t i = 1; i < fine.points.size(); ++i)
      EXPECT_EQ(fine.points[i] - fine.points[i - 1], 1) << i;
  }
}

TEST(CubicProperties, a_straight_line_stays_straight) {
  auto curves = random_curve(CurveWrap::pinned, 6);
  for (std::size_t i = 0; i < curves.points.size(); i += 3) {
    curves.points[i + 1] = 3 * curves.points[i];
    curves.points[i + 2] = -2 * curves.points[i];
  }
  const auto fine = refined(curves, 5);
  for (std::size_t i = 0; i < fine.points.size(); i += 3) {
    EXPECT_NEAR(fine.limit_points[i + 1], 3 * fine.limit_points[i], 1e-15 * 4);
    EXPECT_NEAR(fine.limit_points[i + 2], -2 * fine.limit_points[i], 1e-15 * 4);
  }
}

// Each step brings the polygon four times closer to its limit.
TEST(CubicProperties, the_distance_to_the_limit_shrinks_to_a_quarter_per_step) {
  for (const CurveWrap wrap : {CurveWrap::pinned, CurveWrap::periodic}) {
    const auto curves = random_curve(wrap, 7, 1);
    const auto distance = [&](Index level) {
      const auto fine = refined(curves, level);
      double worst = 0;
      for (std::size_t k = 0; k < fine.points.size(); ++k)
        worst = std::max(worst, std::abs(fine.points[k] - fine.limit_points[k]));
      return worst;
    };
    for (Index level = 5; level < 10; ++level)
      EXPECT_NEAR(distance(level + 1) / distance(level), 0.25, 1e-3) << level;
  }
}

// The step around one point takes (c_{-2} … c_2) to five points around its image; taken from refine() by
// refining unit vectors. Eigenvectors: (1,1,1,1,1), (-2,-1,0,1,2), (11,2,-1,2,11), (0,0,0,0,1) and its
// mirror.
std::array<double, 5> local_step(const std::array<double, 5>& ring) {
  ControlCurves curves;
  curves.wrap = CurveWrap::nonperiodic;
  curves.width = 1;
  curves.points.assign(ring.begin(), ring.end());
  const auto fine = refined(curves, 1).points;  // 7 points, the image of c_0 in the middle
  return {fine[1], fine[2], fine[3], fine[4], fine[5]};
}

TEST(CubicProperties, the_local_step_has_eigenvalues_1_half_quarter) {
  const std::array<std::array<double, 5>, 3> vectors = {
      {{1, 1, 1, 1, 1}, {-2, -1, 0, 1, 2}, {11, 2, -1, 2, 11}}};
  const std::array<double, 3> values = {1, 0.5, 0.25};
  for (std::size_t e = 0; e < 3; ++e) {
    const auto image = local_step(vectors[e]);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(image[k], values[e] * vectors[e][k]) << e;
  }
}

TEST(CubicProperties, the_local_step_has_eigenvalue_an_eighth_twice) {
  for (const auto& vector : {std::array<double, 5>{1, 0, 0, 0, 0}, std::array<double, 5>{0, 0, 0, 0, 1}}) {
    const auto image = local_step(vector);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(image[k], 0.125 * vector[k]);
  }
}

}  // namespace
}  // namespace subdivd::testing

#include "core/curves/four_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/core/curves/sample_curves.h"

namespace subdivd::testing {
namespace {

ControlCurves four_point(CurveWrap wrap, double tension, std::vector<double> points) {
  ControlCurves curves;
  curves.basis = FourPoint{tension};
  curves.wrap = wrap;
  curves.width = 1;
  curves.points = std::move(points);
  return curves;
}

TEST(FourPoint, the_bound_is_the_root_of_its_cubic) {
  EXPECT_TRUE(is_four_point_tension(0));
  EXPECT_TRUE(is_four_point_tension(0.192729));
  EXPECT_FALSE(is_four_point_tension(0.19273));
  EXPECT_FALSE(is_four_point_tension(-1e-300));
  EXPECT_FALSE(is_four_point_tension(std::nan("")));
  EXPECT_FALSE(is_four_point_tension(std::numeric_limits<double>::infinity()));
}

TEST(FourPoint, one_step_is_the_mask_by_hand) {
  const auto open = refined(four_point(CurveWrap::nonperiodic, 1.0 / 16, {0, 16, 0, 0, 32, 0}), 1);
  // (9 * (16 + 0) - (0 + 0)) / 16, (9 * 0 - (16 + 32)) / 16, (9 * 32 - 0) / 16
  EXPECT_EQ(open.points, (std::vector<double>{16, 9, 0, -3, 0, 18, 32}));
  const auto pinned = refined(four_point(CurveWrap::pinned, 1.0 / 16, {0, 16, 0}), 1);
  EXPECT_EQ(pinned.points, (std::vector<double>{0, 10, 16, 10, 0}));  // phantoms -16
}

TEST(FourPoint, control_points_stay_and_are_their_own_limits) {
  for (const CurveWrap wrap : {CurveWrap::pinned, CurveWrap::periodic}) {
    auto curves = random_curve(wrap, 7, 2);
    curves.basis = FourPoint{};
    const auto fine = refined(curves, 4);
    EXPECT_EQ(fine.limit_points, fine.points);
    for (Count i = 0; i < 7; ++i)
      for (Index k = 0; k < 2; ++k) EXPECT_EQ(fine.points[(16 * i) * 2 + k], curves.points[i * 2 + k]);
  }
}

TEST(FourPoint, tension_zero_is_the_polygon) {
  const auto fine = refined(four_point(CurveWrap::pinned, 0, {0, 4, -4}), 2);
  EXPECT_EQ(fine.points, (std::vector<double>{0, 1, 2, 3, 4, 2, 0, -2, -4}));
}

TEST(FourPoint, a_sixteenth_reproduces_cubics_and_their_derivatives) {
  const auto cubic = [](double t) { return ((t - 2) * t + 0.5) * t - 3; };
  std::vector<double> points;
  for (int i = 0; i < 9; ++i) points.push_back(cubic(i));
  const auto curves = four_point(CurveWrap::nonperiodic, 1.0 / 16, points);
  const auto fine = refined(curves, 3);
  for (Count j = 2; j + 2 < fine.points.size(); ++j) {
    const double t = point_parameter(curves, 9, 3, j);
    EXPECT_NEAR(fine.points[j], cubic(t), 1e-11);
    EXPECT_NEAR(fine.tangents[j], (3 * t - 4) * t + 0.5, 1e-9);
  }
}

// Other tensions reproduce straight lines only, yet the tangent is still where difference quotients go.
TEST(FourPoint, tangents_are_the_limits_of_difference_quotients) {
  for (const double tension : {0.02, 1.0 / 16, 0.1}) {
    auto curves = random_curve(CurveWrap::periodic, 6, 1);
    curves.basis = FourPoint{tension};
    const auto tangents = refined(curves, 0).tangents;
    const Index level = 18;
    const auto fine = refined(curves, level).points;
    const Count n = fine.size();
    for (Count i = 0; i < 6; ++i) {
      const Count j = i << level;
      const double quotient = std::ldexp(fine[j + 1] - fine[(j + n - 1) % n], int(level) - 1);
      EXPECT_NEAR(quotient, tangents[i], 1e-3) << tension;
    }
  }
}

// A step maps the tangent's functional to half of itself: exactly its eigenvector.
TEST(FourPoint, the_tangent_is_the_left_eigenvector_for_one_half) {
  for (const double tension : {0.0, 1.0 / 16, 0.15, 0.1927}) {
    if (tension == 0) continue;  // the polygon has kinks; its tangents are means
    auto curves = random_curve(CurveWrap::periodic, 8, 1);
    curves.basis = FourPoint{tension};
    const auto coarse = refined(curves, 0).tangents, fine = refined(curves, 1).tangents;
    for (Count i = 0; i < 8; ++i) EXPECT_NEAR(fine[2 * i], coarse[i], 1e-13 / (1 - 4 * tension));
  }
}

TEST(FourPoint, six_points_are_the_fewest_that_grow) {
  const auto six = four_point(CurveWrap::nonperiodic, 1.0 / 16, std::vector<double>(6, 1.0));
  EXPECT_TRUE(six.check().ok());
  for (Index level = 0; level < 6; ++level)
    EXPECT_EQ(refined_point_count(six, 6, level), (Count{1} << level) + 5);
  const auto five = four_point(CurveWrap::nonperiodic, 1.0 / 16, std::vector<double>(5, 1.0));
  ASSERT_FALSE(five.check().ok());
  EXPECT_EQ(five.check().error().code, ErrorCode::too_few_points);
}

}  // namespace
}  // namespace subdivd::testing

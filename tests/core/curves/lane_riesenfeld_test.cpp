#include "core/curves/lane_riesenfeld.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

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

// (1 + z)^{p+1} / 2^p by multiplying: what Lane and Riesenfeld's p rounds of averaging amount to.
TEST(LaneRiesenfeld, the_mask_is_repeated_averaging_of_doubled_points) {
  for (Index degree = 1; degree <= kMaxCurveDegree; ++degree) {
    std::vector<double> mask{1, 1};
    for (Index round = 0; round < degree; ++round) {
      mask.push_back(0);
      for (std::size_t k = mask.size() - 1; k > 0; --k) mask[k] = (mask[k] + mask[k - 1]) / 2;
      mask[0] /= 2;
    }
    EXPECT_EQ(lane_riesenfeld_mask(degree), mask) << degree;
  }
}

TEST(LaneRiesenfeld, even_and_odd_weights_each_sum_to_one) {
  for (Index degree = 1; degree <= kMaxCurveDegree; ++degree) {
    double sums[2] = {0, 0};
    const auto mask = lane_riesenfeld_mask(degree);
    for (std::size_t k = 0; k < mask.size(); ++k) sums[k % 2] += mask[k];
    EXPECT_EQ(sums[0], 1) << degree;
    EXPECT_EQ(sums[1], 1) << degree;
  }
}

// Eulerian numbers over p!.   [OEIS A008292]
TEST(LaneRiesenfeld, odd_limit_masks_are_eulerian_numbers) {
  EXPECT_EQ(UniformBSpline{1}.limit_masks().values, (std::vector<double>{1}));
  EXPECT_EQ(UniformBSpline{3}.limit_masks().values, (std::vector<double>{4.0 / 6, 1.0 / 6}));
  EXPECT_EQ(UniformBSpline{5}.limit_masks().values, (std::vector<double>{66.0 / 120, 26.0 / 120, 1.0 / 120}));
  EXPECT_EQ(UniformBSpline{7}.limit_masks().values,
            (std::vector<double>{2416.0 / 5040, 1191.0 / 5040, 120.0 / 5040, 1.0 / 5040}));
}

TEST(LaneRiesenfeld, even_limit_masks_are_values_at_the_middle_of_spans) {
  EXPECT_EQ(UniformBSpline{2}.limit_masks().values, (std::vector<double>{6.0 / 8, 1.0 / 8}));
  EXPECT_EQ(UniformBSpline{4}.limit_masks().values,
            (std::vector<double>{230.0 / 384, 76.0 / 384, 1.0 / 384}));
}

// The limit mask is the left eigenvector of the step for 1: refining unit vectors of odd degrees shows it.
TEST(LaneRiesenfeld, odd_limit_masks_reproduce_themselves) {
  for (Index degree = 1; degree <= kMaxCurveDegree; degree += 2) {
    const auto values = UniformBSpline{degree}.limit_masks().values;
    const auto mask = lane_riesenfeld_mask(degree);
    const int h = static_cast<int>(degree + 1) / 2, reach = static_cast<int>(values.size()) - 1;
    const auto value = [&](int k) {
      return std::abs(k) > reach ? 0 : values[static_cast<std::size_t>(std::abs(k))];
    };
    for (int i = -reach - 1; i <= reach + 1; ++i) {
      double again = 0;
      for (int m = -reach; m <= reach; ++m)
        if (std::abs(m - 2 * i) <= h) again += value(m) * mask[static_cast<std::size_t>(m - 2 * i + h)];
      EXPECT_NEAR(again, value(i), 1e-16 * 2) << degree << " at " << i;
    }
  }
}

TEST(LaneRiesenfeld, limits_sum_to_one_and_slopes_reproduce_the_parameter) {
  for (Index degree = 1; degree <= kMaxCurveDegree; ++degree) {
    const LimitMasks masks = UniformBSpline{degree}.limit_masks();
    double sum = masks.values[0], slope = 0, end_slope = 0;
    for (std::size_t k = 1; k < masks.values.size(); ++k) sum += 2 * masks.values[k];
    for (std::size_t k = 1; k < masks.slopes.size(); ++k)
      slope += 2 * static_cast<double>(k) * masks.slopes[k];
    for (std::size_t k = 0; k < masks.end_slopes.size(); ++k)
      end_slope += (static_cast<double>(k) + (degree % 2 == 0 ? 0.5 : 1)) * masks.end_slopes[k];
    EXPECT_NEAR(sum, 1, 1e-15) << degree;
    EXPECT_NEAR(slope, 1, 1e-15) << degree;
    EXPECT_NEAR(end_slope, 1, 1e-15) << degree;
  }
}

TEST(LaneRiesenfeld, limits_and_tangents_lie_on_the_sum_of_all_basis_functions) {
  for (Index degree = 1; degree <= 8; ++degree)
    for (const CurveWrap wrap : kAllWraps)
      for (const Index more : {0u, 1u, 5u})
        for (Index level = 0; level <= 2; ++level) {
          const auto curves = random_curve(rule_of(degree, wrap), more, 2);
          const auto fine = refined(curves, level);
          const Count count = fine.points.size() / 2, outer = wrap == CurveWrap::nonperiodic ? degree / 2 : 0;
          for (Count j = outer; j + outer < count; ++j) {
            const double t = point_parameter(curves, curves.point_count(), level, j);
            const auto point = all_basis_point(curves, t), slope = all_basis_slope(curves, t);
            for (Index k = 0; k < 2; ++k) {
              ASSERT_NEAR(fine.limit_points[j * 2 + k], point[k], 1e-14)
                  << name_of_rule(curves) << " t " << t;
              if (degree > 1) {
                ASSERT_NEAR(fine.tangents[j * 2 + k], slope[k], 1e-13) << name_of_rule(curves) << " t " << t;
              }
            }
          }
        }
}

TEST(LaneRiesenfeld, the_highest_degree_lies_on_the_sum_of_all_basis_functions) {
  for (const CurveWrap wrap : kAllWraps)
    for (const Index degree : {14u, 15u}) {
      const auto curves = random_curve(rule_of(degree, wrap), 2, 1);
      const auto fine = refined(curves, 0);
      const Count count = fine.points.size(), outer = wrap == CurveWrap::nonperiodic ? degree / 2 : 0;
      for (Count j = outer; j + outer < count; ++j) {
        const double t = point_parameter(curves, curves.point_count(), 0, j);
        ASSERT_NEAR(fine.limit_points[j], all_basis_point(curves, t)[0], 1e-13) << degree << " t " << t;
        ASSERT_NEAR(fine.tangents[j], all_basis_slope(curves, t)[0], 1e-13) << degree << " t " << t;
      }
    }
}

TEST(LaneRiesenfeld, tangents_of_the_polygon_are_means_of_both_sides) {
  auto curves = rule_of(1, CurveWrap::nonperiodic);
  curves.width = 1;
  curves.points = {0, 1, 5};
  EXPECT_EQ(refined(curves, 0).tangents, (std::vector<double>{1, 2.5, 4}));
  EXPECT_EQ(refined(curves, 1).points, (std::vector<double>{0, 0.5, 1, 3, 5}));
}

// The point at t of the quadratic B-spline on the knots 0 0 0 1 2 ... m m m, by de Boor's algorithm.
double clamped_quadratic(const std::vector<double>& c, double t) {
  const double m = static_cast<double>(c.size()) - 2;
  const auto knot = [&](double i) { return std::clamp(i - 2, 0.0, m); };
  const double span = std::min(std::floor(t), m - 1) + 2;
  double d[3];
  for (int i = 0; i < 3; ++i) d[i] = c[static_cast<std::size_t>(span) - 2 + static_cast<std::size_t>(i)];
  for (int r = 1; r <= 2; ++r)
    for (int i = 2; i >= r; --i) {
      const double low = knot(span - 2 + i), high = knot(span + 1 + i - r);
      const double a = (t - low) / (high - low);
      d[i] = (1 - a) * d[i - 1] + a * d[i];
    }
  return d[2];
}

TEST(LaneRiesenfeld, pinned_degree_two_is_the_clamped_quadratic) {
  for (const Index more : {0u, 1u, 2u, 9u}) {
    const auto curves = random_curve(rule_of(2, CurveWrap::pinned), more, 1);
    const auto fine = refined(curves, 4);
    for (Count j = 0; j < fine.points.size(); ++j) {
      const double t = point_parameter(curves, curves.point_count(), 4, j);
      ASSERT_NEAR(fine.limit_points[j], clamped_quadratic(curves.points, t), 1e-15 * 4) << t;
    }
    EXPECT_NEAR(fine.tangents.front(), 2 * (curves.points[1] - curves.points[0]), 1e-13);
  }
}

// One span of the clamped quadratic is the parabola of its three points.
TEST(LaneRiesenfeld, three_points_of_degree_two_are_a_parabola) {
  auto curves = rule_of(2, CurveWrap::pinned);
  curves.width = 1;
  curves.points = {0, 0, 1};  // t^2
  const auto fine = refined(curves, 6);
  for (Count j = 0; j < fine.points.size(); ++j) {
    const double t = point_parameter(curves, 3, 6, j);
    EXPECT_NEAR(fine.limit_points[j], t * t, 1e-15);
    EXPECT_NEAR(fine.tangents[j], 2 * t, 1e-13);
  }
}

TEST(LaneRiesenfeld, two_pinned_points_are_a_line_for_every_odd_degree) {
  for (Index degree = 1; degree <= kMaxCurveDegree; degree += 2) {
    auto curves = rule_of(degree, CurveWrap::pinned);
    curves.width = 1;
    curves.points = {0, 1};
    const auto fine = refined(curves, 3);
    for (std::size_t j = 0; j < fine.points.size(); ++j) {
      EXPECT_NEAR(fine.points[j], static_cast<double>(j) / 8, 1e-15) << degree;
      EXPECT_NEAR(fine.tangents[j], 1, 1e-13) << degree;
    }
  }
}

// A point moved off changes exactly the children that see it.
TEST(LaneRiesenfeld, reach_is_the_farthest_point_that_counts) {
  for (Index degree = 1; degree <= kMaxCurveDegree; ++degree) {
    ControlCurves curves = rule_of(degree, CurveWrap::periodic);
    curves.width = 1;
    curves.points.assign(64, 0);
    curves.points[32] = 1;
    const auto fine = refined(curves, 1).points;
    Index farthest = 0;
    for (Index m = 0; m < 128; ++m)
      if (fine[m] != 0) farthest = std::max(farthest, m / 2 > 32 ? m / 2 - 32 : 32 - m / 2);
    EXPECT_EQ(split_of(curves).reach, farthest) << degree;
  }
}

}  // namespace
}  // namespace subdivd::testing

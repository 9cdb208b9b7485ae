#include "core/curves/corner_cutting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/core/curves/sample_curves.h"

namespace subdivd::testing {
namespace {

ControlCurves cut(CurveWrap wrap, double ratio, Index points, Index width = 2) {
  auto curves = random_curve(wrap, points, width);
  curves.basis = CornerCutting{ratio};
  return curves;
}

TEST(CornerCutting, ratios_lie_between_zero_and_a_half) {
  EXPECT_TRUE(is_cutting_ratio(1e-300));
  EXPECT_TRUE(is_cutting_ratio(std::nextafter(0.5, 0)));
  EXPECT_FALSE(is_cutting_ratio(0));
  EXPECT_FALSE(is_cutting_ratio(0.5));
  EXPECT_FALSE(is_cutting_ratio(std::nan("")));
}

TEST(CornerCutting, a_quarter_is_degree_two_to_the_bit) {
  for (const CurveWrap wrap : kAllWraps)
    for (const Index points : {3u, 4u, 9u}) {
      const auto curves = cut(wrap, 0.25, points);
      auto quadratic = curves;
      quadratic.basis = UniformBSpline{2};
      const auto a = refined(curves, 4), b = refined(quadratic, 4);
      EXPECT_EQ(a.points, b.points);
      EXPECT_EQ(a.limit_points, b.limit_points);
      EXPECT_EQ(a.tangents, b.tangents);
    }
}

TEST(CornerCutting, every_edge_is_cut_at_the_ratio_from_both_ends) {
  ControlCurves curves = cut(CurveWrap::periodic, 0.125, 3, 1);
  curves.points = {0, 8, 16};
  EXPECT_EQ(refined(curves, 1).points, (std::vector<double>{2, 1, 7, 9, 15, 14}));
  curves.wrap = CurveWrap::nonperiodic;
  EXPECT_EQ(refined(curves, 1).points, (std::vector<double>{1, 7, 9, 15}));
  curves.wrap = CurveWrap::pinned;
  EXPECT_EQ(refined(curves, 1).points, (std::vector<double>{0, 6, 10, 16}));  // half edges, cut at 2r
}

// The curve's point for a corner is the middle of the edge that cuts it off, on that and every later polygon.
TEST(CornerCutting, limits_are_middles_of_edges_for_ever) {
  for (const CurveWrap wrap : kAllWraps)
    for (const double ratio : {0.01, 0.2, 0.25, 1.0 / 3, 0.45}) {
      const auto curves = cut(wrap, ratio, 7);
      const auto limits = refined(curves, 0).limit_points;
      for (Index level = 1; level <= 6; ++level) {
        const auto fine = refined(curves, level).points;
        // Around the parameter of point i: the children 2i and 2i+1, and then the edge's middle piece.
        const Count n = fine.size() / 2;
        for (Count i = wrap == CurveWrap::periodic ? 0 : 1; i < 6; ++i) {
          const double t = point_parameter(curves, 7, 0, i);
          Count left = 0;
          while (left + 1 < n && point_parameter(curves, 7, level, left + 1) < t) ++left;
          for (Index k = 0; k < 2; ++k)
            ASSERT_NEAR((fine[left * 2 + k] + fine[(left + 1) * 2 + k]) / 2, limits[i * 2 + k], 1e-14)
                << ratio << " level " << level << " point " << i;
        }
      }
    }
}

// Up to a third the curve leaves its point along the tangent: the next corners come ever closer to the line.
TEST(CornerCutting, tangents_point_along_the_curve_up_to_a_third) {
  for (const double ratio : {0.1, 0.25, 0.3}) {
    const auto curves = cut(CurveWrap::periodic, ratio, 6);
    const auto coarse = refined(curves, 0);
    const Index level = 14;
    const auto fine = refined(curves, level).points;
    for (Count i = 1; i < 5; ++i) {
      const double* limit = &coarse.limit_points[i * 2];
      const double* tangent = &coarse.tangents[i * 2];
      // Three points behind: past the edge that the limit lies on.
      const Count near = ((2 * i + 1) << (level - 1)) + 2;
      const double dx = fine[near * 2] - limit[0], dy = fine[near * 2 + 1] - limit[1];
      const double sine =
          (dx * tangent[1] - dy * tangent[0]) / std::hypot(dx, dy) / std::hypot(tangent[0], tangent[1]);
      EXPECT_NEAR(sine, 0, ratio == 0.3 ? 0.3 : 2e-3) << ratio << " " << i;
      EXPECT_GT(dx * tangent[0] + dy * tangent[1], 0);
    }
  }
}

// A convex polygon's curve stays inside it and turns one way.
TEST(CornerCutting, convex_stays_convex) {
  for (const double ratio : {0.05, 0.25, 0.4}) {
    ControlCurves square = cut(CurveWrap::periodic, ratio, 4);
    square.points = {1, 0, 0, 1, -1, 0, 0, -1};
    const auto fine = refined(square, 5).points;
    const Count n = fine.size() / 2;
    for (Count i = 0; i < n; ++i) {
      const double* a = &fine[i * 2];
      const double* b = &fine[(i + 1) % n * 2];
      const double* c = &fine[(i + 2) % n * 2];
      EXPECT_GE((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]), -1e-15);
      EXPECT_LE(std::abs(a[0]) + std::abs(a[1]), 1 + 1e-15);
    }
  }
}

TEST(CornerCutting, a_pinned_end_leaves_towards_its_neighbour) {
  const auto curves = cut(CurveWrap::pinned, 0.3, 5);
  const auto fine = refined(curves, 0);
  for (Index k = 0; k < 2; ++k) {
    EXPECT_EQ(fine.tangents[k], 2 * (curves.points[2 + k] - curves.points[k]));
    EXPECT_EQ(fine.tangents[8 + k], 2 * (curves.points[8 + k] - curves.points[6 + k]));
  }
}

}  // namespace
}  // namespace subdivd::testing

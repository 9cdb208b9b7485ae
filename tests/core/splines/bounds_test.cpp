#include "core/splines/bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "core/splines/bspline.h"
#include "tests/core/splines/sample_splines.h"

namespace subdivd {
namespace {

using samples::bezier;

Box box_of(const Spline& spline) {
  const auto box = bounds(spline, Budget{});
  EXPECT_TRUE(box.ok());
  return box ? *box : Box{};
}

// The largest sign * coordinate near `t` by narrowing a third at a time.
double highest_near(const Spline& spline, double t, double step, Index k, double sign) {
  const auto value = [&](double at) { return sign * samples::point_at(spline, at)[k]; };
  double low = std::max(spline.begin(), t - step), high = std::min(spline.end(), t + step);
  for (int i = 0; i < 60; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (value(a) < value(b) ? low : high) = value(a) < value(b) ? a : b;
  }
  return value((low + high) / 2);
}

// By looking everywhere.
double highest_sampled(const Spline& spline, Index k, double sign) {
  double best = -HUGE_VAL, best_at = 0;
  for (const double t : samples::parameters(spline, 1000))
    if (const double value = sign * samples::point_at(spline, t)[k]; value > best) best = value, best_at = t;
  return std::max(best, highest_near(spline, best_at, (spline.end() - spline.begin()) / 1000, k, sign));
}

TEST(Bounds, are_the_extremes_of_the_curve) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const Box box = box_of(spline);
    const double allowed = 1e-12 * extent(spline);
    for (Index k = 0; k < spline.dimension(); ++k) {
      EXPECT_NEAR(box.high[k], highest_sampled(spline, k, 1), allowed) << name;
      EXPECT_NEAR(box.low[k], -highest_sampled(spline, k, -1), allowed) << name;
    }
  }
}

TEST(Bounds, leave_no_point_of_the_curve_outside_but_for_rounding) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const Box box = box_of(spline);
    for (const double t : samples::parameters(spline, 3000)) {
      const auto point = samples::point_at(spline, t);
      for (Index k = 0; k < spline.dimension(); ++k) {
        ASSERT_GE(point[k], box.low[k] - 1e-14) << name << " at " << t;
        ASSERT_LE(point[k], box.high[k] + 1e-14) << name << " at " << t;
      }
    }
  }
}

TEST(Bounds, of_a_circle_are_its_radius) {
  const Box box = box_of(samples::circle());
  for (Index k = 0; k < 2; ++k) {
    EXPECT_NEAR(box.high[k], 1, 1e-14);
    EXPECT_NEAR(box.low[k], -1, 1e-14);
  }
}

// Turned, so that the extremes lie inside pieces.
TEST(Bounds, of_a_turned_circle_are_its_radius) {
  for (const double angle : {0.1, 0.7, 2.0}) {
    Spline circle = samples::circle();
    const double c = std::cos(angle), s = std::sin(angle);
    for (Count i = 0; i < circle.points.size(); i += 3) {
      const double x = circle.points[i], y = circle.points[i + 1];
      circle.points[i] = c * x - s * y;
      circle.points[i + 1] = s * x + c * y;
    }
    const Box box = box_of(circle);
    for (Index k = 0; k < 2; ++k) {
      EXPECT_NEAR(box.high[k], 1, 1e-14);
      EXPECT_NEAR(box.low[k], -1, 1e-14);
    }
  }
}

TEST(Bounds, of_a_parabola_reach_its_vertex_only) {
  const Box box = box_of(bezier(2, {-1, 1, 0, -1, 1, 1}));  // y = x^2
  EXPECT_EQ(box.low, (std::vector<double>{-1, 0}));
  EXPECT_EQ(box.high, (std::vector<double>{1, 1}));
}

TEST(Bounds, of_a_straight_line_are_its_end_points) {
  for (const Index degree : {1u, 3u, 15u}) {
    std::vector<double> points;
    for (Index i = 0; i <= degree; ++i) points.insert(points.end(), {0.1 * i, 7, -0.3 * i});
    const Box box = box_of(bezier(3, points));
    EXPECT_EQ(box.low, (std::vector<double>{0, 7, -0.3 * degree})) << degree;
    EXPECT_EQ(box.high, (std::vector<double>{0.1 * degree, 7, 0})) << degree;
  }
}

TEST(Bounds, of_coincident_points_are_the_point) {
  const Box box = box_of(bezier(2, {3, -4, 3, -4, 3, -4, 3, -4}));
  EXPECT_EQ(box.low, (std::vector<double>{3, -4}));
  EXPECT_EQ(box.high, box.low);
}

TEST(Bounds, cover_the_domain_only_where_the_ends_are_not_clamped) {
  const Spline spline = samples::random_spline(5, 3, 2, false, false, 1);
  const Box box = box_of(spline);
  EXPECT_LT(box.high[0] - box.low[0], extent(spline));
  EXPECT_NEAR(box.high[0], highest_sampled(spline, 0, 1), 1e-14);
}

TEST(Bounds, follow_powers_of_two_to_the_bit) {
  for (const int exponent : {-500, -332, 332, 500}) {
    Spline spline = samples::random_spline(7, 4, 3, false, true, 1);
    const Box plain = box_of(spline);
    for (double& x : spline.points) x = std::ldexp(x, exponent);
    const Box scaled = box_of(spline);
    for (Index k = 0; k < 3; ++k) {
      EXPECT_EQ(scaled.low[k], std::ldexp(plain.low[k], exponent));
      EXPECT_EQ(scaled.high[k], std::ldexp(plain.high[k], exponent));
    }
  }
}

TEST(Bounds, of_the_largest_doubles_do_not_overflow) {
  constexpr double kMax = std::numeric_limits<double>::max();
  const Box box = box_of(bezier(2, {-kMax, kMax, 0, -kMax, kMax, kMax}));
  EXPECT_EQ(box.low[0], -kMax);
  EXPECT_EQ(box.high, (std::vector<double>{kMax, kMax}));
  EXPECT_NEAR(box.low[1] / kMax, 0, 1e-14);
}

TEST(Bounds, never_leave_the_box_of_the_control_points) {
  samples::Random random(1);
  for (const double size : {1.0, 1e-300, std::numeric_limits<double>::max()})
    for (int i = 0; i < 1000; ++i) {
      const double a = size * random.centred(), b = i % 2 == 0 ? size * random.centred() : size;
      const Box box = box_of(bezier(1, {a, b}));
      EXPECT_GE(box.low[0], std::min(a, b));
      EXPECT_LE(box.high[0], std::max(a, b));
    }
}

TEST(Bounds, keep_their_accuracy_far_from_the_origin) {
  Spline spline = bezier(2, {-1, 1, 0, -1, 1, 1});
  for (double& x : spline.points) x += 0x1p40;
  const Box box = box_of(spline);
  EXPECT_EQ(box.low[1], 0x1p40);
}

TEST(Bounds, of_high_degrees_and_dimensions_are_the_extremes) {
  for (const Index degree : {15u, 63u})
    for (const Index dimension : {1u, 7u})
      for (const bool rational : {false, true}) {
        const Spline spline =
            samples::random_spline(degree + dimension, degree, dimension, rational, true, 1);
        const Box box = box_of(spline);
        for (Index k = 0; k < dimension; ++k)
          EXPECT_NEAR(box.high[k], highest_sampled(spline, k, 1), 1e-12) << degree << ' ' << dimension;
      }
}

TEST(Bounds, stop_when_nobody_waits) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  const auto box = bounds(samples::circle(), budget);
  ASSERT_FALSE(box.ok());
  EXPECT_EQ(box.error().code, ErrorCode::cancelled);
}

TEST(Bounds, refuse_weights_that_are_too_far_apart) {
  Spline spline = bezier(1, {0, 1, 2});
  spline.points = to_homogeneous(spline.points, 1, std::vector<double>{1, 1, 1e-200});
  spline.rational = true, spline.width = 2;
  const auto box = bounds(spline, Budget{});
  ASSERT_FALSE(box.ok());
  EXPECT_EQ(box.error().where, (Path{std::string("pointWeights"), std::uint64_t{2}}));
}

TEST(Bounds, refuse_points_that_outgrow_doubles_when_divided) {
  Spline spline = bezier(2, {0, 1, 1e200, 1e-120});
  spline.rational = true;
  ASSERT_TRUE(spline.check().ok());
  const auto box = bounds(spline, Budget{});
  ASSERT_FALSE(box.ok());
  EXPECT_EQ(box.error().code, ErrorCode::out_of_range);
}

TEST(Bounds, with_weights_at_the_limit_are_right) {
  // x = u^2 w / ((1-u)^2 + 2u(1-u) + u^2 w): close to 0 until the very end, where it is 1.
  Spline spline = bezier(1, {0, 0, 1});
  spline.points = to_homogeneous(spline.points, 1, std::vector<double>{1, 1, 0x1p-499});
  spline.rational = true, spline.width = 2;
  const Box box = box_of(spline);
  EXPECT_EQ(box.low[0], 0);
  EXPECT_EQ(box.high[0], 1);
}

TEST(Localized, keeps_coordinates_within_one_and_brings_them_back) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const auto local = to_local_coordinates(spline);
    ASSERT_TRUE(local.ok());
    const auto before = control_points_of(spline), after = control_points_of(local->spline);
    for (Count i = 0; i < before.size(); ++i) {
      EXPECT_LE(std::abs(after[i]), 1) << name;
      EXPECT_NEAR(local->to_global(static_cast<Index>(i % spline.dimension()), after[i]), before[i], 4e-16)
          << name;
    }
  }
}

TEST(Localized, of_coordinates_of_any_size_loses_none) {
  // A flat curve: constant 1 in x, of size 1e-200 in y; the unit follows what varies.
  const auto local = to_local_coordinates(bezier(2, {1, -1e-200, 1, 3e-200, 1, 1e-200}));
  ASSERT_TRUE(local.ok());
  const auto points = control_points_of(local->spline);
  EXPECT_EQ(points[0], 0);
  EXPECT_NEAR(points[3] - points[1], 2 * (points[5] - points[1]), 1e-15);
  EXPECT_GT(points[3] - points[1], 0.9);
}

TEST(Window, is_the_curve_on_its_span) {
  for (const auto& [name, spline] : samples::all_splines())
    for (Count span = spline.degree; span < spline.point_count(); ++span) {
      const double a = spline.knots[span], b = spline.knots[span + 1];
      if (!(a < b)) continue;
      const Spline part = window(spline, span);
      ASSERT_TRUE(part.check().ok()) << name;
      const double t = a + 0.3 * (b - a);
      EXPECT_EQ(samples::point_at(part, t), samples::point_at(spline, t)) << name;
    }
}

TEST(ProductWeights, multiply_polynomials) {
  const std::vector<double> f{1, -2, 0.5, 3}, g{2, 1, -1, 4};
  const auto weights = product_weights(3);
  std::vector<double> product(7, 0.0);
  for (Index i = 0; i < 4; ++i)
    for (Index j = 0; j < 4; ++j) product[i + j] += weights[i * 4 + j] * f[i] * g[j];
  for (const double u : {0.0, 0.25, 0.6, 1.0})
    EXPECT_NEAR(samples::point_at(bezier(1, product), u)[0],
                samples::point_at(bezier(1, f), u)[0] * samples::point_at(bezier(1, g), u)[0], 1e-14);
}

}  // namespace
}  // namespace subdivd

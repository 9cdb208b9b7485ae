#include "core/splines/closest.h"

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

// A circle of four cubics that misses its radius by up to 3e-4, and so touches it in eight places.
Spline almost_circle() {
  const double k = 4 * (std::sqrt(2.0) - 1) / 3;
  const std::vector<double> points{1, 0,  1,  k,  k,  1, 0,  1, -k, 1, -1, k, -1,
                                   0, -1, -k, -k, -1, 0, -1, k, -1, 1, -k, 1, 0};
  return {3, 2, false, false, {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4, 4}, points};
}

ClosestPoint closest(const Spline& spline, const std::vector<double>& point) {
  const auto found = closest_point(spline, point, Budget{});
  EXPECT_TRUE(found.ok()) << found.error().message;
  return found ? *found : ClosestPoint{};
}

Error refusal(const Spline& spline, const std::vector<double>& point, const Budget& budget = {}) {
  const auto found = closest_point(spline, point, budget);
  return found ? Error{} : found.error();
}

std::vector<double> random_point(samples::Random& random, Index dimension, double size) {
  std::vector<double> point(dimension);
  for (double& x : point) x = size * random.centred();
  return point;
}

// By looking everywhere, then closer by thirds around the best few places.
double sampled_distance(const Spline& spline, const std::vector<double>& point) {
  const auto at = [&](double t) { return samples::distance(samples::point_at(spline, t), point); };
  const std::vector<double> ts = samples::parameters(spline, 1000);
  const double step = (spline.end() - spline.begin()) / 1000;
  std::vector<std::pair<double, double>> all;
  for (const double t : ts) all.emplace_back(at(t), t);
  std::ranges::sort(all);
  double best = all.front().first;
  for (std::size_t i = 0; i < 4; ++i) {
    double low = std::max(spline.begin(), all[i].second - step),
           high = std::min(spline.end(), all[i].second + step);
    for (int k = 0; k < 60; ++k) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (at(a) > at(b) ? low : high) = at(a) > at(b) ? a : b;
    }
    best = std::min(best, at((low + high) / 2));
  }
  return best;
}

TEST(Closest, is_as_close_as_anything_found_by_looking_everywhere) {
  samples::Random random(11);
  for (const auto& [name, spline] : samples::all_splines())
    for (int i = 0; i < 4; ++i) {
      const auto point = random_point(random, spline.dimension(), 1.5);
      EXPECT_LE(closest(spline, point).distance, sampled_distance(spline, point) + 1e-12) << name;
    }
}

// Coarsely, but from many points: no other branch of the curve is closer.
TEST(Closest, misses_no_branch_of_the_curve) {
  samples::Random random(16);
  for (const auto& [name, spline] : samples::all_splines()) {
    std::vector<std::vector<double>> all;
    for (const double t : samples::parameters(spline, 300)) all.push_back(samples::point_at(spline, t));
    for (int i = 0; i < 100; ++i) {
      const auto point = random_point(random, spline.dimension(), 1);
      double least = HUGE_VAL;
      for (const auto& sample : all) least = std::min(least, samples::distance(sample, point));
      ASSERT_LE(closest(spline, point).distance, least + 1e-12) << name;
    }
  }
}

TEST(Closest, reports_the_point_at_its_parameter_and_its_distance) {
  samples::Random random(12);
  for (const auto& [name, spline] : samples::all_splines()) {
    const auto point = random_point(random, spline.dimension(), 1);
    const ClosestPoint found = closest(spline, point);
    EXPECT_EQ(found.point, samples::point_at(spline, found.parameter)) << name;
    EXPECT_NEAR(found.distance, samples::distance(found.point, point), 1e-15) << name;
  }
}

TEST(Closest, meets_the_curve_at_a_right_angle_inside_smooth_pieces) {
  samples::Random random(13);
  for (const auto& [name, spline] : samples::all_splines()) {
    const auto point = random_point(random, spline.dimension(), 1);
    const ClosestPoint found = closest(spline, point);
    const bool inside = std::ranges::none_of(
        spline.knots, [&](double knot) { return std::abs(knot - found.parameter) < 1e-9; });
    if (!inside) continue;
    std::vector<double> rows(2 * spline.dimension());
    ASSERT_TRUE(derivatives(spline, found.parameter, 1, rows).ok());
    double product = 0, speed = 0;
    for (Index k = 0; k < spline.dimension(); ++k) {
      product += (rows[k] - point[k]) * rows[spline.dimension() + k];
      speed += rows[spline.dimension() + k] * rows[spline.dimension() + k];
    }
    EXPECT_NEAR(product / std::sqrt(speed), 0, 1e-11) << name;
  }
}

TEST(Closest, finds_points_of_the_curve_themselves) {
  for (const auto& [name, spline] : samples::all_splines())
    for (const double t : samples::parameters(spline, 9)) {
      const ClosestPoint found = closest(spline, samples::point_at(spline, t));
      EXPECT_LE(found.distance, 1e-13) << name << " at " << t;
    }
}

TEST(Closest, on_a_circle_lies_in_the_direction_of_the_point) {
  for (double angle = 0.05; angle < 6.28; angle += 0.37)
    for (const double radius : {1e-3, 0.5, 1 - 1e-9, 1.0, 1.5, 1e3}) {
      const double x = std::cos(angle), y = std::sin(angle);
      const ClosestPoint found = closest(samples::circle(), {radius * x, radius * y});
      EXPECT_NEAR(found.distance, std::abs(radius - 1), 1e-13 * std::max(1.0, radius));
      EXPECT_NEAR(found.point[0], x, 1e-10) << radius;
      EXPECT_NEAR(found.point[1], y, 1e-10) << radius;
    }
}

TEST(Closest, of_the_centre_of_a_circle_is_its_first_point) {
  const ClosestPoint found = closest(samples::circle(), {0, 0});
  EXPECT_EQ(found.parameter, 0);
  EXPECT_EQ(found.distance, 1);
}

TEST(Closest, of_the_centre_of_a_circle_is_its_first_point_whatever_the_last_bits_say) {
  for (double angle = 0.01; angle < 6.28; angle += 0.1) {
    Spline circle = samples::circle();
    const double c = std::cos(angle), s = std::sin(angle);
    for (Count i = 0; i < circle.points.size(); i += 3) {
      const double x = circle.points[i], y = circle.points[i + 1];
      circle.points[i] = 3 * (c * x - s * y) + 0.1 * circle.points[i + 2];
      circle.points[i + 1] = 3 * (s * x + c * y) + 0.2 * circle.points[i + 2];
    }
    const ClosestPoint found = closest(circle, {0.1, 0.2});
    EXPECT_EQ(found.parameter, 0) << angle;
    EXPECT_NEAR(found.distance, 3, 1e-15 * 4);
  }
}

TEST(Closest, of_several_as_close_is_the_first) {
  // y = x^2 over -3 <= x <= 3 seen from (0, 5): x^2 = 9/2 on both sides.
  const Spline parabola = bezier(2, {-3, 9, 0, -9, 3, 9});
  const ClosestPoint found = closest(parabola, {0, 5});
  EXPECT_NEAR(found.point[0], -std::sqrt(4.5), 1e-12);
  EXPECT_NEAR(found.distance, std::sqrt(4.75), 1e-15);
  // A curve that goes the same way twice.
  EXPECT_LT(closest(bezier(1, {0, 1, 0}), {0.3}).parameter, 0.5);
}

TEST(Closest, among_the_many_of_an_almost_circle_is_the_first) {
  const ClosestPoint found = closest(almost_circle(), {0, 0});
  EXPECT_EQ(found.parameter, 0);
  EXPECT_EQ(found.distance, 1);
}

// Every distance is the same to 1e-9, but not to 1e-12: as many pieces as it takes to tell.
TEST(Closest, of_a_circle_with_a_ripple_is_found_with_bounded_work) {
  Spline circle = samples::circle();
  for (Count i = 0; i < circle.points.size(); i += 3)
    for (Count k = 0; k < 2; ++k) circle.points[i + k] *= 1 + 1e-9 * static_cast<double>(i % 7);
  const ClosestPoint found = closest(circle, {0, 0});
  EXPECT_LE(found.distance, sampled_distance(circle, {0, 0}) + 1e-12);
}

TEST(Closest, of_polylines_is_that_of_the_closest_segment) {
  samples::Random random(14);
  for (unsigned seed = 0; seed < 8; ++seed) {
    const Spline line = samples::random_spline(seed, 1, 3, false, true, 1);
    const auto point = random_point(random, 3, 1);
    double best = HUGE_VAL;
    for (Count i = 0; i + 1 < line.point_count(); ++i) {
      const auto a = line.point(i), b = line.point(i + 1);
      double along = 0, square = 0;
      for (Index k = 0; k < 3; ++k)
        along += (point[k] - a[k]) * (b[k] - a[k]), square += (b[k] - a[k]) * (b[k] - a[k]);
      const double share = std::clamp(along / square, 0.0, 1.0);
      std::vector<double> foot(3);
      for (Index k = 0; k < 3; ++k) foot[k] = a[k] + share * (b[k] - a[k]);
      best = std::min(best, samples::distance(foot, point));
    }
    EXPECT_NEAR(closest(line, point).distance, best, 1e-15);
  }
}

TEST(Closest, may_be_an_end_or_a_cusp) {
  EXPECT_EQ(closest(bezier(2, {0, 0, 1, 1, 2, 0}), {-1, -1}).parameter, 0);
  EXPECT_EQ(closest(bezier(2, {0, 0, 1, 1, 2, 0}), {3, -1}).parameter, 1);
  const Spline cusp = bezier(2, {1, -1, -1.0 / 3, 1, -1.0 / 3, -1, 1, 1});  // (t^2, t^3), cusp in the middle
  EXPECT_LE(closest(cusp, {-2, 0}).distance, 2 + 1e-15);
}

TEST(Closest, of_coincident_points_is_the_point_at_the_begin) {
  const ClosestPoint found = closest(bezier(2, {3, 4, 3, 4, 3, 4}), {0, 0});
  EXPECT_EQ(found.parameter, 0);
  EXPECT_EQ(found.distance, 5);
  EXPECT_EQ(closest(bezier(2, {3, 4, 3, 4, 3, 4}), {3, 4}).distance, 0);
}

TEST(Closest, follows_powers_of_two_to_the_bit) {
  const Spline spline = samples::random_spline(6, 4, 2, false, true, 2);
  for (const int exponent : {-500, -332, 332, 500}) {
    Spline scaled = spline;
    for (double& x : scaled.points) x = std::ldexp(x, exponent);
    const double size = std::ldexp(1.0, exponent);
    EXPECT_EQ(closest(scaled, {0.3 * size, 0.4 * size}).parameter, closest(spline, {0.3, 0.4}).parameter);
  }
}

TEST(Closest, does_not_mind_how_far_away_the_point_is) {
  const Spline spline = samples::random_spline(6, 3, 2, false, true, 1);
  for (const double far : {1e3, 1e6, 1e9}) {
    // From far away the closest point is the highest in that direction.
    double highest = -HUGE_VAL;
    for (const double t : samples::parameters(spline, 4000)) {
      const auto point = samples::point_at(spline, t);
      highest = std::max(highest, 0.6 * point[0] + 0.8 * point[1]);
    }
    const ClosestPoint found = closest(spline, {0.6 * far, 0.8 * far});
    EXPECT_NEAR(0.6 * found.point[0] + 0.8 * found.point[1], highest, 2 / far + 1e-12 * far + 1e-6) << far;
  }
  EXPECT_EQ(closest(spline, {1e300, 1e300}).distance, std::sqrt(2.0) * 1e300);
}

TEST(Closest, of_the_largest_doubles_does_not_overflow_on_the_way) {
  constexpr double kMax = std::numeric_limits<double>::max();
  EXPECT_EQ(closest(bezier(2, {-kMax, -kMax, kMax, -kMax}), {0, 0}).distance, kMax);
  EXPECT_EQ(refusal(bezier(1, {-kMax, -kMax / 2}), {kMax}).code, ErrorCode::out_of_range);
}

TEST(Closest, keeps_its_accuracy_far_from_the_origin) {
  Spline parabola = bezier(2, {-1, 1, 0, -1, 1, 1});
  for (double& x : parabola.points) x += 0x1p30;
  EXPECT_NEAR(closest(parabola, {0x1p30, 0x1p30 - 1}).distance, 1, 1e-15);
}

TEST(Closest, in_one_to_seven_dimensions_and_high_degrees_is_closest) {
  samples::Random random(15);
  for (const Index degree : {2u, 15u, 63u})
    for (const Index dimension : {1u, 4u, 7u}) {
      const Spline spline =
          samples::random_spline(degree + dimension, degree, dimension, degree == 15, true, 1);
      const auto point = random_point(random, dimension, 1);
      EXPECT_LE(closest(spline, point).distance, sampled_distance(spline, point) + 1e-12)
          << degree << ' ' << dimension;
    }
}

TEST(Closest, refuses_points_of_another_dimension_or_no_numbers) {
  EXPECT_EQ(refusal(samples::circle(), {1, 2, 3}).code, ErrorCode::wrong_length);
  const Error error = refusal(samples::circle(), {1, std::nan("")});
  EXPECT_EQ(error.code, ErrorCode::not_finite);
  EXPECT_EQ(error.where, (Path{std::string("point"), std::uint64_t{1}}));
}

TEST(Closest, stops_when_nobody_waits) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_EQ(refusal(samples::circle(), {1, 2}, budget).code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace subdivd

#include "core/splines/arc_length.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/splines/bspline.h"
#include "tests/core/splines/sample_splines.h"

namespace subdivd {
namespace {

using samples::bezier;

// (t^2, t^3) over -1 <= t <= 1, with a cusp in the middle; its length is 2 (13 sqrt(13) - 8) / 27.
Spline semicubical() { return bezier(2, {1, -1, -1.0 / 3, 1, -1.0 / 3, -1, 1, 1}); }

ArcLength measured(const Spline& spline, double tolerance = 1e-9) {
  const auto length = arc_length(spline, {tolerance, 1u << 18}, Budget{});
  EXPECT_TRUE(length.ok()) << length.error().message;
  return length ? *length : ArcLength{};
}

double between(const Spline& spline, double a, double b, double tolerance = 1e-12) {
  const auto length = arc_length(spline, a, b, {tolerance, 1u << 18}, Budget{});
  EXPECT_TRUE(length.ok()) << length.error().message;
  return length ? length->length : std::nan("");
}

Error refusal(const Spline& spline, double a, double b, const LengthOptions& options,
              const Budget& budget = {}) {
  const auto length = arc_length(spline, a, b, options, budget);
  return length ? Error{} : length.error();
}

double speed_at(const Spline& spline, double t) {
  std::vector<double> rows(2 * spline.dimension());
  EXPECT_TRUE(derivatives(spline, t, 1, rows).ok());
  double square = 0;
  for (Index k = 0; k < spline.dimension(); ++k)
    square += rows[spline.dimension() + k] * rows[spline.dimension() + k];
  return std::sqrt(square);
}

// Gauss's rule of five nodes on many equal parts of every span.   [AbramowitzStegun64, 25.4]
double integrated(const Spline& spline, int parts = 400) {
  const double s = 2 * std::sqrt(10.0 / 7), a = std::sqrt(5 - s) / 3, b = std::sqrt(5 + s) / 3;
  const double wa = (322 + 13 * std::sqrt(70.0)) / 900, wb = (322 - 13 * std::sqrt(70.0)) / 900;
  const std::array<double, 5> nodes{-b, -a, 0, a, b}, weights{wb, wa, 128.0 / 225, wa, wb};
  double sum = 0;
  for (Count span = spline.degree; span < spline.point_count(); ++span) {
    const double step = (spline.knots[span + 1] - spline.knots[span]) / parts;
    if (step == 0) continue;
    for (int part = 0; part < parts; ++part)
      for (std::size_t i = 0; i < 5; ++i)
        sum +=
            weights[i] * step / 2 * speed_at(spline, spline.knots[span] + step * (part + (1 + nodes[i]) / 2));
  }
  return sum;
}

// Corners on the curve, its knots among them: never longer than it.
double inscribed(const Spline& spline) {
  std::vector<double> ts = samples::parameters(spline, 5000);
  std::ranges::sort(ts);
  double sum = 0;
  auto before = samples::point_at(spline, spline.begin());
  for (const double t : ts) {
    auto here = samples::point_at(spline, t);
    sum += samples::distance(before, here);
    before = std::move(here);
  }
  return sum;
}

TEST(ArcLength, agrees_with_integration_at_every_tolerance_within_its_bound) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const double expected = integrated(spline);
    for (const double tolerance : {0.5, 1e-2, 1e-4, 1e-6, 1e-9, 1e-11}) {
      const ArcLength length = measured(spline, tolerance);
      EXPECT_LE(length.error_bound, tolerance * length.length) << name;
      // Close to cusps the integration is what errs.
      EXPECT_NEAR(length.length, expected, length.error_bound + 3e-11 * expected) << name << ' ' << tolerance;
    }
  }
}

TEST(ArcLength, is_never_less_than_that_of_an_inscribed_polygon) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const ArcLength length = measured(spline);
    EXPECT_GE(length.length + length.error_bound, inscribed(spline) * (1 - 1e-13)) << name;
  }
}

TEST(ArcLength, of_a_circle_is_two_pi) {
  for (const double tolerance : {1.0, 1e-3, 1e-6, 1e-9, 3e-12}) {
    const ArcLength length = measured(samples::circle(), tolerance);
    EXPECT_NEAR(length.length, 2 * std::numbers::pi, length.error_bound);
  }
  EXPECT_NEAR(measured(samples::circle(), 3e-12).length, 2 * std::numbers::pi, 1e-13);
}

TEST(ArcLength, of_a_parabola_is_its_closed_form) {
  const ArcLength length = measured(bezier(2, {0, 0, 0.5, 0, 1, 1}), 1e-12);  // y = x^2
  EXPECT_NEAR(length.length, std::sqrt(5.0) / 2 + std::asinh(2.0) / 4, 1e-14);
}

TEST(ArcLength, of_a_curve_with_a_cusp_is_its_closed_form) {
  const double expected = 2 * (13 * std::sqrt(13.0) - 8) / 27;
  for (const double tolerance : {1e-3, 1e-9, 1e-12}) {
    const ArcLength length = measured(semicubical(), tolerance);
    EXPECT_NEAR(length.length, expected, length.error_bound);
    EXPECT_LE(length.error_bound, tolerance * length.length);
  }
}

TEST(ArcLength, counts_the_way_there_and_back) {
  EXPECT_NEAR(measured(bezier(1, {0, 1, 0})).length, 1, 1e-9);  // up to 1/2
  EXPECT_NEAR(measured(bezier(3, {0, 0, 0, 1, 2, 2, 0, 0, 0}), 1e-12).length, 3, 3e-12);
}

TEST(ArcLength, of_a_straight_line_is_its_chord_whatever_the_speed) {
  for (const auto& points : {std::vector<double>{0, 3, 4, 5}, {0, 0, 5, 5}, {0, 0, 0, 5}, {0, 1, 1, 5}}) {
    std::vector<double> line;
    for (const double x : points) line.insert(line.end(), {0.6 * x, -0.8 * x});
    const ArcLength length = measured(bezier(2, line));
    EXPECT_NEAR(length.length, 5, length.error_bound);
  }
}

TEST(ArcLength, of_coincident_points_is_zero_and_known_to_be) {
  const ArcLength length = measured(bezier(3, {0.1, 0.2, 0.3, 0.1, 0.2, 0.3, 0.1, 0.2, 0.3, 0.1, 0.2, 0.3}));
  EXPECT_EQ(length.length, 0);
  EXPECT_EQ(length.error_bound, 0);
}

TEST(ArcLength, of_nothing_is_zero) {
  for (const double t : {0.0, 1.0, 2.3, 4.0}) EXPECT_EQ(between(samples::circle(), t, t), 0);
}

TEST(ArcLength, adds_up) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const double a = spline.begin(), c = spline.end(), b = a + 0.37 * (c - a);
    const double whole = between(spline, a, c, 1e-11);
    EXPECT_NEAR(between(spline, a, b, 1e-11) + between(spline, b, c, 1e-11), whole, 3e-11 * whole) << name;
  }
}

TEST(ArcLength, of_a_short_stretch_is_right_relative_to_itself) {
  const Spline spline = samples::random_spline(2, 5, 3, true, true, 1);
  const double middle = (spline.begin() + spline.end()) / 2, end = middle + 0x1p-40;
  EXPECT_NEAR(between(spline, middle, end, 1e-9) / (end - middle), speed_at(spline, middle),
              1e-9 * speed_at(spline, middle));
}

TEST(ArcLength, follows_powers_of_two_to_the_bit) {
  const Spline spline = samples::random_spline(4, 4, 3, false, true, 2);
  for (const int exponent : {-500, -332, 332, 500}) {
    Spline scaled = spline;
    for (double& x : scaled.points) x = std::ldexp(x, exponent);
    EXPECT_EQ(measured(scaled).length, std::ldexp(measured(spline).length, exponent));
  }
}

TEST(ArcLength, does_not_mind_the_unit_of_the_parameter) {
  Spline spline = samples::circle();
  for (double& t : spline.knots) t *= 0x1p-1000;
  EXPECT_NEAR(measured(spline).length, 2 * std::numbers::pi, 1e-8);
  for (double& t : spline.knots) t = std::ldexp(t, 1990);
  EXPECT_NEAR(measured(spline).length, 2 * std::numbers::pi, 1e-8);
}

TEST(ArcLength, keeps_its_accuracy_far_from_the_origin) {
  Spline spline = bezier(2, {0, 0, 0.5, 0, 1, 1});
  for (double& x : spline.points) x += 0x1p40;
  EXPECT_NEAR(measured(spline, 1e-12).length, std::sqrt(5.0) / 2 + std::asinh(2.0) / 4, 1e-14);
}

TEST(ArcLength, of_high_degrees_and_dimensions_agrees_with_integration) {
  for (const Index degree : {15u, 63u})
    for (const bool rational : {false, true}) {
      const Spline spline = samples::random_spline(degree, degree, 7, rational, true, 1);
      const ArcLength length = measured(spline);
      EXPECT_NEAR(length.length, integrated(spline, 600), length.error_bound + 2e-9 * length.length)
          << degree;
    }
}

// In one dimension every turn is a place without speed. Chords lose the square of their length there.
TEST(ArcLength, in_one_dimension_is_the_total_variation) {
  for (const Index degree : {1u, 2u, 5u, 15u})
    for (const bool rational : {false, true}) {
      const Spline spline = samples::random_spline(degree, degree, 1, rational, false, degree);
      const double length = measured(spline).length;
      EXPECT_NEAR(length, inscribed(spline), 1e-5 * length) << degree;
    }
}

// Millions of pieces if chords and polygons were all it had.
TEST(ArcLength, of_smooth_curves_takes_few_pieces) {
  EXPECT_LE(measured(samples::circle(), 1e-11).pieces, 12u);
  for (const auto& [name, spline] : samples::all_splines()) EXPECT_LE(measured(spline).pieces, 200u) << name;
}

TEST(ArcLength, with_weights_far_apart_is_right) {
  // A quarter of a circle, whose weights 1, c s, c^2 s^2 ... change its speed but not its shape.
  for (const double factor : {1e3, 1e6, 1e12, 1e30}) {
    Spline arc = bezier(2, {1, 0, 1, 1, 0, 1});
    arc.points =
        to_homogeneous(arc.points, 2, std::vector<double>{1, std::sqrt(0.5) * factor, factor * factor});
    arc.rational = true, arc.width = 3;
    const ArcLength length = measured(arc);
    EXPECT_NEAR(length.length, std::numbers::pi / 2, length.error_bound + 1e-13) << factor;
  }
}

TEST(ArcLength, refuses_places_outside_the_domain) {
  EXPECT_EQ(refusal(samples::circle(), -0.1, 1, {}).where, (Path{std::string("from")}));
  EXPECT_EQ(refusal(samples::circle(), std::nan(""), 1, {}).where, (Path{std::string("from")}));
  EXPECT_EQ(refusal(samples::circle(), 1, 4.1, {}).where, (Path{std::string("to")}));
  EXPECT_EQ(refusal(samples::circle(), 1, 0.5, {}).where, (Path{std::string("to")}));
  EXPECT_EQ(refusal(samples::circle(), 1, std::nan(""), {}).where, (Path{std::string("to")}));
}

TEST(ArcLength, refuses_tolerances_that_are_none) {
  for (const double tolerance : {0.0, -1e-9, std::nan(""), HUGE_VAL})
    EXPECT_EQ(refusal(samples::circle(), 0, 4, {tolerance}).code, ErrorCode::out_of_range);
}

TEST(ArcLength, refuses_a_tolerance_that_rounding_does_not_allow) {
  const Error error = refusal(samples::circle(), 0, 4, {1e-16});
  EXPECT_EQ(error.code, ErrorCode::out_of_range);
  EXPECT_EQ(error.where, (Path{std::string("tolerance")}));
  EXPECT_NE(error.message.find("rounding"), std::string::npos) << error.message;
}

TEST(ArcLength, refuses_more_pieces_than_allowed_and_says_both_numbers) {
  const Error error = refusal(semicubical(), 0, 1, {1e-9, 5});
  EXPECT_EQ(error.code, ErrorCode::too_large);
  EXPECT_EQ(error.predicted, 6u);
  EXPECT_EQ(error.allowed, 5u);
}

TEST(ArcLength, refuses_a_length_that_outgrows_doubles) {
  constexpr double kMax = std::numeric_limits<double>::max();
  const Error error = refusal(bezier(2, {-kMax, -kMax, kMax, kMax}), 0, 1, {});
  EXPECT_EQ(error.code, ErrorCode::out_of_range);
}

TEST(ArcLength, stops_when_nobody_waits) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_EQ(refusal(samples::circle(), 0, 4, {}, budget).code, ErrorCode::cancelled);
}

// --- Parameters -------------------------------------------------------------------------------------------

double parameter(const Spline& spline, double length) {
  const auto t = parameter_at_length(spline, length, kPositionOptions, Budget{});
  EXPECT_TRUE(t.ok()) << t.error().message;
  return t ? *t : std::nan("");
}

std::vector<double> equal(const Spline& spline, Count count) {
  const auto ts = equal_parameters(spline, count, kPositionOptions, Budget{});
  EXPECT_TRUE(ts.ok()) << ts.error().message;
  return ts ? *ts : std::vector<double>{};
}

TEST(ParameterAtLength, is_where_the_curve_is_as_long) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const double whole = measured(spline, 1e-11).length;
    for (const double share : {1e-9, 0.1, 0.5, 0.77, 1 - 1e-9}) {
      const double t = parameter(spline, share * whole);
      EXPECT_NEAR(between(spline, spline.begin(), t, 1e-11), share * whole, 1e-9 * whole) << name;
    }
  }
}

TEST(ParameterAtLength, of_a_line_is_the_share) {
  const Spline line = bezier(2, {0, 0, 3, 4});
  EXPECT_NEAR(parameter(line, 1.25), 0.25, 1e-15);
  EXPECT_EQ(parameter(line, 0), 0);
  EXPECT_EQ(parameter(line, 5), 1);
}

TEST(ParameterAtLength, finds_its_way_past_a_stop) {
  // x = 3u^2 - 2u^3 stands still at both ends.
  const Spline line = bezier(1, {0, 0, 1, 1});
  for (const double x : {1e-8, 0.3, 0.5, 1 - 1e-8})
    EXPECT_NEAR(samples::point_at(line, parameter(line, x))[0], x, 1e-10);
}

TEST(ParameterAtLength, refuses_lengths_that_the_curve_does_not_have) {
  for (const double length : {-1e-3, 7.0}) {
    const auto t = parameter_at_length(samples::circle(), length, kPositionOptions, Budget{});
    ASSERT_FALSE(t.ok());
    EXPECT_EQ(t.error().code, ErrorCode::out_of_range);
  }
  EXPECT_EQ(parameter_at_length(samples::circle(), std::nan(""), {}, Budget{}).error().code,
            ErrorCode::not_finite);
}

TEST(EqualParameters, cut_the_curve_into_equal_lengths) {
  auto all = samples::all_splines();
  all.push_back({"cusp", semicubical()});
  for (const auto& [name, spline] : all) {
    const double whole = measured(spline, 1e-11).length;
    const std::vector<double> ts = equal(spline, 8);
    ASSERT_EQ(ts.size(), 8u);
    EXPECT_EQ(ts.front(), spline.begin());
    EXPECT_EQ(ts.back(), spline.end());
    for (Count i = 1; i < 8; ++i)
      EXPECT_NEAR(between(spline, ts[i - 1], ts[i], 1e-10), whole / 7, 1e-9 * whole) << name << ' ' << i;
  }
}

TEST(EqualParameters, of_a_periodic_curve_leave_out_the_repeated_last) {
  Spline spline = samples::circle();
  spline.periodic = true;
  EXPECT_EQ(equal(spline, 1), (std::vector<double>{0}));
  const std::vector<double> ts = equal(spline, 12);
  ASSERT_EQ(ts.size(), 12u);
  for (Count i = 0; i < 12; ++i) {
    const auto point = samples::point_at(spline, ts[i]);
    const double angle = std::numbers::pi * static_cast<double>(i) / 6;
    EXPECT_NEAR(point[0], std::cos(angle), 1e-9);
    EXPECT_NEAR(point[1], std::sin(angle), 1e-9);
  }
}

TEST(EqualParameters, of_a_curve_without_length_are_equally_far_apart) {
  EXPECT_EQ(equal(bezier(1, {4, 4, 4}), 5), (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
}

TEST(EqualParameters, follow_powers_of_two_to_the_bit) {
  const Spline spline = samples::random_spline(4, 3, 3, false, true, 2);
  Spline scaled = spline;
  for (double& x : scaled.points) x = std::ldexp(x, -480);
  EXPECT_EQ(equal(scaled, 20), equal(spline, 20));
}

TEST(EqualParameters, refuse_counts_that_make_no_parts) {
  for (const Count count : {Count{0}, Count{1}, kMaxIndexCount + 1})
    EXPECT_EQ(equal_parameters(samples::circle(), count, {}, Budget{}).error().where,
              (Path{std::string("count")}));
}

TEST(EqualParameters, refuse_more_bytes_than_the_budget_has) {
  Budget budget;
  budget.max_bytes = 799;
  EXPECT_EQ(equal_parameters(samples::circle(), 100, {}, budget).error().code, ErrorCode::too_large);
}

}  // namespace
}  // namespace subdivd

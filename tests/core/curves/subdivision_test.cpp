#include "core/curves/subdivision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/core/curves/knot_reference.h"
#include "tests/core/curves/sample_curves.h"

namespace subdivd::testing {
namespace {

ControlCurves scalar_curve(CurveWrap wrap, std::vector<double> points) {
  ControlCurves curves;
  curves.wrap = wrap;
  curves.width = 1;
  curves.points = std::move(points);
  return curves;
}

TEST(Cubic, one_step_takes_n_points_to_2n_minus_1_2n_and_2n_minus_3) {
  EXPECT_EQ(refined_point_count(CurveWrap::pinned, 9, 1), 17u);
  EXPECT_EQ(refined_point_count(CurveWrap::periodic, 9, 1), 18u);
  EXPECT_EQ(refined_point_count(CurveWrap::nonperiodic, 9, 1), 15u);
}

TEST(Cubic, one_pinned_step_is_the_masks_by_hand) {
  const auto step = refined(scalar_curve(CurveWrap::pinned, {8, 16, 0, 4}), 1);
  EXPECT_EQ(step.points, (std::vector<double>{8, 12, 13, 8, 2.5, 2, 4}));
}

TEST(Cubic, one_periodic_step_is_the_masks_by_hand) {
  const auto step = refined(scalar_curve(CurveWrap::periodic, {8, 16, 0}), 1);
  EXPECT_EQ(step.points, (std::vector<double>{8, 12, 13, 8, 3, 4}));
}

TEST(Cubic, one_nonperiodic_step_is_the_masks_by_hand) {
  const auto step = refined(scalar_curve(CurveWrap::nonperiodic, {8, 16, 0, 4}), 1);
  EXPECT_EQ(step.points, (std::vector<double>{12, 13, 8, 2.5, 2}));
}

TEST(Cubic, level_zero_returns_the_control_points) {
  for (const CurveWrap wrap : kAllWraps) {
    const auto curves = random_curve(wrap, 6);
    EXPECT_EQ(refined(curves, 0).points, curves.points);
  }
}

TEST(Cubic, pinned_curves_keep_their_ends_to_the_bit) {
  const auto curves = random_curve(CurveWrap::pinned, 5);
  const auto fine = refined(curves, 7);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(fine.points[k], curves.points[k]);
    EXPECT_EQ(fine.points[fine.points.size() - 3 + k], curves.points[12 + k]);
    EXPECT_EQ(fine.limit_points[k], curves.points[k]);
  }
}

TEST(Cubic, two_calls_give_the_same_bits) {
  const auto curves = random_curve(CurveWrap::periodic, 17, 5);
  EXPECT_EQ(refined<float>(curves, 5).tangents, refined<float>(curves, 5).tangents);
  EXPECT_EQ(refined<float>(curves, 5).points, refined<float>(curves, 5).points);
}

TEST(Cubic, predicted_bytes_are_the_bytes_of_the_arrays) {
  for (const CurveWrap wrap : kAllWraps) {
    const auto curves = random_curve(wrap, 6, 2);
    const auto fine = refined<float>(curves, 4);
    const auto bytes = predict_bytes<float>(curves, {.level = 4, .limit = true, .tangents = true});
    ASSERT_TRUE(bytes.ok());
    EXPECT_EQ(*bytes, 4 * (fine.points.size() + fine.limit_points.size() + fine.tangents.size() +
                           fine.vertex_counts.size()));
  }
}

TEST(Cubic, refuses_a_level_over_the_maximum) {
  const auto curves = random_curve(CurveWrap::pinned, 4);
  const auto refused = refine<double>(curves, {.level = kMaxCurveLevel + 1}, Budget{});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::out_of_range);
}

TEST(Cubic, refuses_more_points_than_32_bits_number) {
  const auto curves = random_curve(CurveWrap::periodic, 257, 1);
  const auto refused = predict_bytes<double>(curves, {.level = kMaxCurveLevel});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::too_large);
  EXPECT_EQ(refused.error().predicted, Count{257} << kMaxCurveLevel);
}

TEST(Cubic, refuses_an_answer_over_the_budget_and_says_both_numbers) {
  Budget budget;
  budget.max_bytes = 1000;
  const auto refused = refine<double>(random_curve(CurveWrap::pinned, 4), {.level = 8}, budget);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::too_large);
  EXPECT_EQ(refused.error().predicted, 3u * 769 * 8 + 4);
  EXPECT_EQ(refused.error().allowed, 1000u);
}

TEST(Cubic, stops_when_nobody_waits_any_more) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  const auto refused = refine<double>(random_curve(CurveWrap::pinned, 4), {.level = 2}, budget);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::cancelled);
}

// Without polling inside one curve's loops this would run for seconds.
TEST(Cubic, stops_in_the_middle_of_one_long_curve) {
  Budget budget;
  budget.deadline = Budget::Clock::now() + std::chrono::milliseconds(20);
  const auto refused = refine<double>(random_curve(CurveWrap::pinned, 5), {.level = kMaxCurveLevel}, budget);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::deadline_exceeded);
  EXPECT_LT(Budget::Clock::now() - budget.deadline, std::chrono::seconds(5));
}

TEST(Cubic, coordinates_of_1e30_stay_finite_in_single_precision) {
  auto curves = random_curve(CurveWrap::pinned, 6);
  for (double& value : curves.points) value *= 1e30;
  const auto fine = refined<float>(curves, 4);
  ASSERT_FALSE(fine.points.empty());
  for (const float value : fine.tangents) EXPECT_TRUE(std::isfinite(value));
}

TEST(Cubic, points_of_the_largest_double_do_not_overflow_on_the_way) {
  const auto curves = scalar_curve(CurveWrap::pinned, {1.7e308, 1.7e308, 1.7e308, 1.7e308});
  const auto fine = refine<double>(curves, {.level = 5, .limit = true}, Budget{});
  ASSERT_TRUE(fine.ok());
  for (const double value : fine->limit_points) EXPECT_NEAR(value / 1.7e308, 1, 1e-15);
}

TEST(Cubic, refuses_coordinates_that_single_precision_cannot_hold) {
  const auto curves = scalar_curve(CurveWrap::pinned, {0, 1e39});
  const auto refused = refine<float>(curves, {.level = 1}, Budget{});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::out_of_range);
}

TEST(Cubic, refuses_a_tangent_that_overflows) {
  const auto curves = scalar_curve(CurveWrap::pinned, {-1.7e308, 1.7e308});
  EXPECT_TRUE(refine<double>(curves, {.level = 1}, Budget{}).ok());
  const auto refused = refine<double>(curves, {.level = 1, .tangents = true}, Budget{});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::out_of_range);
}

TEST(Cubic, ends_of_a_nonperiodic_curve_are_their_own_limit) {
  const auto fine = refined(random_curve(CurveWrap::nonperiodic, 6), 2);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(fine.limit_points[k], fine.points[k]);
}

// --- Every basis, degree and wrap -------------------------------------------------------------------------

// The clear version: all points of one level, then all of the next.
TEST(Subdivision, blocks_give_the_bytes_of_one_level_after_the_other) {
  for (const ControlCurves& rule : all_rules())
    for (const Index more : {12u, 300u}) {
      auto level_by_level = random_curve(rule, more, 3);
      const auto curves = level_by_level;
      const Index levels = more == 12 ? 6 : 4;
      for (Index level = 1; level <= levels; ++level) level_by_level.points = plain_step(level_by_level);
      ASSERT_EQ(refined(curves, levels).points, level_by_level.points) << name_of_rule(curves);
    }
}

TEST(Subdivision, short_curves_are_mirrored_at_one_end_after_the_other) {
  for (const ControlCurves& rule : all_rules())
    for (const Index more : {0u, 1u, 2u, 3u}) {
      auto level_by_level = random_curve(rule, more, 1);
      const auto curves = level_by_level;
      for (Index level = 1; level <= 3; ++level) {
        level_by_level.points = plain_step(level_by_level);
        const auto found = refined(curves, level).points;
        ASSERT_EQ(found.size(), level_by_level.points.size());
        for (std::size_t k = 0; k < found.size(); ++k)
          ASSERT_NEAR(found[k], level_by_level.points[k], 1e-13) << name_of_rule(curves) << " at " << k;
      }
    }
}

TEST(Subdivision, pinned_curves_begin_and_end_at_their_end_points_to_the_bit) {
  for (const ControlCurves& rule : all_rules()) {
    if (rule.wrap != CurveWrap::pinned) continue;
    for (const Index more : {0u, 1u, 7u}) {
      const auto curves = random_curve(rule, more, 1);
      const auto fine = refined(curves, 5);
      ASSERT_EQ(fine.points.front(), curves.points.front()) << name_of_rule(curves);
      ASSERT_EQ(fine.points.back(), curves.points.back()) << name_of_rule(curves);
      ASSERT_EQ(fine.limit_points.front(), curves.points.front()) << name_of_rule(curves);
      ASSERT_EQ(fine.limit_points.back(), curves.points.back()) << name_of_rule(curves);
    }
  }
}

TEST(Subdivision, equal_points_near_the_largest_number_pass) {
  for (const ControlCurves& rule : all_rules()) {
    auto curves = random_curve(rule, 4, 1);
    std::fill(curves.points.begin(), curves.points.end(), 1.7e308);
    const auto result = refine<double>(curves, {.level = 3, .limit = true, .tangents = true}, Budget{});
    ASSERT_TRUE(result.ok()) << name_of_rule(curves);
    for (const double value : result->limit_points) ASSERT_NEAR(value / 1.7e308, 1, 1e-14);
  }
}

TEST(Subdivision, single_precision_is_double_rounded) {
  for (const ControlCurves& rule : all_rules()) {
    const auto curves = random_curve(rule, 5, 3);
    const auto fine = refined(curves, 3);
    const auto coarse = refined<float>(curves, 3);
    ASSERT_EQ(fine.points.size(), coarse.points.size());
    for (std::size_t k = 0; k < fine.points.size(); ++k) {
      ASSERT_NEAR(fine.points[k], double{coarse.points[k]}, 4e-6) << name_of_rule(curves);
      ASSERT_NEAR(fine.limit_points[k], double{coarse.limit_points[k]}, 4e-6) << name_of_rule(curves);
      ASSERT_NEAR(fine.tangents[k], double{coarse.tangents[k]}, 2e-4) << name_of_rule(curves);
    }
  }
}

TEST(Subdivision, predicted_bytes_are_the_bytes_of_the_arrays) {
  for (const ControlCurves& rule : all_rules()) {
    const auto curves = random_curve(rule, 3, 2);
    const auto fine = refined<float>(curves, 4);
    const auto bytes = predict_bytes<float>(curves, {.level = 4, .limit = true, .tangents = true});
    ASSERT_TRUE(bytes.ok());
    EXPECT_EQ(*bytes, 4 * (3 * fine.points.size() + fine.vertex_counts.size()));
  }
}

// 2^24 times 300 points: refused by numbers alone, for a budget that would allow any size.
TEST(Subdivision, refuses_level_bombs_of_every_basis) {
  for (const ControlCurves& rule : all_rules()) {
    const auto curves = random_curve(rule, 300, 1);
    const auto refused = refine<double>(curves, {.level = kMaxCurveLevel}, Budget{});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::too_large);
    const auto too_deep = refine<double>(curves, {.level = kNoIndex}, Budget{});
    ASSERT_FALSE(too_deep.ok());
    EXPECT_EQ(too_deep.error().code, ErrorCode::out_of_range);
  }
}

TEST(Subdivision, deadline_and_cancellation_stop_every_basis) {
  const std::atomic<bool> gone = true;
  Budget cancelled, late;
  cancelled.cancelled = &gone;
  late.deadline = Budget::Clock::now();
  for (const ControlCurves& rule : all_rules()) {
    const auto curves = random_curve(rule, 3, 1);
    const auto first = refine<double>(curves, {.level = 2}, cancelled);
    ASSERT_FALSE(first.ok());
    EXPECT_EQ(first.error().code, ErrorCode::cancelled);
    const auto second = refine<double>(curves, {.level = 12}, late);
    ASSERT_FALSE(second.ok());
    EXPECT_EQ(second.error().code, ErrorCode::deadline_exceeded);
  }
}

}  // namespace
}  // namespace subdivd::testing

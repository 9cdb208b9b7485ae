#include "core/curves/cubic.h"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(Cubic, counts_follow_the_closed_forms) {
  for (const CurveWrap wrap : kAllWraps)
    for (Index points = fewest_points(wrap); points < 12; ++points)
      for (Index level = 0; level <= 6; ++level)
        EXPECT_EQ(refined(random_curve(wrap, points), level).points.size(),
                  3 * refined_point_count(wrap, points, level));
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

TEST(Cubic, several_curves_refine_as_each_would_alone) {
  auto both = random_curve(CurveWrap::pinned, 9);
  both.vertex_counts = {4, 5};
  auto one = both, two = both;
  one.vertex_counts.clear(), two.vertex_counts.clear();
  one.points.resize(12);
  two.points.erase(two.points.begin(), two.points.begin() + 12);
  auto expected = refined(one, 3).points;
  const auto second = refined(two, 3).points;
  expected.insert(expected.end(), second.begin(), second.end());
  const auto together = refined(both, 3);
  EXPECT_EQ(together.points, expected);
  EXPECT_EQ(together.vertex_counts, (std::vector<Index>{25, 33}));
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

}  // namespace
}  // namespace subdivd::testing

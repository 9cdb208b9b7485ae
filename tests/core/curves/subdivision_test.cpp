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

// --- Every basis, degree and wrap -------------------------------------------------------------------------

// Places of the points that have whole neighbourhoods at this level.
bool lies_in_domain(const ControlCurves& rule, Count points, Count place) {
  const Count outer = rule.wrap == CurveWrap::nonperiodic ? split_of(rule).lost / 2 : 0;
  return place >= outer && place + outer < points;
}

TEST(Subdivision, counts_follow_the_closed_forms) {
  for (const ControlCurves& rule : all_rules())
    for (const Index more : {0u, 1u, 5u})
      for (Index level = 0; level <= 4; ++level) {
        const auto curves = random_curve(rule, more, 2);
        const auto fine = refined(curves, level);
        const Count expected = refined_point_count(curves, curves.point_count(), level);
        ASSERT_EQ(fine.points.size(), 2 * expected) << name_of_rule(curves);
        ASSERT_EQ(fine.vertex_counts, std::vector<Index>{static_cast<Index>(expected)});
      }
}

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

TEST(Subdivision, widths_and_neighbouring_scalars_do_not_mix) {
  for (const ControlCurves& rule : all_rules())
    for (const Index width : {1u, 2u, 4u, 5u, 700u}) {
      const auto wide = random_curve(rule, 4, width);
      auto narrow = rule;
      narrow.width = 1;
      for (Count i = 0; i < wide.point_count(); ++i)
        narrow.points.push_back(wide.points[i * width + width / 2]);
      const auto all = refined(wide, 2), one = refined(narrow, 2);
      ASSERT_EQ(all.points.size(), one.points.size() * width);
      for (std::size_t i = 0; i < one.points.size(); ++i) {
        ASSERT_EQ(all.points[i * width + width / 2], one.points[i]) << name_of_rule(wide);
        ASSERT_EQ(all.limit_points[i * width + width / 2], one.limit_points[i]) << name_of_rule(wide);
        ASSERT_EQ(all.tangents[i * width + width / 2], one.tangents[i]) << name_of_rule(wide);
      }
    }
}

TEST(Subdivision, weights_sum_to_one_and_those_of_tangents_to_zero) {
  for (const ControlCurves& rule : all_rules()) {
    auto curves = random_curve(rule, 3, 1);
    std::fill(curves.points.begin(), curves.points.end(), 0.7);
    const auto fine = refined(curves, 4);
    for (std::size_t k = 0; k < fine.points.size(); ++k) {
      ASSERT_NEAR(fine.points[k], 0.7, 1e-15 * 4) << name_of_rule(curves);
      ASSERT_NEAR(fine.limit_points[k], 0.7, 1e-15 * 4) << name_of_rule(curves);
      ASSERT_NEAR(fine.tangents[k], 0, 1e-13) << name_of_rule(curves);
    }
  }
}

TEST(Subdivision, affine_maps_commute) {
  const auto map = [](const std::vector<double>& p) {
    std::vector<double> q;
    for (std::size_t i = 0; i < p.size(); i += 2) {
      q.push_back(2 * p[i] - 0.5 * p[i + 1] + 3);
      q.push_back(0.25 * p[i] + p[i + 1] - 1);
    }
    return q;
  };
  for (const ControlCurves& rule : all_rules()) {
    const auto curves = random_curve(rule, 4, 2);
    auto mapped = curves;
    mapped.points = map(curves.points);
    const auto plain = refined(curves, 3), found = refined(mapped, 3);
    const auto points = map(plain.points), limits = map(plain.limit_points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      ASSERT_NEAR(found.points[k], points[k], 4e-14) << name_of_rule(curves);
      ASSERT_NEAR(found.limit_points[k], limits[k], 4e-14) << name_of_rule(curves);
    }
  }
}

// To the bit: every mask adds what lies before and after in mirrored order.
TEST(Subdivision, reversing_an_open_curve_reverses_everything) {
  for (const ControlCurves& rule : all_rules()) {
    if (rule.wrap == CurveWrap::periodic) continue;
    for (const Index more : {0u, 9u}) {
      auto curves = random_curve(rule, more, 1);
      const auto forward = refined(curves, 3);
      std::reverse(curves.points.begin(), curves.points.end());
      auto backward = refined(curves, 3);
      std::reverse(backward.points.begin(), backward.points.end());
      std::reverse(backward.limit_points.begin(), backward.limit_points.end());
      std::reverse(backward.tangents.begin(), backward.tangents.end());
      for (double& value : backward.tangents) value = -value;
      ASSERT_EQ(forward.points, backward.points) << name_of_rule(curves);
      ASSERT_EQ(forward.limit_points, backward.limit_points) << name_of_rule(curves);
      ASSERT_EQ(forward.tangents, backward.tangents) << name_of_rule(curves);
    }
  }
}

TEST(Subdivision, rotating_a_periodic_curve_rotates_its_refinement) {
  for (const ControlCurves& rule : all_rules()) {
    if (rule.wrap != CurveWrap::periodic) continue;
    auto curves = random_curve(rule, 4, 1);
    auto expected = refined(curves, 3);
    std::rotate(curves.points.begin(), curves.points.begin() + 2, curves.points.end());
    std::rotate(expected.points.begin(), expected.points.begin() + 16, expected.points.end());
    std::rotate(expected.tangents.begin(), expected.tangents.begin() + 16, expected.tangents.end());
    const auto found = refined(curves, 3);
    ASSERT_EQ(found.points, expected.points) << name_of_rule(curves);
    ASSERT_EQ(found.tangents, expected.tangents) << name_of_rule(curves);
  }
}

// Reflections are made anew at every level, from that level's points: hence to the bit.
TEST(Subdivision, two_steps_and_three_steps_are_five_steps) {
  for (const ControlCurves& rule : all_rules())
    for (const Index more : {0u, 10u}) {
      const auto curves = random_curve(rule, more, 2);
      const auto at_once = refined(curves, 5), in_two = refined(as_control(refined(curves, 2)), 3);
      ASSERT_EQ(in_two.points, at_once.points) << name_of_rule(curves);
      ASSERT_EQ(in_two.limit_points, at_once.limit_points) << name_of_rule(curves);
    }
}

// Where a point of a level stands again at the next, the limit is the same; the dual schemes are seen at
// their ends here and by the analytic tests else.
TEST(Subdivision, refinement_keeps_limits_and_tangents) {
  for (const ControlCurves& rule : all_rules()) {
    if (rule.basis == CurveBasis::corner_cutting) continue;
    const auto curves = random_curve(rule, 6, 1);
    const auto coarse = refined(curves, 1), fine = refined(curves, 3);
    const Count coarse_count = coarse.points.size(), fine_count = fine.points.size();
    const bool kinks = rule.basis == CurveBasis::bspline && rule.degree == 1;
    int met = 0;
    for (Count i = 0; i < coarse_count; ++i)
      for (Count j = 0; j < fine_count; ++j) {
        if (point_parameter(curves, curves.point_count(), 1, i) !=
            point_parameter(curves, curves.point_count(), 3, j))
          continue;
        if (!lies_in_domain(rule, coarse_count, i) || !lies_in_domain(rule, fine_count, j)) continue;
        ++met;
        ASSERT_NEAR(fine.limit_points[j], coarse.limit_points[i], 1e-14) << name_of_rule(curves);
        const bool four_point_kinks = rule.basis == CurveBasis::four_point && rule.tension == 0;
        if (!kinks && !four_point_kinks) {
          ASSERT_NEAR(fine.tangents[j], coarse.tangents[i], 4e-13) << name_of_rule(curves);
        }
      }
    const bool dual = split_of(rule).dual;
    EXPECT_GE(met, dual ? (rule.wrap == CurveWrap::pinned ? 2 : 0) : 6) << name_of_rule(curves);
  }
}

TEST(Subdivision, evenly_spaced_points_stay_at_their_parameters) {
  for (const ControlCurves& rule : all_rules()) {
    if (rule.wrap == CurveWrap::periodic) continue;
    if (rule.basis == CurveBasis::corner_cutting && rule.ratio != 0.25) continue;  // spacing becomes uneven
    auto curves = random_curve(rule, 4, 1);
    const Count points = curves.point_count();
    for (Count i = 0; i < points; ++i) curves.points[i] = point_parameter(curves, points, 0, i);
    const auto fine = refined(curves, 4);
    for (Count j = 0; j < fine.points.size(); ++j) {
      const double t = point_parameter(curves, points, 4, j);
      ASSERT_NEAR(fine.points[j], t, 1e-13) << name_of_rule(curves) << " at " << j;
      ASSERT_NEAR(fine.limit_points[j], t, 1e-13) << name_of_rule(curves) << " at " << j;
      ASSERT_NEAR(fine.tangents[j], 1, 1e-11) << name_of_rule(curves) << " at " << j;
    }
  }
}

TEST(Subdivision, points_on_a_line_stay_on_it) {
  for (const ControlCurves& rule : all_rules()) {
    auto curves = random_curve(rule, 4, 2);
    for (Count i = 0; i < curves.points.size(); i += 2) curves.points[i + 1] = 3 * curves.points[i] - 1;
    const auto fine = refined(curves, 4);
    for (std::size_t i = 0; i < fine.points.size(); i += 2) {
      ASSERT_NEAR(fine.points[i + 1], 3 * fine.points[i] - 1, 1e-13) << name_of_rule(curves);
      ASSERT_NEAR(fine.tangents[i + 1], 3 * fine.tangents[i], 1e-11) << name_of_rule(curves);
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

TEST(Subdivision, coincident_points_stay_one_point) {
  for (const ControlCurves& rule : all_rules()) {
    auto curves = random_curve(rule, 3, 3);
    for (std::size_t k = 0; k < curves.points.size(); ++k) curves.points[k] = curves.points[k % 3];
    const auto fine = refined(curves, 3);
    for (std::size_t k = 0; k < fine.points.size(); ++k) {
      ASSERT_NEAR(fine.limit_points[k], curves.points[k % 3], 1e-15 * 4) << name_of_rule(curves);
      ASSERT_NEAR(fine.tangents[k], 0, 1e-13) << name_of_rule(curves);
    }
  }
}

// Powers of two change no digit.
TEST(Subdivision, huge_and_tiny_curves_are_the_same_curve) {
  for (const ControlCurves& rule : all_rules())
    for (const int exponent : {-500, 500, 1000}) {
      const auto curves = random_curve(rule, 3, 2);
      auto scaled = curves;
      for (double& value : scaled.points) value = std::ldexp(value, exponent);
      const auto plain = refined(curves, 3), found = refined(scaled, 3);
      ASSERT_EQ(plain.points.size(), found.points.size()) << name_of_rule(curves);
      for (std::size_t k = 0; k < plain.points.size(); ++k) {
        ASSERT_EQ(found.points[k], std::ldexp(plain.points[k], exponent)) << name_of_rule(curves);
        ASSERT_EQ(found.tangents[k], std::ldexp(plain.tangents[k], exponent)) << name_of_rule(curves);
      }
    }
}

TEST(Subdivision, the_largest_numbers_give_finite_answers_or_an_error) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  for (const ControlCurves& rule : all_rules()) {
    auto curves = random_curve(rule, 4, 1);
    for (std::size_t k = 0; k < curves.points.size(); ++k)
      curves.points[k] = k % 3 == 1 ? -kLargest : kLargest;
    const auto result = refine<double>(curves, {.level = 3, .limit = true, .tangents = true}, Budget{});
    if (!result) {
      EXPECT_EQ(result.error().code, ErrorCode::out_of_range);
      continue;
    }
    for (const double value : result->points) ASSERT_TRUE(std::isfinite(value)) << name_of_rule(curves);
    for (const double value : result->tangents) ASSERT_TRUE(std::isfinite(value)) << name_of_rule(curves);
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

TEST(Subdivision, several_curves_refine_as_each_would_alone) {
  for (const ControlCurves& rule : all_rules()) {
    const auto one = random_curve(rule, 1, 2), two = random_curve(rule, 8, 2);
    auto both = one;
    both.points.insert(both.points.end(), two.points.begin(), two.points.end());
    both.vertex_counts = {static_cast<Index>(one.point_count()), static_cast<Index>(two.point_count())};
    ASSERT_TRUE(both.check().ok());
    auto expected = refined(one, 3).tangents;
    const auto second = refined(two, 3).tangents;
    expected.insert(expected.end(), second.begin(), second.end());
    ASSERT_EQ(refined(both, 3).tangents, expected) << name_of_rule(one);
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

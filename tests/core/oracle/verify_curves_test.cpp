#include <gtest/gtest.h>

#include <atomic>

#include "core/oracle/compare.h"
#include "core/oracle/verify.h"
#include "tests/core/curves/sample_curves.h"
#include "tests/core/oracle/fixtures.h"

namespace subdivd::oracle::testing {
namespace {

using subdivd::testing::as_control;
using subdivd::testing::fewest_points;
using subdivd::testing::kAllWraps;
using subdivd::testing::random_curve;
using subdivd::testing::refined_answer;

constexpr CurveOptions kWithLimits{.level = 4, .limit = true};

// Far's answer at `level`, step by step as verify() gets it.
FarCurves far_at(const ControlCurves& curves, Index level) {
  FarCurves far = far_control(curves);
  for (Index l = 0; l < level; ++l) far = std::move(*far_refine_curves<double>(far, 1, true, Budget{}));
  return far;
}

LevelReport compared(const RefinedCurves<double>& ours, const ControlCurves& curves) {
  return compare(ours, far_at(curves, ours.level), point_scale(curves.points, curves.width, patient()),
                 patient());
}

template <class Real>
void expect_passes(const ControlCurves& curves, const CurveOptions& options) {
  const auto report = verify<Real>(curves, options, Budget{});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->verdict, Verdict::passed);
  ASSERT_EQ(report->levels.size(), options.level);
  for (const LevelReport& level : report->levels) {
    ASSERT_EQ(level.deviations.size(), 2u);
    EXPECT_GT(level.deviations[1].compared, 0u);
  }
}

TEST(VerifyCurves, passes_every_wrap_and_number_of_points) {
  for (const CurveWrap wrap : kAllWraps)
    for (Index points = fewest_points(wrap); points < 12; ++points) {
      expect_passes<double>(random_curve(wrap, points), kWithLimits);
      expect_passes<float>(random_curve(wrap, points), kWithLimits);
    }
}

TEST(VerifyCurves, passes_points_of_any_width) {
  for (const Index width : {1u, 2u, 4u, 17u})
    for (const CurveWrap wrap : kAllWraps) expect_passes<double>(random_curve(wrap, 5, width), kWithLimits);
}

TEST(VerifyCurves, passes_several_curves_at_once) {
  auto curves = random_curve(CurveWrap::periodic, 12);
  curves.vertex_counts = {3, 5, 4};
  expect_passes<double>(curves, kWithLimits);
}

// One Far level costs a strip; so deep a level in one go would cost 4^12 times the faces.
TEST(VerifyCurves, reaches_levels_that_far_cannot_reach_at_once) {
  expect_passes<double>(random_curve(CurveWrap::pinned, 2), {.level = 12, .limit = true});
}

TEST(VerifyCurves, level_zero_compares_the_limits_of_the_control_points) {
  const auto report =
      verify<double>(random_curve(CurveWrap::pinned, 5), {.level = 0, .limit = true}, Budget{});
  ASSERT_TRUE(report.ok());
  ASSERT_EQ(report->levels.size(), 1u);
  EXPECT_EQ(report->levels[0].deviations[1].compared, 5u);
  EXPECT_EQ(report->verdict, Verdict::passed);
}

TEST(VerifyCurves, widens_the_tolerance_far_from_the_origin_and_says_so) {
  auto curves = random_curve(CurveWrap::pinned, 6);
  for (double& x : curves.points) x += 1e6;
  const auto report = verify<double>(curves, kWithLimits, Budget{});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->verdict, Verdict::passed);
  EXPECT_GT(report->levels[0].deviations[0].tolerance, 1e-8);
  EXPECT_NE(report->remarks.back().find("origin"), std::string::npos) << report->remarks.back();
}

TEST(VerifyCurves, names_the_ends_that_it_leaves_out) {
  const auto report = verify<double>(random_curve(CurveWrap::nonperiodic, 6), kWithLimits, Budget{});
  ASSERT_TRUE(report.ok());
  ASSERT_EQ(report->remarks.size(), 2u);
  EXPECT_TRUE(report->remarks[1].starts_with("limitPoints: left out: ")) << report->remarks[1];
}

TEST(VerifyCurves, finds_a_planted_point_and_its_parameter) {
  auto curves = random_curve(CurveWrap::pinned, 9);
  curves.vertex_counts = {4, 5};
  auto ours = refined_answer(curves, 3);
  ours.points[3 * (25 + 13) + 2] += 1e-6;  // 25 points of the first curve come before
  const LevelReport report = compared(ours, curves);
  EXPECT_EQ(report.verdict(), Verdict::failed);
  EXPECT_EQ(report.deviations[0].worst_vertex, 38u);
  EXPECT_EQ(report.deviations[0].worst_face, 1u);
  EXPECT_EQ(report.deviations[0].worst_u, 13.0 / 8);
  EXPECT_NEAR(report.deviations[0].max_absolute, 1e-6, 1e-12);
  EXPECT_EQ(report.deviations[1].verdict, Verdict::passed);
}

TEST(VerifyCurves, finds_a_planted_limit_in_every_wrap) {
  for (const CurveWrap wrap : kAllWraps) {
    const auto curves = random_curve(wrap, 6);
    auto ours = refined_answer(curves, 2);
    ours.limit_points[3 * 5] += 1e-6;
    const LevelReport report = compared(ours, curves);
    EXPECT_EQ(report.deviations[0].verdict, Verdict::passed);
    EXPECT_EQ(report.deviations[1].verdict, Verdict::failed);
    EXPECT_EQ(report.deviations[1].worst_vertex, 5u);
  }
}

TEST(VerifyCurves, a_nonperiodic_curve_begins_after_the_border_does) {
  const auto curves = random_curve(CurveWrap::nonperiodic, 6);
  auto ours = refined_answer(curves, 2);
  ours.points[3] += 1;
  EXPECT_EQ(compared(ours, curves).deviations[0].worst_u, 1);
}

TEST(VerifyCurves, finds_a_curve_refined_by_another_rule_for_its_ends) {
  const auto closed = random_curve(CurveWrap::periodic, 6);
  auto as_open = closed;
  as_open.wrap = CurveWrap::pinned;
  auto ours = refined_answer(closed, 2);
  ours.wrap = CurveWrap::pinned;
  ours.vertex_counts = {21};
  ours.points.resize(3 * 21), ours.limit_points.resize(3 * 21);
  const LevelReport report = compared(ours, as_open);
  EXPECT_TRUE(report.connectivity_identical);
  EXPECT_EQ(report.verdict(), Verdict::failed);
  EXPECT_EQ(report.deviations[0].worst_vertex, 0u);
}

TEST(VerifyCurves, finds_a_missing_point) {
  const auto curves = random_curve(CurveWrap::pinned, 6);
  auto ours = refined_answer(curves, 2);
  ours.points.resize(ours.points.size() - 3);
  EXPECT_EQ(compared(ours, curves).verdict(), Verdict::failed);
}

TEST(VerifyCurves, refuses_too_much_memory_before_any_work) {
  Budget budget;
  budget.max_bytes = 1000000;
  const auto report = verify<double>(random_curve(CurveWrap::pinned, 5), {.level = 12}, budget);
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().code, ErrorCode::too_large);
}

TEST(VerifyCurves, refuses_levels_over_the_curves_own_maximum) {
  const auto report =
      verify<double>(random_curve(CurveWrap::pinned, 5), {.level = kMaxCurveLevel + 1}, Budget{});
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().code, ErrorCode::out_of_range);
}

TEST(VerifyCurves, stops_when_nobody_waits_any_more) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  const auto report = verify<double>(random_curve(CurveWrap::pinned, 5), {.level = 1}, budget);
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace subdivd::oracle::testing

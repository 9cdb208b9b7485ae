#include "core/curves/control_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/core/curves/sample_curves.h"

namespace subdivd::testing {
namespace {

ErrorCode code_of(const ControlCurves& curves) {
  const auto checked = curves.check();
  return checked ? ErrorCode::internal : checked.error().code;
}

TEST(ControlCurve, accepts_the_fewest_points_of_every_wrap) {
  for (const CurveWrap wrap : kAllWraps)
    EXPECT_TRUE(random_curve(wrap, fewest_points(wrap)).check().ok()) << int(wrap);
}

TEST(ControlCurve, rejects_one_point_fewer_than_a_wrap_needs) {
  for (const CurveWrap wrap : kAllWraps)
    EXPECT_EQ(code_of(random_curve(wrap, fewest_points(wrap) - 1)), ErrorCode::too_few_points) << int(wrap);
}

TEST(ControlCurve, rejects_an_empty_curve) { EXPECT_EQ(code_of(ControlCurves{}), ErrorCode::too_few_points); }

TEST(ControlCurve, accepts_counts_that_sum_to_the_points) {
  auto curves = random_curve(CurveWrap::pinned, 7);
  curves.vertex_counts = {2, 5};
  EXPECT_TRUE(curves.check().ok());
}

TEST(ControlCurve, rejects_counts_that_sum_to_fewer_than_the_points) {
  auto curves = random_curve(CurveWrap::pinned, 7);
  curves.vertex_counts = {2, 4};
  EXPECT_EQ(code_of(curves), ErrorCode::wrong_length);
}

TEST(ControlCurve, rejects_counts_that_sum_to_more_than_the_points) {
  auto curves = random_curve(CurveWrap::pinned, 7);
  curves.vertex_counts = {2, 6};
  EXPECT_EQ(code_of(curves), ErrorCode::wrong_length);
}

// 2^32 - 1 + 8 is 7 again in 32 bits: an attacker's way past the sum.
TEST(ControlCurve, rejects_counts_whose_32_bit_sum_wraps_around_to_the_points) {
  auto curves = random_curve(CurveWrap::pinned, 7);
  curves.vertex_counts = {kNoIndex, 8};
  EXPECT_EQ(code_of(curves), ErrorCode::wrong_length);
}

TEST(ControlCurve, names_the_short_curve_among_several) {
  auto curves = random_curve(CurveWrap::pinned, 7);
  curves.vertex_counts = {6, 1};
  const auto checked = curves.check();
  ASSERT_FALSE(checked.ok());
  EXPECT_EQ(checked.error().code, ErrorCode::too_few_points);
  EXPECT_EQ(checked.error().where, (Path{std::string("curveVertexCounts"), std::uint64_t{1}}));
}

TEST(ControlCurve, rejects_width_zero) {
  auto curves = random_curve(CurveWrap::pinned, 4);
  curves.width = 0;
  EXPECT_EQ(code_of(curves), ErrorCode::out_of_range);
}

TEST(ControlCurve, rejects_a_width_over_the_maximum) {
  ControlCurves curves;
  curves.width = kMaxCurveWidth + 1;
  curves.points.resize(2 * curves.width);
  EXPECT_EQ(code_of(curves), ErrorCode::out_of_range);
}

TEST(ControlCurve, rejects_numbers_that_do_not_make_whole_points) {
  auto curves = random_curve(CurveWrap::pinned, 4);
  curves.points.pop_back();
  EXPECT_EQ(code_of(curves), ErrorCode::wrong_length);
}

TEST(ControlCurve, names_the_coordinate_that_is_not_a_number) {
  auto curves = random_curve(CurveWrap::pinned, 4);
  curves.points[7] = std::nan("");
  const auto checked = curves.check();
  ASSERT_FALSE(checked.ok());
  EXPECT_EQ(checked.error().code, ErrorCode::not_finite);
  EXPECT_EQ(checked.error().where, (Path{std::string("points"), std::uint64_t{7}}));
}

TEST(ControlCurve, rejects_infinity) {
  auto curves = random_curve(CurveWrap::pinned, 4);
  curves.points[0] = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(code_of(curves), ErrorCode::not_finite);
}

TEST(ControlCurve, accepts_the_fewest_points_of_every_basis_and_no_fewer) {
  for (const ControlCurves& rule : all_rules()) {
    auto curves = random_curve(rule, 0);
    EXPECT_TRUE(curves.check().ok()) << name_of_rule(curves);
    curves.points.resize(curves.points.size() - 3);
    EXPECT_EQ(code_of(curves), ErrorCode::too_few_points) << name_of_rule(curves);
  }
}

TEST(ControlCurve, the_fewest_points_are_those_of_the_table) {
  ControlCurves curves;
  curves.wrap = CurveWrap::nonperiodic;
  for (Index degree = 1; degree <= kMaxCurveDegree; ++degree) {
    curves.basis = UniformBSpline{degree};
    EXPECT_EQ(least_points(curves), degree + 1);
  }
  curves.wrap = CurveWrap::pinned;
  for (Index degree = 1; degree <= kMaxCurveDegree; ++degree) {
    curves.basis = UniformBSpline{degree};
    EXPECT_EQ(least_points(curves), degree % 2 == 0 ? 3u : 2u);
  }
}

// The place names the one parameter that the basis has.
TEST(ControlCurve, refuses_bad_parameters_by_name) {
  const auto place_of = [](const ControlCurves& curves) {
    const auto checked = curves.check();
    return checked ? Path{} : checked.error().where;
  };
  for (const Index degree : {0u, kMaxCurveDegree + 1, kNoIndex}) {
    auto curves = random_curve(CurveWrap::periodic, 40);
    curves.basis = UniformBSpline{degree};
    EXPECT_EQ(place_of(curves), Path{std::string("degree")}) << degree;
    EXPECT_EQ(code_of(curves), ErrorCode::out_of_range);
  }
  for (const double tension : {-0.001, 0.193, 1e300, std::nan("")}) {
    auto curves = random_curve(CurveWrap::periodic, 40);
    curves.basis = FourPoint{tension};
    EXPECT_EQ(place_of(curves), Path{std::string("tension")}) << tension;
  }
  for (const double ratio : {0.0, 0.5, -1.0, std::numeric_limits<double>::infinity()}) {
    auto curves = random_curve(CurveWrap::periodic, 40);
    curves.basis = CornerCutting{ratio};
    EXPECT_EQ(place_of(curves), Path{std::string("ratio")}) << ratio;
    EXPECT_EQ(code_of(curves), std::isfinite(ratio) ? ErrorCode::out_of_range : ErrorCode::not_finite);
  }
}

}  // namespace
}  // namespace subdivd::testing

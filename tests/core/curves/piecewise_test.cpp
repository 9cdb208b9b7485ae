#include "core/curves/piecewise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/splines/bezier.h"
#include "core/splines/bspline.h"
#include "tests/core/splines/sample_splines.h"

namespace subdivd {
namespace {

std::vector<double> some_points(Count count, Index width = 2) {
  std::vector<double> points;
  for (Count k = 0; k < count * width; ++k) points.push_back(std::sin(1.7 * static_cast<double>(k) + 0.3));
  return points;
}

ControlCurves curves_of(CurveBasis basis, CurveWrap wrap, Count points) {
  ControlCurves curves;
  curves.basis = basis;
  curves.wrap = wrap;
  curves.width = 2;
  curves.points = some_points(points);
  return curves;
}

Nurbs& nurbs_of(ControlCurves& curves) { return std::get<Nurbs>(curves.basis); }

// Two curves: the circle of nine points and a cubic of five.
ControlCurves nurbs() {
  const Spline circle = samples::circle();
  ControlCurves curves = curves_of(Nurbs{}, CurveWrap::nonperiodic, 0);
  curves.vertex_counts = {9, 5};
  Nurbs& knots = nurbs_of(curves);
  knots.orders = {3, 4};
  curves.points = control_points_of(circle);
  for (const double x : some_points(5)) curves.points.push_back(x);
  knots.weights = weights(circle);
  knots.weights.insert(knots.weights.end(), 5, 2.0);
  knots.knots = circle.knots;
  knots.knots.insert(knots.knots.end(), {0, 0, 0, 0, 1, 2, 2, 2, 2});
  return curves;
}

Spline whole(const ControlCurves& curves, Count curve = 0) {
  return *spline_of(curves, curve, curve_places(curves)[curve]);
}

// The refined answer as control curves again.
ControlCurves again(const ControlCurves& curves, const RefinedPiecewise& refined) {
  ControlCurves next;
  next.basis = refined.basis;
  next.wrap = CurveWrap::nonperiodic;
  next.width = curves.width;
  next.points = refined.points;
  next.vertex_counts = refined.vertex_counts;
  return next;
}

std::vector<ControlCurves> all_piecewise() {
  std::vector<ControlCurves> all{nurbs()};
  for (const CurveWrap wrap : {CurveWrap::nonperiodic, CurveWrap::periodic, CurveWrap::pinned}) {
    all.push_back(curves_of(Bezier{}, wrap, wrap == CurveWrap::periodic ? 9 : 10));
    all.push_back(curves_of(Hermite{}, wrap, 8));
    all.push_back(curves_of(CatmullRom{}, wrap, 7));
  }
  return all;
}

TEST(Piecewise, sizes_are_known_without_the_spline) {
  std::vector<ControlCurves> all = all_piecewise();
  nurbs_of(all.front()).ranges = {0.5, 3, 0, 2};
  all.push_back(nurbs());
  for (const CurveWrap wrap : {CurveWrap::nonperiodic, CurveWrap::periodic, CurveWrap::pinned}) {
    all.push_back(curves_of(CornerCutting{}, wrap, 9));
    for (const Index degree : {1u, 2u, 3u, 4u, 9u}) {
      all.push_back(curves_of(UniformBSpline{degree}, wrap, 12));
    }
  }
  for (const ControlCurves& curves : all) {
    ASSERT_TRUE(curves.check()) << curves.check().error().message;
    const std::vector<CurvePlace> places = curve_places(curves);
    for (Count c = 0; c < places.size(); ++c) {
      const SplineSize size = spline_size(curves, c, places[c]);
      const Spline spline = whole(curves, c);
      EXPECT_EQ(size.degree, spline.degree);
      EXPECT_EQ(size.points, spline.point_count());
      EXPECT_EQ(size.spans, bezier_pieces(spline).size());
    }
  }
}

TEST(Piecewise, refining_keeps_the_curve_and_counts_as_predicted) {
  for (const ControlCurves& curves : all_piecewise()) {
    ASSERT_TRUE(curves.check()) << curves.check().error().message;
    for (const Index level : {0u, 1u, 3u}) {
      const auto refined = refine_piecewise(curves, {.level = level}, {});
      ASSERT_TRUE(refined);
      EXPECT_EQ(refined->points.size() / 2, refined_piecewise_count(curves, level));
      const ControlCurves next = again(curves, *refined);
      ASSERT_TRUE(next.check()) << next.check().error().message;
      for (Count c = 0; c < curves.curve_count(); ++c) {
        const Spline before = whole(curves, c), after = whole(next, c);
        // Segments are one long at every level.
        const double scale = (after.end() - after.begin()) / (before.end() - before.begin());
        for (int k = 0; k <= 200; ++k) {
          const double t = std::min(before.begin() + (before.end() - before.begin()) * k / 200, before.end());
          const double moved = std::min(after.begin() + (t - before.begin()) * scale, after.end());
          EXPECT_LT(samples::distance(samples::point_at(before, t), samples::point_at(after, moved)), 1e-12);
        }
      }
    }
  }
}

TEST(Piecewise, limits_stand_on_the_curve) {
  for (const ControlCurves& curves : all_piecewise()) {
    const auto refined = refine_piecewise(curves, {.level = 2, .limit = true, .tangents = true}, {});
    ASSERT_TRUE(refined);
    ASSERT_EQ(refined->limit_points.size(), refined->points.size());
    ASSERT_EQ(refined->tangents.size(), refined->points.size());
    if (!std::holds_alternative<Nurbs>(curves.basis)) continue;
    for (Count i = 0; i < refined->vertex_counts[0]; ++i)  // the circle
      EXPECT_NEAR(std::hypot(refined->limit_points[2 * i], refined->limit_points[2 * i + 1]), 1, 1e-14);
  }
}

TEST(Piecewise, a_range_cuts_a_curve_on_knots) {
  ControlCurves curves = nurbs();
  nurbs_of(curves).ranges = {1, 3, 0, 2};
  ASSERT_TRUE(curves.check());
  const Spline half = whole(curves);
  EXPECT_EQ(half.begin(), 1);
  EXPECT_EQ(half.end(), 3);
  EXPECT_LT(samples::distance(samples::point_at(half, 2), {-1, 0}), 1e-14);
}

TEST(Piecewise, uniform_B_splines_are_splines_too_and_fractals_are_not) {
  EXPECT_EQ(whole(curves_of(UniformBSpline{}, CurveWrap::pinned, 6)).degree, 3);
  ControlCurves cut = curves_of(CornerCutting{}, CurveWrap::pinned, 6);
  EXPECT_EQ(whole(cut).degree, 2);
  cut.basis = CornerCutting{0.2};
  EXPECT_EQ(spline_of(cut, 0, {}).error().code, ErrorCode::unsupported);
  EXPECT_EQ(spline_of(curves_of(FourPoint{}, CurveWrap::pinned, 6), 0, {}).error().code,
            ErrorCode::unsupported);
}

TEST(Piecewise, check_names_the_place_of_the_fault) {
  const auto fault = [](ControlCurves curves, auto change) {
    change(curves);
    const auto checked = curves.check();
    EXPECT_FALSE(checked.ok());
    return checked.ok() ? Error{} : checked.error();
  };
  const auto at = [](const char* name, std::uint64_t i) { return Path{name, i}; };
  using C = ControlCurves;
  EXPECT_EQ(fault(nurbs(), [](C& c) { nurbs_of(c).orders = {3, 4, 4}; }).where, Path{"order"});
  EXPECT_EQ(fault(nurbs(), [](C& c) { nurbs_of(c).orders = {3, 1}; }).where, at("order", 1));
  EXPECT_EQ(fault(nurbs(), [](C& c) { nurbs_of(c).knots.pop_back(); }).where, Path{"knots"});
  EXPECT_EQ(fault(nurbs(), [](C& c) { nurbs_of(c).knots[16] = -1; }).where, at("knots", 16));
  EXPECT_EQ(fault(nurbs(), [](C& c) { nurbs_of(c).knots[16] = 9; }).where, at("knots", 17));
  EXPECT_EQ(fault(nurbs(), [](C& c) { nurbs_of(c).weights[11] = 0; }).where, at("pointWeights", 11));
  EXPECT_EQ(fault(nurbs(), [](C& c) { nurbs_of(c).weights.pop_back(); }).where, Path{"pointWeights"});
  EXPECT_EQ(fault(nurbs(), [](C& c) { c.points[20] = std::nan(""); }).where, at("points", 20));
  EXPECT_EQ(fault(nurbs(), [](C& c) { nurbs_of(c).ranges = {0, 4, 0, 3}; }).where, at("ranges", 1));
  EXPECT_EQ(fault(nurbs(), [](C& c) { nurbs_of(c).ranges = {0, 4}; }).where, Path{"ranges"});
  EXPECT_EQ(fault(nurbs(), [](C& c) { c.vertex_counts = {9, 4}; }).code, ErrorCode::wrong_length);
  const C bezier = curves_of(Bezier{}, CurveWrap::nonperiodic, 10);
  EXPECT_EQ(fault(bezier, [](C& c) { c.points.resize(18); }).code, ErrorCode::wrong_length);
  EXPECT_EQ(fault(bezier, [](C& c) { c.points.resize(6); }).code, ErrorCode::too_few_points);
  EXPECT_EQ(fault(bezier, [](C& c) { c.wrap = CurveWrap::periodic; }).code, ErrorCode::wrong_length);
  EXPECT_EQ(fault(bezier, [](C& c) { c.vertex_counts = {4, 6}; }).where, at("curveVertexCounts", 1));
  EXPECT_EQ(fault(curves_of(Hermite{}, CurveWrap::pinned, 8), [](C& c) { c.points.resize(14); }).where,
            Path{"points"});
}

TEST(Piecewise, goes_through_the_common_door) {
  const ControlCurves curves = nurbs();
  const auto refined = refine<float>(curves, {.level = 2, .tangents = true}, {});
  ASSERT_TRUE(refined);
  ASSERT_TRUE(std::holds_alternative<Nurbs>(refined->basis));
  EXPECT_EQ(refined->points.size() / 2, total_point_count(curves, 2));
  EXPECT_EQ(std::get<Nurbs>(refined->basis).orders, std::get<Nurbs>(curves.basis).orders);
  EXPECT_EQ(refine<double>(curves, {.level = 25}, {}).error().code, ErrorCode::out_of_range);
  EXPECT_GE(*predict_bytes<double>(curves, {.level = 2, .tangents = true}),
            2 * refined->points.size() * sizeof(double));
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_EQ(refine<double>(curves, {}, budget).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace subdivd

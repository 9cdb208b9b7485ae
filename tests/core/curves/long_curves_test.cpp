// One curve of a million points in every basis: its work stops in its middle.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/pace.h"
#include "core/curves/bases.h"
#include "core/curves/convergence.h"
#include "core/curves/flatten_subdivided.h"
#include "core/curves/piecewise.h"
#include "core/curves/subdivision.h"
#include "tests/support/deadlines.h"

namespace subdivd {
namespace {

using testing::expect_stops_midway;

constexpr Count kPoints = 300'000;

ControlCurves long_curve(CurveBasis basis, CurveWrap wrap = CurveWrap::periodic, Count count = kPoints) {
  ControlCurves curves;
  curves.basis = basis;
  curves.wrap = wrap;
  curves.width = 1;
  for (Count i = 0; i < count; ++i) curves.points.push_back(std::sin(static_cast<double>(i)));
  Nurbs* nurbs = std::get_if<Nurbs>(&curves.basis);
  if (nurbs == nullptr) return curves;
  nurbs->orders = {4};
  for (Count i = 0; i < count + 4; ++i) nurbs->knots.push_back(static_cast<double>(i));
  return curves;
}

TEST(LongCurves, on_knots_stop_while_they_are_checked) {
  ControlCurves curves = long_curve(Nurbs{}, CurveWrap::nonperiodic, 2'000'000);
  expect_stops_midway([&](const Budget& budget) { return curves.check(budget); });
  std::get<Nurbs>(curves.basis).weights.assign(2'000'000, 2);
  expect_stops_midway([&](const Budget& budget) { return curves.check(budget); });
}

TEST(LongCurves, stop_while_they_are_made_into_splines) {
  for (const CurveBasis& basis : std::vector<CurveBasis>{UniformBSpline{}, CornerCutting{}, Bezier{},
                                                         CatmullRom{}, Hermite{}, Nurbs{}}) {
    const ControlCurves curves = long_curve(basis);
    expect_stops_midway([&](const Budget& budget) { return spline_of(curves, 0, {}, budget); });
  }
  const ControlCurves pinned = long_curve(UniformBSpline{}, CurveWrap::pinned);
  expect_stops_midway([&](const Budget& budget) { return spline_of(pinned, 0, {}, budget); });
}

TEST(LongCurves, stop_while_they_are_written_in_another_basis) {
  const Spline spline = *spline_of(long_curve(UniformBSpline{}), 0, {});
  expect_stops_midway([&](const Budget& budget) { return bezier_points(spline, budget); });
  expect_stops_midway([&](const Budget& budget) { return bspline_points(spline, 100, budget); });
  expect_stops_midway([&](const Budget& budget) { return catmull_rom_points(spline, 100, budget); });
  expect_stops_midway([&](const Budget& budget) { return hermite_points(spline, 100, budget); });
}

TEST(LongCurves, stop_while_they_are_refined) {
  const CurveOptions options{.level = 1, .limit = true, .tangents = true};
  for (const CurveBasis& basis : std::vector<CurveBasis>{UniformBSpline{}, FourPoint{}, CornerCutting{},
                                                         Bezier{}, CatmullRom{}, Nurbs{}}) {
    const ControlCurves curves = long_curve(basis);
    expect_stops_midway([&](const Budget& budget) { return refine<float>(curves, options, budget); });
  }
}

// Where every cell was flat at once, nobody ever looked at the clock.
TEST(LongCurves, stop_while_they_are_flattened) {
  for (const CurveBasis& basis : std::vector<CurveBasis>{FourPoint{}, CornerCutting{}}) {
    const ControlCurves curves = long_curve(basis);
    const SubdividedCurve curve = *subdivided_curve(curves, 0, {});
    expect_stops_midway([&](const Budget& budget) {
      return flatten(curve, {.tolerance = 100, .max_points = 2 * kPoints}, budget);
    });
  }
}

TEST(LongCurves, stop_while_their_convergence_is_measured) {
  const ControlCurves curves = long_curve(UniformBSpline{});
  expect_stops_midway([&](const Budget& budget) { return measure_convergence(curves, 0, 1, budget); });
}

}  // namespace
}  // namespace subdivd

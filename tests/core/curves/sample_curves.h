#pragma once
// Control curves for the tests: random ones from a fixed seed and a few plain ones.

#include <random>

#include "core/curves/cubic.h"

namespace subdivd::testing {

inline constexpr unsigned kCurveSeed = 20240607;
inline constexpr CurveWrap kAllWraps[] = {CurveWrap::nonperiodic, CurveWrap::periodic, CurveWrap::pinned};

inline Index fewest_points(CurveWrap wrap) {
  return wrap == CurveWrap::pinned ? 2 : wrap == CurveWrap::periodic ? 3 : 4;
}

// Coordinates between -1 and 1.
inline ControlCurves random_curve(CurveWrap wrap, Index points, Index width = 3) {
  std::mt19937 random(kCurveSeed + points * 31 + width);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  ControlCurves curves;
  curves.wrap = wrap;
  curves.width = width;
  for (Index k = 0; k < points * width; ++k) curves.points.push_back(coordinate(random));
  return curves;
}

// refine() of a curve that must succeed.
template <class Real = double>
RefinedCurves<Real> refined(const ControlCurves& curves, Index level) {
  const CurveOptions options{.level = level, .limit = true, .tangents = true};
  auto result = refine<Real>(curves, options, Budget{});
  return result ? std::move(*result) : RefinedCurves<Real>{};
}

// The refined curve as a control curve of its own.
inline ControlCurves as_control(const RefinedCurves<double>& curves) {
  ControlCurves control;
  control.wrap = curves.wrap;
  control.width = curves.width;
  control.points = curves.points;
  control.vertex_counts = curves.vertex_counts;
  return control;
}

}  // namespace subdivd::testing

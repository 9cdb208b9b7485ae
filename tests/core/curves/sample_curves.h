#pragma once
// Control curves for the tests: random ones from a fixed seed, of every basis, and what refining gives.

#include <string>

#include "core/base/overloaded.h"
#include "core/curves/subdivision.h"
#include "tests/shapes/random.h"

namespace subdivd::testing {

inline constexpr unsigned kCurveSeed = 20240607;
inline constexpr CurveWrap kAllWraps[] = {CurveWrap::nonperiodic, CurveWrap::periodic, CurveWrap::pinned};

// Of a cubic.
inline Index fewest_points(CurveWrap wrap) {
  return wrap == CurveWrap::pinned ? 2 : wrap == CurveWrap::periodic ? 3 : 4;
}

// Coordinates between -1 and 1.
inline ControlCurves random_curve(CurveWrap wrap, Index points, Index width = 3) {
  shapes::Random random(kCurveSeed + points * 31 + width);
  ControlCurves curves;
  curves.wrap = wrap;
  curves.width = width;
  for (Index k = 0; k < points * width; ++k) curves.points.push_back(random.centred());
  return curves;
}

// Every basis and wrap, degrees 1 to 15, several tensions and ratios; no points yet.
inline std::vector<ControlCurves> all_rules() {
  std::vector<ControlCurves> rules;
  for (const CurveWrap wrap : kAllWraps) {
    ControlCurves rule;
    rule.wrap = wrap;
    const auto add = [&](const CurveBasis& basis) {
      rule.basis = basis;
      rules.push_back(rule);
    };
    for (Index degree = 1; degree <= kMaxCurveDegree; ++degree) add(UniformBSpline{degree});
    for (const double tension : {0.0, 1.0 / 16, 0.19}) add(FourPoint{tension});
    for (const double ratio : {0.01, 0.25, 1.0 / 3, 0.49}) add(CornerCutting{ratio});
  }
  return rules;
}

// The rule with random points, `more` than it needs.
inline ControlCurves random_curve(const ControlCurves& rule, Index more, Index width = 3) {
  ControlCurves curves = rule;
  curves.width = width;
  curves.points = random_curve(rule.wrap, least_points(rule) + more, width).points;
  return curves;
}

inline std::string name_of_rule(const ControlCurves& curves) {
  const auto parameter = Overloaded{
      [](const UniformBSpline& kind) { return " of degree " + std::to_string(kind.degree); },
      [](const FourPoint& kind) { return " of tension " + std::to_string(kind.tension); },
      [](const CornerCutting& kind) { return " of ratio " + std::to_string(kind.ratio); },
      [](const PiecewiseKind auto&) { return std::string(); }, [](const Nurbs&) { return std::string(); }};
  return std::string(word_of(curves.basis)) + std::visit(parameter, curves.basis) + " wrap " +
         std::to_string(int(curves.wrap)) + " points " + std::to_string(curves.point_count());
}

// An answer with plain vectors, and what it was refined from.
template <class Real>
struct Refined {
  ControlCurves rule;  // without points
  std::vector<Index> vertex_counts;
  std::vector<Real> points, limit_points, tangents;
};

// refine() of a curve that must succeed; empty when it does not.
template <class Real = double>
RefinedCurves<Real> refined_answer(const ControlCurves& curves, Index level) {
  const CurveOptions options{.level = level, .limit = true, .tangents = true};
  auto result = refine<Real>(curves, options, Budget{});
  return result ? std::move(*result) : RefinedCurves<Real>{};
}

// The same with plain vectors.
template <class Real = double>
Refined<Real> refined(const ControlCurves& curves, Index level) {
  const RefinedCurves<Real> answer = refined_answer<Real>(curves, level);
  Refined<Real> plain{curves, answer.vertex_counts, {}, {}, {}};
  plain.rule.points.clear();
  plain.points.assign(answer.points.begin(), answer.points.end());
  plain.limit_points.assign(answer.limit_points.begin(), answer.limit_points.end());
  plain.tangents.assign(answer.tangents.begin(), answer.tangents.end());
  return plain;
}

// The refined curve as a control curve of its own.
inline ControlCurves as_control(const Refined<double>& curves) {
  ControlCurves control = curves.rule;
  control.points = curves.points;
  control.vertex_counts = curves.vertex_counts;
  return control;
}

}  // namespace subdivd::testing

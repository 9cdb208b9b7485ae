#pragma once
// Control curves for the tests: random ones from a fixed seed, of every basis, and what refining gives.

#include <string>

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
    for (rule.degree = 1; rule.degree <= kMaxCurveDegree; ++rule.degree) rules.push_back(rule);
    rule.degree = 3;
    rule.basis = CurveBasis::four_point;
    for (const double tension : {0.0, 1.0 / 16, 0.19}) {
      rule.tension = tension;
      rules.push_back(rule);
    }
    rule.basis = CurveBasis::corner_cutting;
    for (const double ratio : {0.01, 0.25, 1.0 / 3, 0.49}) {
      rule.ratio = ratio;
      rules.push_back(rule);
    }
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
  return "basis " + std::to_string(int(curves.basis)) + " wrap " + std::to_string(int(curves.wrap)) +
         " degree " + std::to_string(curves.degree) + " tension " + std::to_string(curves.tension) +
         " ratio " + std::to_string(curves.ratio) + " points " + std::to_string(curves.point_count());
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

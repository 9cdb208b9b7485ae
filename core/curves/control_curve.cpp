#include "core/curves/control_curve.h"

#include <cmath>

namespace subdivd {
namespace {

struct WrapRule {
  std::string_view name;
  Index min_points;
};

WrapRule rule_of(CurveWrap wrap) {
  switch (wrap) {
    case CurveWrap::nonperiodic:
      return {"nonperiodic", 4};
    case CurveWrap::periodic:
      return {"periodic", 3};
    case CurveWrap::pinned:
      break;
  }
  return {"pinned", 2};
}

Error too_few(CurveWrap wrap, Count points, Path where) {
  const WrapRule rule = rule_of(wrap);
  return Error{ErrorCode::too_few_points,
               "a " + std::string(rule.name) + " cubic curve needs at least " +
                   std::to_string(rule.min_points) + " points; this one has " + std::to_string(points),
               std::move(where)};
}

Result<void> check_points(const ControlCurves& curves) {
  if (curves.width < 1 || curves.width > kMaxCurveWidth)
    return Error{ErrorCode::out_of_range,
                 "points have " + std::to_string(curves.width) + " components each; 1 to " +
                     std::to_string(kMaxCurveWidth) + " are allowed",
                 {"points"}};
  if (curves.points.size() % curves.width != 0)
    return Error{ErrorCode::wrong_length,
                 std::to_string(curves.points.size()) + " numbers do not make whole points of " +
                     std::to_string(curves.width) + " components",
                 {"points"}};
  if (curves.point_count() > kMaxIndexCount)
    return Error{ErrorCode::too_large,
                 "there are more points than 32-bit indices can number",
                 {"points"},
                 curves.point_count(),
                 kMaxIndexCount};
  for (Count k = 0; k < curves.points.size(); ++k)
    if (!std::isfinite(curves.points[k]))
      return Error{ErrorCode::not_finite,
                   "component " + std::to_string(k % curves.width) + " of point " +
                       std::to_string(k / curves.width) + " is not a finite number",
                   {"points", k}};
  return {};
}

}  // namespace

Result<void> ControlCurves::check() const {
  if (auto checked = check_points(*this); !checked) return checked;
  const Count given = point_count();
  const Index needed = rule_of(wrap).min_points;
  if (vertex_counts.empty()) {
    if (given < needed) return too_few(wrap, given, {"points"});
    return {};
  }
  Count taken = 0;  // cannot wrap: fewer than 2^32 points each, and the list fits in memory
  for (Count c = 0; c < vertex_counts.size(); ++c) {
    if (vertex_counts[c] < needed) return too_few(wrap, vertex_counts[c], {"curveVertexCounts", c});
    taken += vertex_counts[c];
  }
  if (taken != given)
    return Error{ErrorCode::wrong_length,
                 "the counts of curveVertexCounts add up to " + std::to_string(taken) + "; there are " +
                     std::to_string(given) + " points",
                 {"curveVertexCounts"}};
  return {};
}

}  // namespace subdivd

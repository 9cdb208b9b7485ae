#include "core/curves/control_curve.h"

#include <cmath>

#include "core/base/pace.h"
#include "core/curves/piecewise.h"

namespace subdivd {
namespace {

std::string name_of(CurveWrap wrap) {
  switch (wrap) {
    case CurveWrap::nonperiodic:
      return "nonperiodic";
    case CurveWrap::periodic:
      return "periodic";
    case CurveWrap::pinned:
      break;
  }
  return "pinned";
}

Error too_few(const ControlCurves& curves, Count points, Path where) {
  return Error{ErrorCode::too_few_points,
               "a " + name_of(curves.wrap) + " " +
                   visit_scheme(curves.basis, [](const auto& kind) { return kind.description(); }) +
                   " needs at least " + std::to_string(least_points(curves)) + " points; this one has " +
                   std::to_string(points),
               std::move(where)};
}

// Of the kind's parameters; knots are checked with the points.
Result<void> check_parameters(const CurveBasis& basis) {
  return std::visit(
      []<class Kind>(const Kind& kind) -> Result<void> {
        if constexpr (SubdividedKind<Kind>)
          return kind.check();
        else
          return {};
      },
      basis);
}

Result<void> check_points(const ControlCurves& curves, const Budget& budget) {
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
    return Error{.code = ErrorCode::too_large,
                 .message = "there are more points than 32-bit indices can number",
                 .where = {"points"},
                 .predicted = curves.point_count(),
                 .allowed = kMaxIndexCount};
  return stoppable(budget, [&](const Pace& pace) -> Result<void> {
    for (Count k = 0; k < curves.points.size(); ++k) {
      if (k % Pace::kBlock == 0) pace.spend(Pace::kBlock);
      if (!std::isfinite(curves.points[k]))
        return Error{ErrorCode::not_finite,
                     "component " + std::to_string(k % curves.width) + " of point " +
                         std::to_string(k / curves.width) + " is not a finite number",
                     {"points", k}};
    }
    return {};
  });
}

}  // namespace

CurveSplit split_of(const ControlCurves& curves) {
  return visit_scheme(curves.basis, [](const auto& kind) { return kind.split(); });
}

Index least_points(const ControlCurves& curves) {
  const CurveSplit split = split_of(curves);
  switch (curves.wrap) {
    case CurveWrap::nonperiodic:
      return split.lost + 1;
    case CurveWrap::periodic:
      return 3;
    case CurveWrap::pinned:
      break;
  }
  return split.dual ? 3 : 2;
}

Result<void> ControlCurves::check(const Budget& budget) const {
  if (auto checked = check_parameters(basis); !checked) return checked;
  if (auto checked = check_points(*this, budget); !checked) return checked;
  if (!is_subdivided(basis)) return check_piecewise(*this, budget);
  const Count given = point_count();
  const Index needed = least_points(*this);
  if (vertex_counts.empty()) {
    if (given < needed) return too_few(*this, given, {"points"});
    return {};
  }
  Count taken = 0;  // cannot wrap: fewer than 2^32 points each, and the list fits in memory
  auto counted = stoppable(budget, [&](const Pace& pace) -> Result<void> {
    for (Count c = 0; c < vertex_counts.size(); ++c) {
      pace.spend(1);
      if (vertex_counts[c] < needed) return too_few(*this, vertex_counts[c], {"curveVertexCounts", c});
      taken += vertex_counts[c];
    }
    return {};
  });
  if (!counted) return counted;
  if (taken != given)
    return Error{ErrorCode::wrong_length,
                 "the counts of curveVertexCounts add up to " + std::to_string(taken) + "; there are " +
                     std::to_string(given) + " points",
                 {"curveVertexCounts"}};
  return {};
}

}  // namespace subdivd

#pragma once
// A control curve as the caller gave it. Names and meanings of width, counts and wraps are OpenUSD's
// UsdGeomBasisCurves; type "cubic", basis "bspline" is degree 3 here.

#include <string>
#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/curves/kinds.h"

namespace subdivd {

inline constexpr Index kMaxCurveWidth = 4096;

// One or more curves over one point array: curve c takes vertex_counts[c] consecutive points.
struct ControlCurves {
  std::string name;
  Index width = 3;                   // scalars per point: 1..kMaxCurveWidth
  std::vector<double> points;        // width scalars per point
  std::vector<Index> vertex_counts;  // empty: one curve of all points
  CurveWrap wrap = CurveWrap::pinned;
  CurveBasis basis{};  // kinds.h; cubic B-splines

  Count point_count() const { return width == 0 ? 0 : points.size() / width; }
  Count curve_count() const { return vertex_counts.empty() ? 1 : vertex_counts.size(); }
  Count points_of_curve(Count curve) const {
    return vertex_counts.empty() ? point_count() : vertex_counts[curve];
  }
  // First fault and its place (JSON names: degree, tension, ratio, points, counted in scalars,
  // curveVertexCounts). Needs least_points() per curve.
  Result<void> check(const Budget& budget = {}) const;
};

// Of subdivision schemes, whose parameter (degree) must be in range.
CurveSplit split_of(const ControlCurves& curves);

// The fewest points of one curve of a subdivision scheme: nonperiodic lost + 1 (degree + 1; 6 of four_point;
// 3 of corner_cutting), periodic 3, pinned 2, or 3 of a dual scheme (even degrees, corner_cutting).
Index least_points(const ControlCurves& curves);

}  // namespace subdivd

#pragma once
// A control curve as the caller gave it. Names and meanings are OpenUSD's UsdGeomBasisCurves for
// type "cubic", basis "bspline".

#include <string>
#include <vector>

#include "core/base/index.h"
#include "core/base/result.h"

namespace subdivd {

enum class CurveWrap {
  nonperiodic,  // no end rule: N -> 2N - 3 points
  periodic,     // closed: N -> 2N
  pinned,       // the curve starts and ends at its first and last point: N -> 2N - 1
};

// One or more curves over one point array: curve c takes vertex_counts[c] consecutive points.
struct ControlCurves {
  std::string name;
  Index width = 3;                   // scalars per point: 1..kMaxCurveWidth
  std::vector<double> points;        // width scalars per point
  std::vector<Index> vertex_counts;  // empty: one curve of all points
  CurveWrap wrap = CurveWrap::pinned;

  Count point_count() const { return width == 0 ? 0 : points.size() / width; }
  Count curve_count() const { return vertex_counts.empty() ? 1 : vertex_counts.size(); }
  Count points_of_curve(Count curve) const {
    return vertex_counts.empty() ? point_count() : vertex_counts[curve];
  }
  // First fault and its place (JSON names: points, counted in scalars; curveVertexCounts). Needs per curve:
  // pinned >= 2, periodic >= 3, nonperiodic >= 4 points (a cubic segment has four).
  Result<void> check() const;
};

inline constexpr Index kMaxCurveWidth = 4096;

}  // namespace subdivd

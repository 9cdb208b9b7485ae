#pragma once
// A curve as a polyline that is nowhere farther from it than a tolerance.

#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/splines/spline.h"

namespace subdivd {

struct FlattenOptions {
  double tolerance = 0;         // in the unit of the coordinates; finite, above 0
  Count max_points = 1u << 20;  // of the polyline, at least 2
};

// Corners on the curve in its order. The first and the last are the curve's ends, those of a closed curve
// both; every knot of the domain is a corner.
struct Polyline {
  std::vector<double> parameters;  // one per corner, ascending (equal only where doubles lie no closer)
  std::vector<double> points;      // dimension() coordinates per corner
};

// The curve by halving its Bezier pieces until all control points of a piece lie within the tolerance of its
// chord, as a segment. Distance from a segment is a convex function, so the piece, which is in the hull of
// its control points, lies within the tolerance too; and as it runs from one end of the chord to the other,
// no point of the chord is farther from it. The rounding of everything is taken off the tolerance first: it
// is never exceeded.   [LaneRiesenfeld80] `spline` must have passed check(). Fails with out_of_range at
// "tolerance" (not finite, not above 0, or less than rounding allows, which the message says), with too_large
// where more than max_points or than fit the budget's bytes would be needed (predicted: how many there are at
// least), as to_local_coordinates() does, and as the budget says.
Result<Polyline> flatten(const Spline& spline, const FlattenOptions& options, const Budget& budget);

}  // namespace subdivd

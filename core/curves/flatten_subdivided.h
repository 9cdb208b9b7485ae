#pragma once
// A four-point or corner-cutting curve as a polyline that is nowhere farther from it than a tolerance.

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/curves/local_subdivision.h"
#include "core/splines/flatten.h"

namespace subdivd {

// As flatten() of a spline: by halving the curve's cells (local_subdivision.h) until it is known of every
// part that it is within the tolerance of its chord. The begin of every cell is a corner; those of four_point
// are the control points, to the bit.
//
//   corner_cutting  A cell lies in the triangle of its ends and the point between them: so do the points of
//                   either half. Its distance from the chord is that of this point at most.   [deRham56]
//   four_point      A new point is off the middle of its edge by w (s_i + s_{i+1}), s_i = c_{i-1} - 2 c_i +
//                   c_{i+1}, and a step makes of these second differences
//                     s'_{2i} = (1/2 - 2w) s_i - w (s_{i-1} + s_{i+1}),   s'_{2i+1} = 2w (s_i + s_{i+1}),
//                   none longer than g = max(1/2, 4w) < 1 times the longest. All levels together, the curve
//                   is off its chord, parameter by parameter, by 2w max |s_i| / (1 - g) at most, over the
//                   four s_i that the cell feels.   [DynGregoryLevin87]
//
// The rounding of everything is taken off the tolerance first; it is as large as the coordinates, not as the
// curve. Fails as flatten() of a spline does, and with out_of_range at "points" where a coordinate outgrows a
// double.
Result<Polyline> flatten(const SubdividedCurve& curve, const FlattenOptions& options, const Budget& budget);

}  // namespace subdivd

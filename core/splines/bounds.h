#pragma once
// The box around a curve, and what every measurement begins with: the curve moved to the origin and brought
// to size 1, where squares neither overflow nor vanish and rounding is relative to the curve's own extent.

#include <span>
#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/splines/bezier.h"
#include "core/splines/spline.h"

namespace subdivd {

// Sides parallel to the axes; one number per coordinate, low[k] <= high[k].
struct Box {
  std::vector<double> low, high;
};

// The box that touches the curve (not its control points) on every side.
// No side lies inside the curve by more than rounding, nor outside by more than 1e-12 of the longest side.
// `spline` must have passed check(). Fails as to_local_coordinates() does, and as the budget says.
//   Bezier pieces stay inside their control points' hull, whose distance from the curve falls with the square
//   of the pieces' length.   [LaneRiesenfeld80]
Result<Box> bounds(const Spline& spline, const Budget& budget);

// A spline whose coordinates are  global = centre + local * 2^exponent,  every local one within [-1, 1] and
// weights within (0, 1]; knots stay. A curve without extent has exponent 0 and local coordinates 0.
struct LocalSpline {
  Spline spline;
  std::vector<double> centre;
  int exponent = 0;
  Box control;  // around the control points, global

  // The global coordinate k. Never outside `control`, so always finite.
  double to_global(Index k, double local) const;
};

// Moves and scales, with an error of one rounding of the local coordinate, however far from the origin the
// curve lies.
// Fails with out_of_range where a control point divided by its weight outgrows a double (at "points") or a
// weight is less than 2^-500 of the largest (at "pointWeights").
Result<LocalSpline> to_local_coordinates(const Spline& spline, const Budget& budget = {});

// The part of a spline on one span alone: degree + 1 points, the knots from span - degree to span + degree +
// 1, domain [u_span, u_{span+1}].
Spline window(const Spline& spline, Count span);

// Half the distance from 1 to the next double: what one operation errs by at most, relatively.
inline constexpr double kRoundoff = 0x1p-53;

// w_ij = binom(n, i) binom(n, j) / binom(2n, i + j), row by row, (n + 1)^2 of them: the Bernstein
// coefficients of a product are  (fg)_k = sum_{i+j=k} w_ij f_i g_j.   [FaroukiRajan88]
std::vector<double> product_weights(Index degree);

}  // namespace subdivd

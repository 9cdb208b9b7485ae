#pragma once
// The point of a curve that is closest to a given one.

#include <span>
#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/splines/spline.h"

namespace subdivd {

struct ClosestPoint {
  double parameter = 0;
  std::vector<double> point;  // of the curve at `parameter`, as evaluate() has it
  double distance = 0;        // from there to the point asked about
};

// The closest of all points of the curve to `point` (dimension() coordinates). `spline` must have passed
// check(). Its distance is the least to within 1e-12 of the extent of the control points, or of the distance
// itself where that is larger (as far as a parameter's last bit allows). Of several points as close as that
// the one with the smallest parameter is returned, then moved to where the curve is at right angles to the
// line to `point`.
//
// Bezier pieces are halved, the most promising first, while they may hold something closer than what is
// known. A piece's bound is that of |C - q|^2 = n / w^2 by its Bernstein coefficients, min_k n_k / (w^2)_k,
// which falls short by the square of the piece's length only, and not at all for a circle around q: it is
// found out to be equally far everywhere at the first look.   [LaneRiesenfeld80; FaroukiRajan88] Work: a few
// dozen halvings per point that is as close as the closest; curves that stay within a hair of one distance
// without being such circles take up to thousands. At most kMaxClosestPieces pieces are looked at.
//
// Fails with wrong_length and not_finite at "point", with out_of_range where the distance outgrows a double,
// with too_large above kMaxClosestPieces, as to_local_coordinates() and evaluate() do, and as the budget says.
Result<ClosestPoint> closest_point(const Spline& spline, std::span<const double> point, const Budget& budget);

// Beyond the pieces of the spline itself.
inline constexpr Count kMaxClosestPieces = 1u << 20;

}  // namespace subdivd

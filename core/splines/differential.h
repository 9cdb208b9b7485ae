#pragma once
// How a curve runs at one point: speed, tangent, curvature, torsion, frame, all from its derivatives.
//
// `rows` are those of derivatives() (core/splines/bspline.h): the point, C', C'', C''', ... of `dimension`
// numbers each; rows beyond those a function names are not looked at. `noise` says how wrong each row may be
// (absolute, in the row's own unit); empty: every row is as right as doubles can be. A vector that is not
// longer than its noise counts as zero, which is the only threshold here, so that nothing depends on the unit
// of length or of the parameter.
//
// What does not exist is absent: a direction where C' is zero (a cusp, a stop), a normal where the curve is
// straight, a value that outgrows a double. Nothing here returns NaN or infinity.

#include <optional>
#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/base/result.h"
#include "core/splines/spline.h"

namespace subdivd {

// The noise of the rows that derivatives(spline, t, order) returns, order + 1 numbers: rounding of the sums
// C^(d) = sum_i N_i^(d)(t) P_i, that is of sum_i |N_i^(d)(t)| |P_i|, and of the quotient rule of rational
// curves.   [Higham02, section 3.1]
// Fails as derivatives(), and with out_of_range when a bound outgrows a double.
Result<std::vector<double>> derivative_noise(const Spline& spline, double t, Index order);

// |C'|, length per unit of the parameter; 0 where the curve stops. Absent only when too large.
std::optional<double> speed(std::span<const double> rows, Index dimension);

// C' / |C'|.
std::optional<std::vector<double>> unit_tangent(std::span<const double> rows, Index dimension,
                                                std::span<const double> noise = {});

// |C' x C''| / |C'|^3 in any dimension, 1 / radius of the circle that fits best; 0 where the curve is
// straight. In the plane it has a sign: positive where the curve turns counter-clockwise.   [doCarmo76,
// section 1-5]
std::optional<double> curvature(std::span<const double> rows, Index dimension,
                                std::span<const double> noise = {});

// det(C', C'', C''') / |C' x C''|^2 of a curve in space, positive for a right-handed helix; absent where the
// curve is straight. (Do Carmo's sign is the opposite one.)   [PottmannWallner01]
std::optional<double> torsion(std::span<const double> rows, std::span<const double> noise = {});

// Orthonormal: `dimension` numbers each. In the plane the normal is the tangent turned counter-clockwise by a
// right angle and there is no binormal; in space the normal points to the centre of the circle that fits
// best, and binormal = tangent x normal.
struct FrenetFrame {
  std::vector<double> tangent, normal, binormal;
};

// Of curves in the plane or in space (dimension 2 or 3); absent in any other dimension.
std::optional<FrenetFrame> frenet_frame(std::span<const double> rows, Index dimension,
                                        std::span<const double> noise = {});

}  // namespace subdivd

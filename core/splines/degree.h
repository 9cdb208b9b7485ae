#pragma once
// The same curve at another degree.

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/splines/knot_removal.h"
#include "core/splines/spline.h"

namespace subdivd {

// The same curve over its domain at degree spline.degree + times. As from part(), it starts and ends at its first
// and last point: knots outside the domain are gone, both ends stand degree + times + 1 times, and every inner knot
// stands `times` times more. out_of_range at {"degree"} above kMaxDegree. Every point of the answer is the mean of the blossoms of its knots with one of them left out.
//   f'(u_1, ..., u_{p+1}) = sum_j f(u_1, ..., without u_j, ..., u_{p+1}) / (p + 1)   [Ramshaw87]
Result<Spline> elevate_degree(const Spline& spline, Index times, const Budget& budget);

// A curve of one degree less that is the same where one exists (the degree had been elevated), and otherwise
// near: with the ends of the given one, the other points by least squares over the control points of both at
// the old degree. Knots stand once less, but no knot inside the domain is lost. out_of_range at degree 1;
// whether the bound will do is the caller's to say.
Result<Approximation> reduce_degree(const Spline& spline, const Budget& budget);

}  // namespace subdivd

#pragma once
// Uniform B-splines of degree p: Lane and Riesenfeld's subdivision and the way to its limit.
//
//   child m = sum_i a_{m-2i} c_i,  a_k = binom(p+1, k+h) / 2^p,  h = floor((p+1) / 2)   [LaneRiesenfeld80]
//
// Odd degrees are primal: for p = 3, (1 6 1)/8 at a point and (1 1)/2 between two. Even degrees are dual: for
// p = 2, (1 3)/4 and (3 1)/4.

#include <vector>

#include "core/base/index.h"
#include "core/curves/kinds.h"

namespace subdivd {

// A pinned curve is continued beyond its ends by central symmetry: about the first point e,
//   odd degrees   c_{-k} = 2e - c_k, where e = c_0
//   even degrees  d_{-k} = 2e - d_{k-1}, where e = c_0 and d_j = c_{j+1} are the other points
// and likewise about the last. For p = 2 that is the clamped quadratic B-spline.
//   UniformBSpline::split()

// a_{-h}, a_{1-h}, ...: degree + 2 weights, exact.
std::vector<double> lane_riesenfeld_mask(Index degree);

// Limits and derivatives at the points' parameters: the centred cardinal B-spline B_p and its derivative at
// integers, values[k] = B_p(k), slopes[k] = -B_p'(k); at ends also at half integers. They are quotients of
// integers, exact but for that one rounding. At the kinks of degree 1, the mean of both sides.
//   UniformBSpline::limit_masks()

// Children: weights come before sums, and outer neighbours before inner ones, in pairs: nothing outgrows the
// points on the way, and reversing the points reverses the children to the bit.
//   UniformBSpline::children()

}  // namespace subdivd

#pragma once
// The four-point scheme: an interpolating curve. Points stay; between two of them comes
//
//   (1/2 + w) (c_i + c_{i+1}) - w (c_{i-1} + c_{i+2})   [DynGregoryLevin87]
//
// w is the tension: 0 gives the polygon, 1/16 reproduces cubics, and the curve has a continuous tangent for
// 0 < w < w*, the root 0.192729... of 32 w^3 + 4 w - 1.   [HechlerMoessnerReif09]

#include "core/base/index.h"
#include "core/curves/kinds.h"

namespace subdivd {

// 0 <= w < w*. False for what is not a number.
bool is_four_point_tension(double w);

// Primal. A pinned curve is continued by c_{-k} = 2 c_0 - c_k. A nonperiodic one keeps the points next to
// which something new stands: N - 2 old and N - 3 new ones, 2N - 5. Five points would stay five for ever
// (the limit between two points depends on six), so it needs six.
//   FourPoint::split()

// Points are their own limits. With x = c_1 - c_{-1} and y = c_2 - c_{-2}, a step makes x' = (1/2 + 2w) x - w
// y and y' = x, whose left eigenvector for 1/2 is (1, -2w); scaled so that c_i = i gives 1:
//   tangent = (x - 2w y) / (2 (1 - 4w))
//   FourPoint::limit_masks()

// Children are computed as the edge's middle plus w times two differences, weights first: equal points give
// that point to the bit, and nothing outgrows a number unless the result does.
//   FourPoint::children()

}  // namespace subdivd

#pragma once
// Corner cutting with a ratio r, 0 < r < 1/2: every edge (a, b) is cut at a + r (b - a) and b - r (b - a),
// and the pieces between the cuts and across the corners are the next edges.   [Chaikin74, r = 1/4; deRham56]
//
// The middle of an edge is the middle of its middle piece, so it lies on every polygon and on the limit: the
// curve's point for an edge. The curve's point for a *corner* c_i is that of the edge that cuts it off:
//
//   limit    (1-r) c_i + r/2 (c_{i-1} + c_{i+1})
//   tangent  2r (c_{i+1} - c_{i-1})
//
// For r = 1/4 this is Lane and Riesenfeld's degree 2, step, limit and tangent. For other r the piece through
// such a point has the length (1-2r)^l after l steps, where 2^-l of the parameter pass: the derivative by the
// parameter is 0 (r > 1/4) or infinite (r < 1/4). The tangent given is that piece per 2^-l, of the level at
// hand: its *direction* is the curve's for r <= 1/3, while its length changes by 2 (1-2r) from a level to the
// next. For r > 1/3 the point is a corner of the limit, and the direction is that of the edge it stands on.
//   [GregoryQu96]

#include "core/base/index.h"
#include "core/curves/kinds.h"

namespace subdivd {

// 0 < r < 1/2. False for what is not a number.
bool is_cutting_ratio(double r);

// Dual: child 2i lies on the edge before point i, child 2i+1 on the edge behind. A pinned curve starts at the
// middle e = c_0 of an edge from 2e - c_1 to c_1, so that its first edge is half an edge and is cut once, at
// c_1 + 2r (e - c_1).
//   CornerCutting::split()

// Children are those of degree 2 to the bit for r = 1/4.
//   CornerCutting::children()

}  // namespace subdivd

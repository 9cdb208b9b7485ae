#pragma once
// Four-point and corner-cutting curves at any parameter: they have no polynomial pieces, but only a few
// control points reach a parameter, and as few children of these the halves of its interval.
//
// The parameter t is that of subdivision.h. Between two integers of it (t + 1/2 of a dual curve that is not
// pinned) lies a cell; the curve over a cell depends on
//
//   four_point      c_{i-2}, ..., c_{i+3}      the cell runs from c_i to c_{i+1}
//   corner_cutting  c_{m-1}, c_m, c_{m+1}      from the middle of the edge before c_m to that of the one
//   behind
//
// and a half of it on as many children. A double is a finite binary fraction, so that after some halvings, 52
// for most, t is the begin of a cell: there the curve is known exactly. No limit has to be cut off anywhere.
//   [DynGregoryLevin87; deRham56]
//
// Where corner cutting with r != 1/4 puts a parameter: j 2^-l (less 1/2 where dual curves are not pinned) is
// the middle of the j-th edge of the polygon of level l. What lies between two such points are 2^-l of the
// parameter and any length: it is how often was cut that t counts, not how far the curve went.

#include <span>
#include <variant>

#include "core/base/index.h"
#include "core/base/result.h"
#include "core/curves/control_curve.h"
#include "core/curves/piecewise.h"

namespace subdivd {

// The kinds that have cells.
using LocalScheme = std::variant<FourPoint, CornerCutting>;

// One of the curves of `rule`, which must outlive it and must have passed check().
struct SubdividedCurve {
  const ControlCurves* rule = nullptr;
  LocalScheme scheme{};            // that of the rule
  std::span<const double> points;  // of this curve alone

  Index dimension() const { return rule->width; }
  Count point_count() const { return points.size() / rule->width; }
  // The domain: of a periodic curve [0, N], of a pinned one [0, N - 1], of a nonperiodic one what is left on
  // all levels, [2, N - 3]; of corner_cutting [-1/2, N - 1/2], [0, N - 2] and [1/2, N - 3/2].
  double begin() const;
  double end() const;
};

// Curve number `curve` of `curves`, which is at `place` (see piecewise.h). unsupported: the bases that
// spline_of() makes splines of; but corner_cutting at any ratio, also 1/4.
Result<SubdividedCurve> subdivided_curve(const ControlCurves& curves, Count curve, CurvePlace place);

// The point at t and, of order 1, the derivative by t: order + 1 rows of dimension() numbers. At control
// points of four_point that is the control point to the bit, and equal points give that point. Where refining
// comes to the same parameter the two differ by rounding: a few of the last bits of the largest coordinate in
// reach. At the kinks of four_point with tension 0 the derivative is that of the piece behind, at the
// domain's end of the piece before. Takes time in proportion to the bits of t.
// Fails with out_of_range at "t" outside the domain (a periodic curve's t is taken modulo N), not_finite,
// out_of_range when a coordinate outgrows a double, and with unsupported at "order" for what does not exist:
// derivatives of order 2 and more, and the first of corner_cutting with r != 1/4, which at every parameter
// that a double can hold would be 0 (r > 1/4) or infinite (r < 1/4).
Result<void> derivatives(const SubdividedCurve& curve, double t, Index order, std::span<double> rows);

}  // namespace subdivd

#pragma once
// Subdivision of curves: refined points, their limits and tangents, for every scheme of CurveBasis.
//
// The curve's parameter t counts control points. Point j after l steps, h = 2^-l, stands at
//
//                primal (odd degree, four_point)    dual (even degree, corner_cutting)
//   periodic     j h                                (j + 1/2) h - 1/2
//   pinned       j h                                (j - 1/2) h; the first at 0, the last at N - 2
//   nonperiodic  j h + (lost - 1) / 2 (1 - h)       the same
//
// (lost: degree, 5 of four_point, 2 of corner_cutting),
// so that control point i of a pinned dual curve stands at i - 1/2 and of every other curve at i.
//
// A pinned curve keeps its end points; it is continued beyond them by central symmetry, c_{-k} = 2 c_0 - c_k
// (see the schemes), so that refining a refined curve is refining further. Of degree 3 it is exactly the
// border (or an infinitely sharp crease) of a Loop surface.

#include <span>
#include <string>
#include <vector>

#include "core/base/budget.h"
#include "core/base/buffer.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/curves/control_curve.h"

namespace subdivd {

inline constexpr Index kMaxCurveLevel = 24;

struct CurveOptions {
  Index level = 2;        // 0..kMaxCurveLevel
  bool limit = false;     // fill limit_points
  bool tangents = false;  // fill tangents
};

template <class Real>
struct RefinedCurves {
  std::string name;
  Index level = 0, width = 3;
  CurveWrap wrap = CurveWrap::pinned;
  std::vector<Index> vertex_counts;  // per curve
  Buffer<Real> points;               // width per point
  // On request, per point: where the curve is at the point's parameter, and its derivative by the parameter t
  // of the *control* curve, so that tangents do not shrink from level to level. What it means for
  // corner_cutting stands there. The outermost points of a nonperiodic curve (one at either end of degree 3,
  // floor(p/2) of degree p, 2 of four_point, 1 of corner_cutting) lie outside its domain: they are their own
  // limit. Where a neighbour for the tangent is missing it is the one-sided difference.
  Buffer<Real> limit_points;
  Buffer<Real> tangents;
  // As given, with what belongs to it; curves by pieces come back as Bezier curves (see piecewise.h), and
  // they and those on knots are not periodic any more.
  CurveBasis basis{};
};

// Points of all curves together after `level` steps, whatever their basis.
Count total_point_count(const ControlCurves& curves, Index level, const Pace& pace = {});

// Points of one curve of `points` control points after `level` steps; of `curves`, basis, degree and wrap
// count:
//   periodic N 2^l;  nonperiodic (N - q) 2^l + q, q the degree, 5 of four_point, 2 of corner_cutting;
//   pinned (N - e) 2^l + e, e = 1 of primal and 2 of dual schemes.
Count refined_point_count(const ControlCurves& curves, Count points, Index level);
// The same for cubics: pinned (N-1)2^l + 1, periodic N 2^l, nonperiodic (N-3)2^l + 3.
Count refined_point_count(CurveWrap wrap, Count points, Index level);

// The parameter t of point `point` after `level` steps, by the table above.
double point_parameter(const ControlCurves& curves, Count points, Index level, Count point);

// Bytes of all arrays of RefinedCurves<Real>; refuses levels over the maximum (out_of_range) and counts
// beyond 32 bits (too_large).
template <class Real>
Result<Count> predict_bytes(const ControlCurves& curves, const CurveOptions& options,
                            const Budget& budget = {});

// `curves` must have passed check(). Fails for sizes (as predict_bytes, and too_large against
// budget.max_bytes), when the budget says stop, and with out_of_range when a number does not fit into
// Real (1e39 in single precision; a tangent, or a point of a pinned curve's continuation, between -1e308 and
// 1e308): no NaN or infinity is ever returned. The answer depends on the arguments alone, to the bit.
// Takes about 150 KB beside the answer, or 2 KiB per unit of width when that is more.
template <class Real>
Result<RefinedCurves<Real>> refine(const ControlCurves& curves, const CurveOptions& options,
                                   const Budget& budget);

}  // namespace subdivd

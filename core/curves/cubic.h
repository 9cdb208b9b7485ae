#pragma once
// The uniform cubic B-spline curve: subdivision, limits, evaluation.  [LaneRiesenfeld80]
//
//   vertex point  c'_2i   = (c_{i-1} + 6 c_i + c_{i+1}) / 8
//   edge point    c'_2i+1 = (c_i + c_{i+1}) / 2
//   limit point            (c_{i-1} + 4 c_i + c_{i+1}) / 6
//   tangent                (c_{i+1} - c_{i-1}) / 2
//
// A pinned curve keeps its end points: a phantom point 2 c_0 - c_1 stands before the first, likewise at the
// end. It is exactly the border (or an infinitely sharp crease) of a Loop surface.

#include <span>
#include <string>
#include <vector>

#include "core/base/budget.h"
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
  std::vector<Real> points;          // width per point
  // On request, per point; the first and last point of a nonperiodic curve begin no segment: they are their
  // own limit, with the one-sided difference as tangent. Tangents are derivatives by the parameter t of the
  // *control* curve (see evaluate), so they do not shrink from level to level.
  std::vector<Real> limit_points;
  std::vector<Real> tangents;
};

// Points of one curve after `level` steps: pinned (N-1)2^l + 1, periodic N 2^l, nonperiodic (N-3)2^l + 3.
Count refined_point_count(CurveWrap wrap, Count points, Index level);
// Bytes of all arrays of RefinedCurves<Real>; refuses levels over the maximum (out_of_range) and counts
// beyond 32 bits (too_large).
template <class Real>
Result<Count> predict_bytes(const ControlCurves& curves, const CurveOptions& options);

// `curves` must have passed check(). Fails for sizes (as predict_bytes, and too_large against
// budget.max_bytes), when the budget is polled dry, and with out_of_range when a number does not fit into
// Real (1e39 in single precision; a tangent between -1e308 and 1e308): no NaN or infinity is ever returned.
// The answer depends on the arguments alone, to the bit.
template <class Real>
Result<RefinedCurves<Real>> refine(const ControlCurves& curves, const CurveOptions& options,
                                   const Budget& budget);

// Point and first derivative (per unit of t) of curve `curve` at parameter t, by the at most four basis
// functions that do not vanish there. Domain: pinned [0, N-1], periodic any t (period N), nonperiodic [1,
// N-2]; t counts control points, so t = i is the limit of c_i. `point` and `derivative` hold width scalars;
// derivative may be empty. Refuses a curve that does not exist, t outside the domain or not finite
// (out_of_range, not_finite), and results that Real cannot hold. `curves` must have passed check().
template <class Real>
Result<void> evaluate(const ControlCurves& curves, Index curve, double t, std::span<Real> point,
                      std::span<Real> derivative);

}  // namespace subdivd

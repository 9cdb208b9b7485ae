#pragma once
// The uniform cubic B-spline curve: subdivision, limits, evaluation.  [LaneRiesenfeld80]
//
//   vertex point  c'_2i   = (c_{i-1} + 6 c_i + c_{i+1}) / 8          edge point  c'_2i+1 = (c_i + c_{i+1}) /
//   2 limit         (c_{i-1} + 4 c_i + c_{i+1}) / 6                    tangent     (c_{i+1} - c_{i-1}) / 2
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
  std::vector<Real> limit_points;    // per point, on request. nonperiodic: the first and last point of a
  std::vector<Real> tangents;  //   curve support no segment; they are their own limit, tangent one-sided
};

// Points of one curve after `level` steps: pinned (N-1)2^l + 1, periodic N 2^l, nonperiodic (N-3)2^l + 3.
Count refined_point_count(CurveWrap wrap, Count points, Index level);
// Bytes of all arrays of RefinedCurves<Real>; refuses levels over the maximum and counts beyond 32 bits.
template <class Real>
Result<Count> predict_bytes(const ControlCurves& curves, const CurveOptions& options);

// `curves` must have passed check().
template <class Real>
Result<RefinedCurves<Real>> refine(const ControlCurves& curves, const CurveOptions& options,
                                   const Budget& budget);

// Point and first derivative (per unit of t) of curve `curve` at parameter t, by the at most four basis
// functions that do not vanish there. Domain: pinned [0, N-1], periodic any t (period N), nonperiodic [1,
// N-2]; t counts control points, so t = i is the limit of c_i. `point` and `derivative` hold width scalars;
// derivative may be empty. Refuses t outside the domain or not finite.
template <class Real>
Result<void> evaluate(const ControlCurves& curves, Index curve, double t, std::span<Real> point,
                      std::span<Real> derivative);

}  // namespace subdivd

#pragma once
// Cubic curves in Far, which knows surfaces only. Includes no OpenSubdiv.

#include <vector>

#include "core/base/budget.h"
#include "core/base/buffer.h"
#include "core/base/result.h"
#include "core/curves/control_curve.h"

namespace subdivd::oracle {

// Curves that are all pinned or all closed, with the limits of their points when they have been asked for.
struct FarCurves {
  bool closed = false;
  Index width = 3;
  std::vector<Index> counts;  // points per curve
  Buffer<double> points;      // every float is a double: nothing is lost on the way into the next level
  Buffer<double> limits;      // per point
};

// Bytes that far_refine_curves takes on the way to `level` (at most kMaxCurveLevel), roughly.
Count far_curve_bytes(const ControlCurves& curves, Index level);

// Whether Far would take the last step to `level` (at most kMaxCurveLevel): too_large for more working memory
// than budget.max_bytes (far_curve_bytes), or for a call of Far that would take too long (far_cost.h).
Result<void> check_far_curves(const ControlCurves& curves, Index level, const Budget& budget);

// Nonperiodic curves become pinned ones: they are the inner part of those.
FarCurves far_control(const ControlCurves& curves);

// One level more (or, with level 0, the same points and their limits), computed in Real. Level by level it
// reaches any depth at the cost of the last step, because a border's points depend on the border alone. Fails
// as far_refine.
template <class Real>
Result<FarCurves> far_refine_curves(const FarCurves& from, Index level, bool limit, const Budget& budget);

}  // namespace subdivd::oracle

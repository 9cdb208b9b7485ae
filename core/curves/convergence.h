#pragma once
// How fast the control polygon of a B-spline curve comes to the curve: measured distances, to stand beside
// the theory's 1/4 per step.
//
// The polygon P_l of level l has its points at their parameters (the table in subdivision.h) and is linear
// between them; C is the limit. P_l - C is a polynomial on each half of every interval between points, and a
// combination of second differences alone, which by themselves follow Lane and Riesenfeld's scheme of degree
// p - 2, divided by 4. So nothing cancels, however close the two have come.   [LaneRiesenfeld80]

#include <vector>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/curves/control_curve.h"

namespace subdivd {

struct Convergence {
  // distances[l] = max over the domain of |P_l(t) - C(t)|, l = 0..levels: to 1e-9 of itself, from below
  // (beyond the rounding of the control points' second differences).
  std::vector<double> distances;
  // ratios[l] = distances[l + 1] / distances[l]; 0 where the polygon is the curve already (degree 1; lines).
  std::vector<double> ratios;
};

// The most points that the last level may have: four million take seconds.
inline constexpr Count kMostConvergencePoints = Count{1} << 22;

// Of one curve of `curves`, which must have passed check(). Refuses more than kMostConvergencePoints points
// (too_large), other bases than bspline (unsupported), a
// curve that does not exist or more than kMaxCurveLevel levels (out_of_range), working memory (twice the
// points of the last level, in doubles; four times of pinned curves) over budget.max_bytes (too_large), and
// distances that outgrow a double. Polls the budget.
Result<Convergence> measure_convergence(const ControlCurves& curves, Index curve, Index levels,
                                        const Budget& budget);
// The same where its points begin with number `first`, which takes no walk over the curves before it.
Result<Convergence> measure_convergence(const ControlCurves& curves, Index curve, Count first, Index levels,
                                        const Budget& budget);

}  // namespace subdivd

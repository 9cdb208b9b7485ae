#pragma once
// More knots, the same curve.

#include <span>

#include "core/base/budget.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/splines/spline.h"

namespace subdivd {

// Inserts the knot t `times` times. The curve stays; points are convex combinations of the old ones.
// t within the domain; at most `degree` times in all inside it, degree + 1 at its ends (out_of_range).
//   [Boehm80; PieglTiller97, A5.1]
Result<Spline> insert_knot(const Spline& spline, double t, Index times);

// Inserts all of `knots` (ascending, each as often as it stands there) at once, in time linear in the points
// of the answer. Limits as above, the place of the first knot that breaks them being {i}.
//   [CohenLycheRiesenfeld80 (Oslo); PieglTiller97, A5.4]
Result<Spline> refine_knots(const Spline& spline, std::span<const double> knots, const Budget& budget);

// The curve with every span of its domain cut into 2^level equal ones: what refining means for a curve on
// knots. Halving again and again leads to the same knots. `level` is at most 32. out_of_range at
// {"knots", i} where two knots lie too close to be divided; too_large beyond 32-bit numbers of points or the
// budget's bytes.
Result<Spline> refine_spans(const Spline& spline, Index level, const Budget& budget);
// Its number of points: n + (spans that are not empty) (2^level - 1).
Count refined_point_count(const Spline& spline, Index level, const Pace& pace = {});

}  // namespace subdivd

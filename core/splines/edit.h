#pragma once
// Curves cut, put together, turned round and given other parameters.

#include <array>
#include <vector>

#include "core/base/budget.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/splines/spline.h"

namespace subdivd {

// The part over [from, to], its ends standing degree + 1 times among its knots: the curve starts and ends at
// its first and last point. from < to, both in the domain (out_of_range, at {"from"} or {"to"}).
Result<Spline> part(const Spline& spline, double from, double to, const Budget& budget = {});

// Before and behind t, strictly inside the domain (out_of_range).
Result<std::array<Spline, 2>> split(const Spline& spline, double t, const Budget& budget = {});

// First one, then the other, whose parameters are moved to follow. The lower degree is elevated; a curve that
// is not rational gets weights of 1, and the second's weights are scaled to meet the first's. The second must
// start where the first ends, within `gap` (>= 0; out_of_range otherwise, telling how far they are apart):
// the point in the middle joins them, so nothing moves further than gap / 2.
Result<Spline> join(const Spline& first, const Spline& second, double gap, const Budget& budget);

// The same in place, for many curves one after the other: takes time in proportion to the second as long as
// the first has its degree or a higher one. After a failure the first is good for nothing.
Result<void> append(Spline& first, const Spline& second, double gap, const Budget& budget);

// The same curve run through backwards: the point at t is now at begin() + end() - t.
// Throws Stopped when the pace has no more to spend.
Spline reverse(const Spline& spline, const Pace& pace = {});

// The same curve over [begin, end], by t -> begin + (t - old begin) * (end - begin) / (old end - old begin).
// Both finite, begin < end, their distance finite (out_of_range).
Result<Spline> reparametrize(const Spline& spline, double begin, double end, const Budget& budget = {});

}  // namespace subdivd

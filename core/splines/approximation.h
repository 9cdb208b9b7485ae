#pragma once
// The tolerance that rounding needs, and curves joined into one with a bound for the whole.

#include <optional>

#include "core/base/budget.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/splines/knot_removal.h"

namespace subdivd {

// What rounding alone may move points by, with room to spare: for callers that name no tolerance.
// With a pace, throws Stopped.
double rounding_tolerance(const Spline& spline, const Pace& pace = {});

struct JoinedCurve {
  std::optional<Approximation> whole;  // of those appended so far; `bound` holds for every part
  double tolerance = 0;                // the largest of theirs
  double part_bound = 0;               // the largest bound of a part as it was appended
};

// Puts `next` behind the others. It must start where they end, within the larger one of both tolerances: the
// point in the middle joins them, so that both ends move by half of it at most. Fails as append() of
// splines (edit.h), after which `joined` is good for nothing.
Result<void> append(JoinedCurve& joined, Approximation next, double tolerance, const Budget& budget);

}  // namespace subdivd

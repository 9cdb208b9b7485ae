#include "core/splines/approximation.h"

#include <algorithm>
#include <utility>

#include "core/splines/edit.h"

namespace subdivd {

double rounding_tolerance(const Spline& spline, const Pace& pace) { return 1e-10 * extent(spline, pace); }

Result<void> append(JoinedCurve& joined, Approximation next, double tolerance, const Budget& budget) {
  if (!joined.whole) {
    joined.whole = std::move(next);
    joined.tolerance = tolerance;
    return {};
  }
  const double gap = std::max(joined.tolerance, tolerance);
  if (auto done = append(joined.whole->spline, next.spline, gap, budget); !done) return done;
  joined.whole->bound = std::max(joined.whole->bound, next.bound + gap / 2);
  joined.tolerance = gap;
  return {};
}

}  // namespace subdivd

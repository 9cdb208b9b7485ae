#include "core/splines/approximation.h"

#include <algorithm>
#include <utility>

#include "core/splines/edit.h"

namespace subdivd {

double rounding_tolerance(const Spline& spline, const Pace& pace) { return 1e-10 * extent(spline, pace); }

Result<void> append(JoinedCurve& joined, Approximation next, double tolerance, const Budget& budget) {
  if (!joined.whole) {
    joined.part_bound = next.bound;
    joined.whole = std::move(next);
    joined.tolerance = tolerance;
    return {};
  }
  const double gap = std::max(joined.tolerance, tolerance);
  if (auto done = append(joined.whole->spline, next.spline, gap, budget); !done) return done;
  // Ends of any part may have been moved, and no gap is larger than the last.
  joined.part_bound = std::max(joined.part_bound, next.bound);
  joined.whole->bound = joined.part_bound + gap / 2;
  joined.tolerance = gap;
  return {};
}

}  // namespace subdivd

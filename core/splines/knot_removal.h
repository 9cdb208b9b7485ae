#pragma once
// Fewer knots, the same curve or one near to it, with a bound that is proven.

#include <span>

#include "core/base/budget.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/splines/spline.h"

namespace subdivd {

// Parameter by parameter the curves stay within `bound` of one another.
struct Approximation {
  Spline spline;
  double bound = 0;
};

// How far two splines over the same knots can be apart at any parameter: points of a curve are convex
// combinations of its control points, so it is the largest distance of control points; of rational ones
// |A/w - B/v| = |(A - B) - (B/v)(w - v)| / w <= (max |A_i - B_i| + max |B_i/v_i| max |w_i - v_i|) / min w_i.
// Rounding of the comparison itself is not counted.
// With a pace, throws Stopped.
double distance_bound(const Spline& a, const Spline& b, const Pace& pace = {});

struct Removal {
  Approximation result;
  Index times = 0;  // how often the knot was removed
};

// Removes the knot t from the domain's inside up to `times` times, while the curve stays within `tolerance`
// (>= 0, an absolute distance) of the given one, by the bound. The given curve is never replaced by one that
// is further away. out_of_range when t is no knot inside the domain or the tolerance is below 0 or no number.
//   [Tiller92; by least squares, and with the bound measured instead of estimated]
Result<Removal> remove_knot(const Spline& spline, double t, Index times, double tolerance,
                            const Budget& budget = {});

struct KnotRemovals {
  Approximation result;
  Count removed = 0;
};

// Removes each of `knots` once, one after the other in their order, as remove_knot() would, the bounds of all
// removals together within `tolerance`: a knot that would cost more stays, and one that has been removed as
// often as it stood there is passed over. Time by the number of knots and by that of the curve's, not by
// their product. Fails as remove_knot(), a knot's place being {i}.
Result<KnotRemovals> remove_knots(const Spline& spline, std::span<const double> knots, double tolerance,
                                  const Budget& budget);

// Removes knots inside the domain until none is left that could be, the bounds of all removals together
// within `tolerance`. The cheapest go first: in rounds whose allowed cost of a removal grows up to `tolerance`, and
// of two neighbours only one in a round. Every pass over the curve is linear and polled.
Result<KnotRemovals> remove_knots(const Spline& spline, double tolerance, const Budget& budget);

}  // namespace subdivd

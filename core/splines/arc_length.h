#pragma once
// The length of a curve with a bound of its error that holds, and the way back from lengths to parameters.
//
// Every Bezier piece gets two intervals that contain its length, of which the intersection counts:
//
//   |mean N_i| / max w^2  <=  L  <=  mean |N_i| / min w^2      N_i: control vectors of C' w^2
//       (of a polynomial piece: the chord and the control polygon)                    [Gravesen97]
//   |L - Gauss_m| <= 4 M rho^-(2m-1) / (rho - 1)               where |C'| is analytic and at most M in the
//       ellipse with foci at the piece's ends and axes that sum to rho lengths [Trefethen13, 8.2, 19.3]
//
// The second is what makes it fast: it holds where the control points of |C'|^2 w^4 are above 0, and a few
// halvings do for any smooth curve. At cusps and stops, where it never holds, the first one closes in
// geometrically. Pieces with the widest intervals are halved until the sum of half widths, rounding included,
// is small enough.

#include <span>
#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/splines/spline.h"

namespace subdivd {

struct LengthOptions {
  double tolerance = 1e-9;      // of the length: error_bound <= tolerance * length; finite, above 0
  Count max_pieces = 1u << 18;  // at least the number of spans
};

struct ArcLength {
  double length = 0;
  double error_bound = 0;  // the length of the exact curve lies within length +- error_bound
  Count pieces = 0;        // that the interval has been cut into
};

// Length of the curve over [a, b], begin() <= a <= b <= end(). `spline` must have passed check().
// Fails with out_of_range (at "from", "to", "tolerance": the tolerance is below what rounding allows, the
// message says what was reached), with too_large when max_pieces do not suffice (the message says the same;
// no bound is returned that was not reached), as to_local_coordinates() does, and as the budget says.
Result<ArcLength> arc_length(const Spline& spline, double a, double b, const LengthOptions& options,
                             const Budget& budget);
// Over the whole domain.
Result<ArcLength> arc_length(const Spline& spline, const LengthOptions& options, const Budget& budget);

// A tolerance for positions on a curve, so that their distances along it differ by less than 1e-9 of it.
inline constexpr LengthOptions kPositionOptions{1e-10, 1u << 18};

// The parameter up to which the curve, from its begin, is `length` long. 0 <= length <= the curve's length
// (as much over as the error bound is taken for the whole). The length up to the answer is right to
// `tolerance` times the length of the whole, as far as the parameter's own last bit allows; where the curve
// stops, the answer is where it arrives. Fails as arc_length() does and with out_of_range or not_finite at
// "length".
Result<double> parameter_at_length(const Spline& spline, double length, const LengthOptions& options,
                                   const Budget& budget);

// `count` ascending parameters whose points are equally far apart along the curve: of an open curve the first
// is begin() and the last end() (count >= 2), of a periodic one the last is one step before end(), where
// begin() comes again (count >= 1). A curve that is closed without being periodic counts as open. Accuracy as
// above; of a curve of length 0 the parameters are equally far apart themselves.
// Fails as arc_length() does, with out_of_range at "count", and with too_large as the budget says.
Result<std::vector<double>> equal_parameters(const Spline& spline, Count count, const LengthOptions& options,
                                             const Budget& budget);

}  // namespace subdivd

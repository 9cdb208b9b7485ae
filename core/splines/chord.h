#pragma once
// What making polylines shares: how far a point is from a chord, and how a polyline is refused.

#include <span>

#include "core/base/result.h"
#include "core/splines/flatten.h"

namespace subdivd {

// Squared distance of `point` from the segment between a and b.
double square_from_segment(std::span<const double> point, std::span<const double> a,
                           std::span<const double> b);

// At "tolerance": not a finite number above 0.
Result<void> check_tolerance(const FlattenOptions& options);
// Less than `least`, which rounding allows.
Error too_fine(const FlattenOptions& options, double least);
// `predicted` points at least.
Error too_many_corners(Count predicted, Count allowed);

}  // namespace subdivd

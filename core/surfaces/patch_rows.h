#pragma once
// The loops of B-spline surfaces, a row of points at a time and flat over its scalars. Inside core/surfaces
// only.

#include <span>

#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/surfaces/patch_rules.h"

namespace subdivd {

// Three rows of a grid, `row_size` scalars each, into one: `taps` along v. `out` overlaps none of them.
template <class Real>
void combine_rows(const Real* grid, Count row_size, const Taps& taps, Real* out, const Pace& pace);

// The row of the next level: step_taps() for every point of it. `row`: d.n points of `width` scalars.
template <class Real>
void split_row(const Direction& d, const Real* row, Index width, Real* out, const Pace& pace);

// As many points as the row has, each by the taps that `rule` says for it, times `scale`. Rules have the
// same weights two points away from the ends, on the points before, behind and at the place.
using RowRule = Taps (*)(const Direction& d, Count i);
template <class Real>
void combine_along(const Direction& d, const Real* row, Index width, RowRule rule, Real scale, Real* out,
                   const Pace& pace);

// out_of_range at the first number that is not finite.
template <class Real>
Result<void> check_finite(std::span<const Real> values, const Pace& pace);

}  // namespace subdivd

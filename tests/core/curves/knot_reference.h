#pragma once
// The slow, plain witness: a B-spline curve as the sum of *all* its basis functions, each by the recurrence
// of Cox and de Boor on an explicit knot vector. Nothing here knows of subdivision or of localized weights.

#include <vector>

#include "core/curves/control_curve.h"

namespace subdivd::testing {

// Position of the one curve in `curves` at t (domain as in evaluate). Pinned curves get their phantom points,
// periodic ones their wrapped points, as explicit control points.
std::vector<double> all_basis_point(const ControlCurves& curves, double t);

}  // namespace subdivd::testing

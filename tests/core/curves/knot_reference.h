#pragma once
// Slow, plain witnesses. A B-spline curve as the sum of *all* its basis functions, each by the recurrence of
// Cox and de Boor on an explicit knot vector, in long double: nothing there knows of subdivision or of
// localized weights. And subdivision level by level, point by point, from the masks as printed, in blocks of
// nothing.

#include <vector>

#include "core/curves/control_curve.h"

namespace subdivd::testing {

// Position of the one B-spline curve in `curves` at t (domain as the table of subdivision.h says), and its
// derivative (at a knot from the right). Pinned curves get their phantom points, periodic ones their wrapped
// points, as explicit control points.
std::vector<double> all_basis_point(const ControlCurves& curves, double t);
std::vector<double> all_basis_slope(const ControlCurves& curves, double t);

// Scalar k of control point i, which may lie beyond the ends: wrapped, or mirrored at one end after the
// other. For a pinned dual curve i counts the points that are not ends.
double continued(const ControlCurves& curves, int i, Index k);

// The points of the one curve after one step, any basis, in the order of operations that the schemes
// document.
std::vector<double> plain_step(const ControlCurves& curves);

}  // namespace subdivd::testing

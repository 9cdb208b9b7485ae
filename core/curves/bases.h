#pragma once
// Curves in the bases that people draw them in, as splines, and back where a spline can be written so.
//
// Every basis but B-splines of other degrees is cubic. Parameters: t = i at point i (B-splines, Catmull-Rom)
// or at the start of segment i (Bezier, Hermite); a segment is one long.
//
//   bspline      uniform, any degree; c_i weighs most at t = i
//   bezier       3 k + 1 points, or 3 k of a closed curve: every third one is on the curve
//   catmull_rom  through its points; tangents from the neighbours   [CatmullRom74]
//   hermite      point, tangent, point, tangent, ...: 2 (k + 1) of them, or 2 k of a closed curve

#include <span>
#include <vector>

#include "core/base/budget.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/curves/control_curve.h"
#include "core/splines/spline.h"

namespace subdivd {

// `points`: width scalars each, as many as the basis and the wrap need (assumed). With a pace, these throw
// Stopped when it has no more to spend.
//
// Uniform B-splines: the domain is that of core/curves/control_curve.h. Pinned ones of odd degree have the
// phantom points 2 c_0 - c_k, of even degree c_0 stands on the border: there d_{-1-k} = 2 c_0 - d_k, where
// d_j = c_{j+1}; their ends stand degree + 1 times among the knots, so that the curve starts and ends at its
// first and last point to the bit.
Spline spline_of_bspline(std::span<const double> points, Index width, CurveWrap wrap, Index degree,
                         const Pace& pace = {});
Spline spline_of_bezier(std::span<const double> points, Index width, CurveWrap wrap, const Pace& pace = {});
// Pinned: phantom points 2 c_0 - c_1 before the first and behind the last. Points that coincide have no
// direction between them: the tangent is the other neighbour's.
Spline spline_of_catmull_rom(std::span<const double> points, Index width, CurveWrap wrap, Spacing spacing,
                             const Pace& pace = {});
Spline spline_of_hermite(std::span<const double> points, Index width, CurveWrap wrap, const Pace& pace = {});

// The curve in another basis, wrap nonperiodic, each span of the spline a segment of length 1: the points of
// the curve are the same, its parameters those of the basis. unsupported where there is no such curve: a
// rational one, one of a degree above 3; a uniform B-spline, Catmull-Rom or Hermite curve when the pieces do
// not meet as theirs do within `tolerance` (an absolute distance), telling how far they are from it.
Result<std::vector<double>> bezier_points(const Spline& spline, const Budget& budget);
Result<std::vector<double>> bspline_points(const Spline& spline, double tolerance, const Budget& budget);
Result<std::vector<double>> catmull_rom_points(const Spline& spline, double tolerance, const Budget& budget);
Result<std::vector<double>> hermite_points(const Spline& spline, double tolerance, const Budget& budget);

}  // namespace subdivd

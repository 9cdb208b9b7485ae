#pragma once
// Control curves as splines: those that are given by pieces (Bezier, Catmull-Rom, Hermite) or on knots
// (NURBS) are nothing else, and uniform B-splines can be written so. Refining such a curve cuts every span
// into equal ones: de Casteljau's and Boehm's algorithm instead of a scheme's masks.

#include <span>
#include <vector>

#include "core/base/budget.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/curves/control_curve.h"
#include "core/curves/subdivision.h"
#include "core/splines/spline.h"

namespace subdivd {

// Where the points and the knots of a curve begin in the arrays of all.
struct CurvePlace {
  Count points = 0, knots = 0;
};
// The place behind curve number `curve`, which is at `place`: that of the next.
CurvePlace next_place(const ControlCurves& curves, Count curve, CurvePlace place);
// Of every curve. With a pace, throws Stopped.
std::vector<CurvePlace> curve_places(const ControlCurves& curves, const Pace& pace = {});

// Curve number `curve`, which is at `place`; `curves` must have passed check(). unsupported: a four-point
// curve, or corner cutting at another ratio than 1/4, has no polynomial pieces.
Result<Spline> spline_of(const ControlCurves& curves, Count curve, CurvePlace place,
                         const Budget& budget = {});

// What spline_of() makes of a curve is so large; without making it. Of four-point curves, and of corner
// cutting, as if the ratio were 1/4. With a pace, throws Stopped.
struct SplineSize {
  Index degree = 3;
  Count points = 0;
  Count spans = 0;  // that are not empty
};
SplineSize spline_size(const ControlCurves& curves, Count curve, CurvePlace place, const Pace& pace = {});

// Bytes while spline_of() makes a curve, and while that is brought into coordinates of its own: copies of its
// points and knots, which grow. Curves that are closed or start at their first point get up to a degree more
// of points.
Count spline_bytes(const ControlCurves& curves, Count curve);

// The part of check() for bases that are given by pieces or on knots. Places as the JSON names them: points
// and curveVertexCounts, order, knots, ranges, pointWeights with the index in the whole array.
Result<void> check_piecewise(const ControlCurves& curves, const Budget& budget = {});

// Points of all curves after `level` steps: of a chain of s segments 3 s 2^l + 1, on knots n + s (2^l - 1) of
// s spans.
// With a pace, throws Stopped.
Count refined_piecewise_count(const ControlCurves& curves, Index level, const Pace& pace = {});

// As refine() does (subdivision.h), in doubles. Pieces of every basis come back as Bezier curves, closed ones
// open and ending where they begin. Limits stand at the mean of the knots that a control point feels
// (Greville's abscissae), or at the same share of their segment.
struct RefinedPiecewise {
  CurveBasis basis = Bezier{};  // or Nurbs
  std::vector<Index> vertex_counts;
  std::vector<double> points, limit_points, tangents;
};
Result<RefinedPiecewise> refine_piecewise(const ControlCurves& curves, const CurveOptions& options,
                                          const Budget& budget);

}  // namespace subdivd

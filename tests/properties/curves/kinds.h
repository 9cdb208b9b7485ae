#pragma once
// Every kind of curve that can be refined: all bases with several of their parameters, in every wrap. What
// stands in the list is held to every property of this folder.

#include <gtest/gtest.h>

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/curves/subdivision.h"
#include "core/splines/spline.h"

namespace subdivd::testing {

struct CurveKind {
  std::string name;    // of a test: bspline_3_pinned
  ControlCurves rule;  // without points
  // On knots: the ends stand degree + 1 times; no weights are given.
  bool clamped = false, rational = false;
};
std::vector<CurveKind> all_curve_kinds();
std::ostream& operator<<(std::ostream& out, const CurveKind& kind);
inline std::string name_of(const ::testing::TestParamInfo<CurveKind>& tested) { return tested.param.name; }

// Coordinates in [-1, 1), weights in [1/2, 2). `more`: points than it needs (subdivision, Catmull-Rom),
// segments but one (Bezier, Hermite), knots inside the domain, of every multiplicity.
ControlCurves random_curve(const CurveKind& kind, Count more, Index width, std::uint64_t seed = 1);
// One body of both, which are of the same kind.
ControlCurves together(const ControlCurves& one, const ControlCurves& two);

// What refine() gives, with plain vectors. Bezier, Hermite and Catmull-Rom curves come back as Bezier curves.
struct Answer {
  ControlCurves curves;  // that may be refined further
  std::vector<double> limits, tangents;
  const std::vector<double>& points() const { return curves.points; }
};
// Fails the test, and is empty, when refine() fails.
Answer refined(const ControlCurves& curves, Index level);

// Of one curve. The parameters of the refined points, by the tables of subdivision.h and piecewise.h.
std::vector<double> parameters(const ControlCurves& curves, Index level, const Answer& fine);
// Refined points first, ..., last - 1 are no others than they must be: the outermost ones of nonperiodic
// schemes lack neighbours.
struct Inside {
  Count first = 0, last = 0;
};
Inside inside(const ControlCurves& curves, Count points);
// The curve by formula; none of four_point, and of corner_cutting at 1/4 alone.
std::optional<Spline> formula_of(const ControlCurves& curves);

// Same segments, run through backwards; closed curves from the same point on.
ControlCurves reverse(const ControlCurves& curves);
// Coordinate k alone.
ControlCurves coordinate(const ControlCurves& curves, Index k);
// Tangents are made from distances, which all coordinates have a part in.
inline bool measures_distances(const ControlCurves& curves) {
  const CatmullRom* kind = std::get_if<CatmullRom>(&curves.basis);
  return kind != nullptr && kind->spacing != Spacing::uniform;
}

}  // namespace subdivd::testing

#include <variant>

#include "core/base/overloaded.h"
#include "core/base/pace.h"
#include "core/curves/piecewise.h"

namespace subdivd {

Count Bezier::segments(Count points, CurveWrap) const { return points / 3; }

Count CatmullRom::segments(Count points, CurveWrap wrap) const {
  if (wrap == CurveWrap::periodic) return points;
  return points - (wrap == CurveWrap::pinned ? 1 : 3);
}

Count Hermite::segments(Count points, CurveWrap wrap) const {
  return points / 2 - (wrap == CurveWrap::periodic ? 0 : 1);
}

namespace {

SplineSize size_of_pieces(Count segments) { return {3, 3 * segments + 1, segments}; }

// As spline_of_bspline() makes it.
SplineSize size_of_uniform(CurveWrap wrap, Count points, Index degree) {
  switch (wrap) {
    case CurveWrap::nonperiodic:
      return {degree, points, points - degree};
    case CurveWrap::periodic:
      return {degree, points + degree, points};
    case CurveWrap::pinned:
      break;
  }
  const Count spans = points - (degree % 2 == 1 ? 1 : 2);
  return {degree, spans + degree, spans};
}

// On knots the knots tell, without a copy of the points.
SplineSize size_on_knots(const Nurbs& nurbs, Count count, Count curve, CurvePlace place, const Pace& pace) {
  const Index order = nurbs.order_of(curve);
  const std::span<const double> knots = std::span(nurbs.knots).subspan(place.knots, count + order);
  double from = knots[order - 1], to = knots[count];
  const bool whole =
      nurbs.ranges.empty() || (nurbs.ranges[2 * curve] == from && nurbs.ranges[2 * curve + 1] == to);
  if (!whole) from = nurbs.ranges[2 * curve], to = nurbs.ranges[2 * curve + 1];
  Count inside = 0, breaks = 0;  // knots inside the range; different ones
  pace.for_each(knots.size(), [&](Count k) {
    if (!(knots[k] > from && knots[k] < to)) return;
    ++inside;
    breaks += knots[k] < knots[k + 1];
  });
  return {order - 1, whole ? count : inside + order, breaks + 1};
}

}  // namespace

SplineSize spline_size(const ControlCurves& curves, Count curve, CurvePlace place, const Pace& pace) {
  const Count count = curves.points_of_curve(curve);
  const CurveWrap wrap = curves.wrap;
  return std::visit(
      Overloaded{
          [&](const UniformBSpline& kind) { return size_of_uniform(wrap, count, kind.degree); },
          [&](const FourPoint&) { return size_of_uniform(wrap, count, 2); },
          [&](const CornerCutting&) { return size_of_uniform(wrap, count, 2); },
          [&](const PiecewiseKind auto& kind) { return size_of_pieces(kind.segments(count, wrap)); },
          [&](const Nurbs& nurbs) { return size_on_knots(nurbs, count, curve, place, pace); },
      },
      curves.basis);
}

Count spline_bytes(const ControlCurves& curves, Count curve) {
  constexpr Count kCopies = 10;
  const Count degree =
      std::visit(Overloaded{[](const UniformBSpline& kind) { return Count{kind.degree}; },
                            [](const FourPoint&) { return Count{3}; },      // it has none
                            [](const CornerCutting&) { return Count{3}; },  // 2, and room to spare
                            [](const PiecewiseKind auto&) { return Count{3}; },
                            [&](const Nurbs& nurbs) { return nurbs.order_of(curve) - Count{1}; }},
                 curves.basis);
  const Count points = curves.points_of_curve(curve) + 2 * (degree + 1);
  const bool by_pieces = family_of(curves.basis) == CurveFamily::pieces;
  const Count numbers = points * (Count{curves.width} + 2) * (by_pieces ? 3 : 1);
  return numbers * kCopies * sizeof(double);
}

Count refined_piecewise_count(const ControlCurves& curves, Index level, const Pace& pace) {
  const Count parts = Count{1} << level;
  const bool on_knots = family_of(curves.basis) == CurveFamily::on_knots;
  Count total = 0;
  CurvePlace place;
  for (Count c = 0; c < curves.curve_count(); place = next_place(curves, c, place), ++c) {
    pace.spend(1);
    const SplineSize size = spline_size(curves, c, place, pace);
    total += on_knots ? size.points + size.spans * (parts - 1) : 3 * size.spans * parts + 1;
  }
  return total;
}

}  // namespace subdivd

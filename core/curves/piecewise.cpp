#include "core/curves/piecewise.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "core/base/all_finite.h"
#include "core/base/pace.h"
#include "core/base/precision.h"
#include "core/curves/bases.h"
#include "core/splines/edit.h"

namespace subdivd {
namespace {

Error fault(ErrorCode code, std::string message, Path where) {
  return Error{code, std::move(message), std::move(where)};
}

Index order_of(const ControlCurves& curves, Count curve) {
  return curves.orders.size() == 1 ? curves.orders[0] : curves.orders[curve];
}

std::span<const double> points_at(const ControlCurves& curves, Count curve, Count first) {
  return std::span(curves.points).subspan(first * curves.width, curves.points_of_curve(curve) * curves.width);
}

// The whole of curve `curve` on its knots, unchecked.
Spline spline_on_knots(const ControlCurves& curves, Count curve, CurvePlace place, const Pace& pace) {
  const Count count = curves.points_of_curve(curve);
  const std::span<const double> points = points_at(curves, curve, place.points);
  Spline spline{order_of(curves, curve) - 1, curves.width, false, false, {}, {}};
  pace.copy(std::span(curves.knots).subspan(place.knots, count + order_of(curves, curve)), spline.knots);
  if (curves.weights.empty()) {
    pace.copy(points, spline.points);
    return spline;
  }
  spline.points =
      homogeneous(points, curves.width, std::span(curves.weights).subspan(place.points, count), pace);
  spline.rational = true;
  ++spline.width;
  return spline;
}

// --- Checks -----------------------------------------------------------------------------------------------

// How the points of a curve must be counted.
Result<void> check_count(const ControlCurves& curves, Count count, const Path& where) {
  const bool closed = curves.wrap == CurveWrap::periodic;
  const auto refuse = [&](ErrorCode code, const char* rule) {
    return Result<void>(fault(code, std::string(rule) + "; this one has " + std::to_string(count), where));
  };
  switch (curves.basis) {
    case CurveBasis::bezier:
      if (closed && (count < 3 || count % 3 != 0))
        return refuse(count < 3 ? ErrorCode::too_few_points : ErrorCode::wrong_length,
                      "a closed Bezier curve of k segments has 3 k points");
      if (!closed && (count < 4 || count % 3 != 1))
        return refuse(count < 4 ? ErrorCode::too_few_points : ErrorCode::wrong_length,
                      "a Bezier curve of k segments has 3 k + 1 points");
      return {};
    case CurveBasis::hermite:
      if (count < 4 || count % 2 != 0)
        return refuse(count < 4 ? ErrorCode::too_few_points : ErrorCode::wrong_length,
                      "a Hermite curve has a tangent behind every point, and at least two of both");
      return {};
    case CurveBasis::catmull_rom:
      if (closed && count < 3)
        return refuse(ErrorCode::too_few_points, "a closed Catmull-Rom curve needs at least 3 points");
      if (curves.wrap == CurveWrap::pinned && count < 2)
        return refuse(ErrorCode::too_few_points, "a pinned Catmull-Rom curve needs at least 2 points");
      if (curves.wrap == CurveWrap::nonperiodic && count < 4)
        return refuse(ErrorCode::too_few_points, "a nonperiodic Catmull-Rom curve needs at least 4 points");
      return {};
    default:
      return {};
  }
}

// All lengths that must agree before any curve can be looked at.
Result<void> check_lengths(const ControlCurves& curves, const Pace& pace) {
  const Count count = curves.curve_count();
  if (curves.orders.size() != 1 && curves.orders.size() != count)
    return fault(ErrorCode::wrong_length,
                 "there are " + std::to_string(curves.orders.size()) +
                     " orders; one for all curves or one for each of " + std::to_string(count) + " is needed",
                 {"order"});
  Count knots = 0;
  for (Count c = 0; c < count; ++c) {
    pace.spend(1);
    const Index order = order_of(curves, c);
    if (order < 2 || order > kMaxDegree + 1)
      return fault(ErrorCode::out_of_range,
                   "the order is " + std::to_string(order) + "; it is the degree and one more, 2 to " +
                       std::to_string(kMaxDegree + 1),
                   curves.orders.size() == 1 ? Path{"order"} : Path{"order", std::uint64_t{c}});
    knots += curves.points_of_curve(c) + order;
  }
  if (knots != curves.knots.size())
    return fault(ErrorCode::wrong_length,
                 "there are " + std::to_string(curves.knots.size()) +
                     " knots; points and order of every curve together make " + std::to_string(knots),
                 {"knots"});
  if (!curves.weights.empty() && curves.weights.size() != curves.point_count())
    return fault(ErrorCode::wrong_length,
                 "there are " + std::to_string(curves.weights.size()) + " weights for " +
                     std::to_string(curves.point_count()) + " points",
                 {"pointWeights"});
  if (!curves.ranges.empty() && curves.ranges.size() != 2 * count)
    return fault(ErrorCode::wrong_length, "every curve has one range of two parameters", {"ranges"});
  return {};
}

// A place in one curve as one in the arrays of all.
Path shifted(Path where, const ControlCurves& curves, Count curve, CurvePlace place) {
  if (where.empty()) return {"curveVertexCounts"};
  const std::string field = std::get<std::string>(where[0]);
  if (where.size() == 1) {
    if (field == "degree") return {"order"};
    return field == "points" && !curves.vertex_counts.empty()
               ? Path{"curveVertexCounts", std::uint64_t{curve}}
               : where;
  }
  std::uint64_t& index = std::get<std::uint64_t>(where[1]);
  if (field == "knots") index += place.knots;
  if (field == "pointWeights") index += place.points;
  if (field == "points") {
    // Stored points have their weights among them.
    if (!curves.weights.empty()) {
      const std::uint64_t stored = curves.width + std::uint64_t{1};
      index = index / stored * curves.width + std::min<std::uint64_t>(index % stored, curves.width - 1);
    }
    index += place.points * curves.width;
  }
  return where;
}

Result<void> check_weights(const ControlCurves& curves, const Pace& pace) {
  for (Count i = 0; i < curves.weights.size(); ++i) {
    pace.spend(1);
    const double weight = curves.weights[i];
    if (weight > 0 && std::isfinite(weight)) continue;
    return fault(std::isfinite(weight) ? ErrorCode::out_of_range : ErrorCode::not_finite,
                 "weight " + std::to_string(i) + " is " + std::to_string(weight) +
                     "; weights are finite numbers above 0",
                 {"pointWeights", std::uint64_t{i}});
  }
  return {};
}

// Bytes of the largest curve as a spline of its own.
Count largest_spline(const ControlCurves& curves, const Pace& pace) {
  Count most = 0;
  pace.for_each(curves.curve_count(), [&](Count c) { most = std::max(most, curves.points_of_curve(c)); });
  return (most * (Count{curves.width} + 2) + kMaxDegree + 1) * sizeof(double);
}

Result<void> check_on_knots(const ControlCurves& curves, const Budget& budget, const Pace& pace) {
  if (auto fine = check_lengths(curves, pace); !fine) return fine;
  if (auto fine = check_weights(curves, pace); !fine) return fine;
  if (auto taken = budget.take_memory(largest_spline(curves, pace)); !taken) return taken;
  CurvePlace place;
  for (Count c = 0; c < curves.curve_count(); ++c) {
    pace.spend(1);
    const Spline spline = spline_on_knots(curves, c, place, pace);
    if (auto fine = spline.check(budget); !fine) {
      if (!is_stop(fine.error()))
        fine.error().where = shifted(std::move(fine.error().where), curves, c, place);
      return fine;
    }
    if (!curves.ranges.empty()) {
      const double from = curves.ranges[2 * c], to = curves.ranges[2 * c + 1];
      if (!(from >= spline.begin() && from < to && to <= spline.end()))
        return fault(ErrorCode::out_of_range,
                     "the range must ascend within the domain, " + std::to_string(spline.begin()) + " to " +
                         std::to_string(spline.end()),
                     {"ranges", std::uint64_t{c}});
    }
    place = next_place(curves, c, place);
  }
  return {};
}

}  // namespace

CurvePlace next_place(const ControlCurves& curves, Count curve, CurvePlace place) {
  const Count points = curves.points_of_curve(curve);
  const Count knots = curves.basis == CurveBasis::nurbs ? points + order_of(curves, curve) : 0;
  return {place.points + points, place.knots + knots};
}

std::vector<CurvePlace> curve_places(const ControlCurves& curves, const Pace& pace) {
  std::vector<CurvePlace> places;
  places.reserve(curves.curve_count());
  CurvePlace place;
  pace.for_each(curves.curve_count(), [&](Count c) {
    places.push_back(place);
    place = next_place(curves, c, place);
  });
  return places;
}

Result<void> check_piecewise(const ControlCurves& curves, const Budget& budget) {
  const bool many = !curves.vertex_counts.empty();
  Count taken = 0;
  auto counted = stoppable(budget, [&](const Pace& pace) -> Result<void> {
    for (Count c = 0; c < curves.curve_count(); ++c) {
      pace.spend(1);
      const Path where = many ? Path{"curveVertexCounts", std::uint64_t{c}} : Path{"points"};
      if (auto fine = check_count(curves, curves.points_of_curve(c), where); !fine) return fine;
      taken += curves.points_of_curve(c);
    }
    return {};
  });
  if (!counted) return counted;
  if (taken != curves.point_count())
    return fault(ErrorCode::wrong_length,
                 "the counts of curveVertexCounts add up to " + std::to_string(taken) + "; there are " +
                     std::to_string(curves.point_count()) + " points",
                 {"curveVertexCounts"});
  if (curves.basis != CurveBasis::nurbs) return {};
  return stoppable(budget, [&](const Pace& pace) { return check_on_knots(curves, budget, pace); });
}

namespace {

Result<Spline> made_of(const ControlCurves& curves, Count curve, CurvePlace place, const Pace& pace) {
  const std::span<const double> points = points_at(curves, curve, place.points);
  switch (curves.basis) {
    case CurveBasis::bspline:
      return spline_of_bspline(points, curves.width, curves.wrap, curves.degree, pace);
    case CurveBasis::corner_cutting:
      if (curves.ratio == 0.25) return spline_of_bspline(points, curves.width, curves.wrap, 2, pace);
      return fault(ErrorCode::unsupported,
                   "corner cutting at another ratio than 1/4 makes a curve without a formula", {"ratio"});
    case CurveBasis::four_point:
      return fault(ErrorCode::unsupported, "a four-point curve has no formula; it can be refined only",
                   {"basis"});
    case CurveBasis::bezier:
      return spline_of_bezier(points, curves.width, curves.wrap, pace);
    case CurveBasis::catmull_rom:
      return spline_of_catmull_rom(points, curves.width, curves.wrap, curves.spacing, pace);
    case CurveBasis::hermite:
      return spline_of_hermite(points, curves.width, curves.wrap, pace);
    case CurveBasis::nurbs:
      break;
  }
  Spline spline = spline_on_knots(curves, curve, place, pace);
  if (curves.ranges.empty()) return spline;
  const double from = curves.ranges[2 * curve], to = curves.ranges[2 * curve + 1];
  if (from == spline.begin() && to == spline.end()) return spline;
  return part(spline, from, to, pace.budget());
}

}  // namespace

Result<Spline> spline_of(const ControlCurves& curves, Count curve, CurvePlace place, const Budget& budget) {
  assert(curve < curves.curve_count());
  return stoppable(budget, [&](const Pace& pace) {
    auto spline = made_of(curves, curve, place, pace);
    if (!spline) return spline;
    // Phantom points and tangents are up to three times as large as what was given.
    bool finite = true;
    const std::span<const double> points(spline->points);
    pace.in_blocks(points.size(), [&](Count begin, Count end) {
      finite = finite && all_finite(points.subspan(begin, end - begin));
    });
    if (!finite) return Result<Spline>(does_not_fit());
    return spline;
  });
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
SplineSize size_on_knots(const ControlCurves& curves, Count curve, CurvePlace place, const Pace& pace) {
  const Count count = curves.points_of_curve(curve);
  const Index order = order_of(curves, curve);
  const std::span<const double> knots = std::span(curves.knots).subspan(place.knots, count + order);
  double from = knots[order - 1], to = knots[count];
  const bool whole =
      curves.ranges.empty() || (curves.ranges[2 * curve] == from && curves.ranges[2 * curve + 1] == to);
  if (!whole) from = curves.ranges[2 * curve], to = curves.ranges[2 * curve + 1];
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
  const bool closed = curves.wrap == CurveWrap::periodic;
  switch (curves.basis) {
    case CurveBasis::bspline:
      return size_of_uniform(curves.wrap, count, curves.degree);
    case CurveBasis::four_point:
    case CurveBasis::corner_cutting:
      return size_of_uniform(curves.wrap, count, 2);
    case CurveBasis::bezier:
      return size_of_pieces(count / 3);
    case CurveBasis::hermite:
      return size_of_pieces(count / 2 - (closed ? 0 : 1));
    case CurveBasis::catmull_rom:
      return size_of_pieces(closed ? count : count - (curves.wrap == CurveWrap::pinned ? 1 : 3));
    case CurveBasis::nurbs:
      break;
  }
  return size_on_knots(curves, curve, place, pace);
}

Count refined_piecewise_count(const ControlCurves& curves, Index level, const Pace& pace) {
  const Count parts = Count{1} << level;
  Count total = 0;
  CurvePlace place;
  for (Count c = 0; c < curves.curve_count(); place = next_place(curves, c, place), ++c) {
    pace.spend(1);
    const SplineSize size = spline_size(curves, c, place, pace);
    total += curves.basis == CurveBasis::nurbs ? size.points + size.spans * (parts - 1)
                                               : 3 * size.spans * parts + 1;
  }
  return total;
}

}  // namespace subdivd

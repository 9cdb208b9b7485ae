#include "core/curves/piecewise.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <variant>

#include "core/base/all_finite.h"
#include "core/base/overloaded.h"
#include "core/base/pace.h"
#include "core/base/precision.h"
#include "core/base/text_of.h"
#include "core/curves/bases.h"
#include "core/splines/edit.h"

namespace subdivd {
namespace {

Error fault(ErrorCode code, std::string message, Path where) {
  return Error{code, std::move(message), std::move(where)};
}

std::span<const double> points_at(const ControlCurves& curves, Count curve, Count first) {
  return std::span(curves.points).subspan(first * curves.width, curves.points_of_curve(curve) * curves.width);
}

// The whole of curve `curve` on its knots, unchecked.
Spline spline_on_knots(const ControlCurves& curves, const Nurbs& nurbs, Count curve, CurvePlace place,
                       const Pace& pace) {
  const Count count = curves.points_of_curve(curve);
  const Index order = nurbs.order_of(curve);
  const std::span<const double> points = points_at(curves, curve, place.points);
  Spline spline{.degree = order - 1,
                .width = curves.width,
                .rational = false,
                .periodic = false,
                .knots = {},
                .points = {}};
  pace.copy(std::span(nurbs.knots).subspan(place.knots, count + order), spline.knots);
  if (nurbs.weights.empty()) {
    pace.copy(points, spline.points);
    return spline;
  }
  spline.points =
      to_homogeneous(points, curves.width, std::span(nurbs.weights).subspan(place.points, count), pace);
  spline.rational = true;
  ++spline.width;
  return spline;
}

// --- Checks -----------------------------------------------------------------------------------------------

Result<void> refuse_count(ErrorCode code, const char* rule, Count points, const Path& where) {
  return fault(code, std::string(rule) + "; this one has " + std::to_string(points), where);
}

// Of the kinds that say how their points are counted; knots are counted with them.
Result<void> check_count(const ControlCurves& curves, Count points, const Path& where) {
  return std::visit(
      [&]<class Kind>(const Kind& kind) -> Result<void> {
        if constexpr (PiecewiseKind<Kind>)
          return kind.check_count(points, curves.wrap, where);
        else
          return {};
      },
      curves.basis);
}

// All lengths that must agree before any curve can be looked at.
Result<void> check_lengths(const ControlCurves& curves, const Nurbs& nurbs, const Pace& pace) {
  const Count count = curves.curve_count();
  if (nurbs.orders.size() != 1 && nurbs.orders.size() != count)
    return fault(ErrorCode::wrong_length,
                 "there are " + std::to_string(nurbs.orders.size()) +
                     " orders; one for all curves or one for each of " + std::to_string(count) + " is needed",
                 {"order"});
  Count knots = 0;
  for (Count c = 0; c < count; ++c) {
    pace.spend(1);
    const Index order = nurbs.order_of(c);
    if (order < 2 || order > kMaxDegree + 1)
      return fault(ErrorCode::out_of_range,
                   "the order is " + std::to_string(order) + "; it is the degree and one more, 2 to " +
                       std::to_string(kMaxDegree + 1),
                   nurbs.orders.size() == 1 ? Path{"order"} : Path{"order", std::uint64_t{c}});
    knots += curves.points_of_curve(c) + order;
  }
  if (knots != nurbs.knots.size())
    return fault(ErrorCode::wrong_length,
                 "there are " + std::to_string(nurbs.knots.size()) +
                     " knots; points and order of every curve together make " + std::to_string(knots),
                 {"knots"});
  if (!nurbs.weights.empty() && nurbs.weights.size() != curves.point_count())
    return fault(ErrorCode::wrong_length,
                 "there are " + std::to_string(nurbs.weights.size()) + " weights for " +
                     std::to_string(curves.point_count()) + " points",
                 {"pointWeights"});
  if (!nurbs.ranges.empty() && nurbs.ranges.size() != 2 * count)
    return fault(ErrorCode::wrong_length, "every curve has one range of two parameters", {"ranges"});
  return {};
}

// A place in one curve as one in the arrays of all.
Path shifted(Path where, const ControlCurves& curves, bool weighted, Count curve, CurvePlace place) {
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
    if (weighted) {
      const std::uint64_t stored = curves.width + std::uint64_t{1};
      index = index / stored * curves.width + std::min<std::uint64_t>(index % stored, curves.width - 1);
    }
    index += place.points * curves.width;
  }
  return where;
}

Result<void> check_weights(std::span<const double> weights, const Pace& pace) {
  for (Count i = 0; i < weights.size(); ++i) {
    pace.spend(1);
    const double weight = weights[i];
    if (weight > 0 && std::isfinite(weight)) continue;
    return fault(
        std::isfinite(weight) ? ErrorCode::out_of_range : ErrorCode::not_finite,
        "weight " + std::to_string(i) + " is " + text_of(weight) + "; weights are finite numbers above 0",
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

Result<void> check_on_knots(const ControlCurves& curves, const Nurbs& nurbs, const Budget& budget,
                            const Pace& pace) {
  if (auto fine = check_lengths(curves, nurbs, pace); !fine) return fine;
  if (auto fine = check_weights(nurbs.weights, pace); !fine) return fine;
  if (auto taken = budget.take_memory(largest_spline(curves, pace)); !taken) return taken;
  CurvePlace place;
  for (Count c = 0; c < curves.curve_count(); ++c) {
    pace.spend(1);
    const Spline spline = spline_on_knots(curves, nurbs, c, place, pace);
    if (auto fine = spline.check(budget); !fine) {
      if (!is_stop(fine.error()))
        fine.error().where = shifted(std::move(fine.error().where), curves, !nurbs.weights.empty(), c, place);
      return fine;
    }
    if (!nurbs.ranges.empty()) {
      const double from = nurbs.ranges[2 * c], to = nurbs.ranges[2 * c + 1];
      if (!(from >= spline.begin() && from < to && to <= spline.end()))
        return fault(ErrorCode::out_of_range,
                     "the range must ascend within the domain, " + text_of(spline.begin()) + " to " +
                         text_of(spline.end()),
                     {"ranges", std::uint64_t{c}});
    }
    place = next_place(curves, c, place);
  }
  return {};
}

}  // namespace

Result<void> Bezier::check_count(Count points, CurveWrap wrap, const Path& where) const {
  const bool closed = wrap == CurveWrap::periodic;
  if (closed && (points < 3 || points % 3 != 0))
    return refuse_count(points < 3 ? ErrorCode::too_few_points : ErrorCode::wrong_length,
                        "a closed Bezier curve of k segments has 3 k points", points, where);
  if (!closed && (points < 4 || points % 3 != 1))
    return refuse_count(points < 4 ? ErrorCode::too_few_points : ErrorCode::wrong_length,
                        "a Bezier curve of k segments has 3 k + 1 points", points, where);
  return {};
}

Result<void> CatmullRom::check_count(Count points, CurveWrap wrap, const Path& where) const {
  const auto refuse = [&](const char* rule) {
    return refuse_count(ErrorCode::too_few_points, rule, points, where);
  };
  if (wrap == CurveWrap::periodic && points < 3)
    return refuse("a closed Catmull-Rom curve needs at least 3 points");
  if (wrap == CurveWrap::pinned && points < 2)
    return refuse("a pinned Catmull-Rom curve needs at least 2 points");
  if (wrap == CurveWrap::nonperiodic && points < 4)
    return refuse("a nonperiodic Catmull-Rom curve needs at least 4 points");
  return {};
}

Result<void> Hermite::check_count(Count points, CurveWrap, const Path& where) const {
  if (points >= 4 && points % 2 == 0) return {};
  return refuse_count(points < 4 ? ErrorCode::too_few_points : ErrorCode::wrong_length,
                      "a Hermite curve has a tangent behind every point, and at least two of both", points,
                      where);
}

CurvePlace next_place(const ControlCurves& curves, Count curve, CurvePlace place) {
  const Count points = curves.points_of_curve(curve);
  const Nurbs* nurbs = std::get_if<Nurbs>(&curves.basis);
  const Count knots = nurbs != nullptr ? points + nurbs->order_of(curve) : 0;
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
  const Nurbs* nurbs = std::get_if<Nurbs>(&curves.basis);
  if (nurbs == nullptr) return {};
  return stoppable(budget, [&](const Pace& pace) { return check_on_knots(curves, *nurbs, budget, pace); });
}

namespace {

// The part of a curve on knots that its range leaves.
Result<Spline> ranged_spline(const ControlCurves& curves, const Nurbs& nurbs, Count curve, CurvePlace place,
                             const Pace& pace) {
  Spline spline = spline_on_knots(curves, nurbs, curve, place, pace);
  if (nurbs.ranges.empty()) return spline;
  const double from = nurbs.ranges[2 * curve], to = nurbs.ranges[2 * curve + 1];
  if (from == spline.begin() && to == spline.end()) return spline;
  return part(spline, from, to, pace.budget());
}

Result<Spline> make_spline(const ControlCurves& curves, Count curve, CurvePlace place, const Pace& pace) {
  const std::span<const double> points = points_at(curves, curve, place.points);
  const Index width = curves.width;
  const CurveWrap wrap = curves.wrap;
  using R = Result<Spline>;
  return std::visit(
      Overloaded{
          [&](const UniformBSpline& kind) -> R {
            return spline_of_bspline(points, width, wrap, kind.degree, pace);
          },
          [&](const FourPoint&) -> R {
            return fault(ErrorCode::unsupported, "a four-point curve has no formula; it can be refined only",
                         {"basis"});
          },
          [&](const CornerCutting& kind) -> R {
            if (kind.is_quadratic_bspline()) return spline_of_bspline(points, width, wrap, 2, pace);
            return fault(ErrorCode::unsupported,
                         "corner cutting at another ratio than 1/4 makes a curve without a formula",
                         {"ratio"});
          },
          [&](const Bezier&) -> R { return spline_of_bezier(points, width, wrap, pace); },
          [&](const CatmullRom& kind) -> R {
            return spline_of_catmull_rom(points, width, wrap, kind.spacing, pace);
          },
          [&](const Hermite&) -> R { return spline_of_hermite(points, width, wrap, pace); },
          [&](const Nurbs& nurbs) -> R { return ranged_spline(curves, nurbs, curve, place, pace); },
      },
      curves.basis);
}

}  // namespace

Result<Spline> spline_of(const ControlCurves& curves, Count curve, CurvePlace place, const Budget& budget) {
  assert(curve < curves.curve_count());
  return stoppable(budget, [&](const Pace& pace) {
    auto spline = make_spline(curves, curve, place, pace);
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

}  // namespace subdivd

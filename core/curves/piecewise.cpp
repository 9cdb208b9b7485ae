#include "core/curves/piecewise.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "core/base/precision.h"
#include "core/curves/bases.h"
#include "core/splines/bezier.h"
#include "core/splines/bspline.h"
#include "core/splines/edit.h"
#include "core/splines/knot_insertion.h"

namespace subdivd {
namespace {

bool all_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double x) { return std::isfinite(x); });
}

Error fault(ErrorCode code, std::string message, Path where) {
  return Error{code, std::move(message), std::move(where), 0, 0};
}

Index order_of(const ControlCurves& curves, Count curve) {
  return curves.orders.size() == 1 ? curves.orders[0] : curves.orders[curve];
}

std::span<const double> points_at(const ControlCurves& curves, Count curve, Count first) {
  return std::span(curves.points).subspan(first * curves.width, curves.points_of_curve(curve) * curves.width);
}

// The whole of curve `curve` on its knots, unchecked.
Spline spline_on_knots(const ControlCurves& curves, Count curve, CurvePlace place) {
  const Count count = curves.points_of_curve(curve);
  const std::span<const double> points = points_at(curves, curve, place.points);
  Spline spline{order_of(curves, curve) - 1, curves.width, false, false, {}, {points.begin(), points.end()}};
  const auto knots = std::span(curves.knots).subspan(place.knots, count + order_of(curves, curve));
  spline.knots.assign(knots.begin(), knots.end());
  if (curves.weights.empty()) return spline;
  spline.points = homogeneous(points, curves.width, std::span(curves.weights).subspan(place.points, count));
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
Result<void> check_lengths(const ControlCurves& curves) {
  const Count count = curves.curve_count();
  if (curves.orders.size() != 1 && curves.orders.size() != count)
    return fault(ErrorCode::wrong_length,
                 "there are " + std::to_string(curves.orders.size()) +
                     " orders; one for all curves or one for each of " + std::to_string(count) + " is needed",
                 {"order"});
  Count knots = 0;
  for (Count c = 0; c < count; ++c) {
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

Result<void> check_weights(const ControlCurves& curves) {
  for (Count i = 0; i < curves.weights.size(); ++i)
    if (!(curves.weights[i] > 0) || !std::isfinite(curves.weights[i]))
      return fault(std::isfinite(curves.weights[i]) ? ErrorCode::out_of_range : ErrorCode::not_finite,
                   "weight " + std::to_string(i) + " is " + std::to_string(curves.weights[i]) +
                       "; weights are finite numbers above 0",
                   {"pointWeights", std::uint64_t{i}});
  return {};
}

// The largest curve as a spline of its own.
Result<void> take_spline(const ControlCurves& curves, const Budget& budget) {
  Count most = 0;
  for (Count c = 0; c < curves.curve_count(); ++c) most = std::max(most, curves.points_of_curve(c));
  return budget.take_memory((most * (Count{curves.width} + 2) + kMaxDegree + 1) * sizeof(double));
}

Result<void> check_on_knots(const ControlCurves& curves, const Budget& budget) {
  if (auto fine = check_lengths(curves); !fine) return fine;
  if (auto fine = check_weights(curves); !fine) return fine;
  if (auto taken = take_spline(curves, budget); !taken) return taken;
  BudgetPoller poller(budget);
  CurvePlace place;
  for (Count c = 0; c < curves.curve_count(); ++c) {
    if (auto stop = poller.spend(curves.points_of_curve(c))) return *stop;
    const Spline spline = spline_on_knots(curves, c, place);
    if (auto fine = spline.check(); !fine) {
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

std::vector<CurvePlace> curve_places(const ControlCurves& curves) {
  std::vector<CurvePlace> places(curves.curve_count());
  for (Count c = 1; c < places.size(); ++c) places[c] = next_place(curves, c - 1, places[c - 1]);
  return places;
}

Result<void> check_piecewise(const ControlCurves& curves, const Budget& budget) {
  const bool many = !curves.vertex_counts.empty();
  Count taken = 0;
  BudgetPoller poller(budget);
  for (Count c = 0; c < curves.curve_count(); ++c) {
    if (auto stop = poller.spend(1)) return *stop;
    const Path where = many ? Path{"curveVertexCounts", std::uint64_t{c}} : Path{"points"};
    if (auto fine = check_count(curves, curves.points_of_curve(c), where); !fine) return fine;
    taken += curves.points_of_curve(c);
  }
  if (taken != curves.point_count())
    return fault(ErrorCode::wrong_length,
                 "the counts of curveVertexCounts add up to " + std::to_string(taken) + "; there are " +
                     std::to_string(curves.point_count()) + " points",
                 {"curveVertexCounts"});
  return curves.basis == CurveBasis::nurbs ? check_on_knots(curves, budget) : Result<void>();
}

namespace {

Result<Spline> made_of(const ControlCurves& curves, Count curve, CurvePlace place) {
  const std::span<const double> points = points_at(curves, curve, place.points);
  switch (curves.basis) {
    case CurveBasis::bspline:
      return spline_of_bspline(points, curves.width, curves.wrap, curves.degree);
    case CurveBasis::corner_cutting:
      if (curves.ratio == 0.25) return spline_of_bspline(points, curves.width, curves.wrap, 2);
      return fault(ErrorCode::unsupported,
                   "corner cutting at another ratio than 1/4 makes a curve without a formula", {"ratio"});
    case CurveBasis::four_point:
      return fault(ErrorCode::unsupported, "a four-point curve has no formula; it can be refined only",
                   {"basis"});
    case CurveBasis::bezier:
      return spline_of_bezier(points, curves.width, curves.wrap);
    case CurveBasis::catmull_rom:
      return spline_of_catmull_rom(points, curves.width, curves.wrap, curves.spacing);
    case CurveBasis::hermite:
      return spline_of_hermite(points, curves.width, curves.wrap);
    case CurveBasis::nurbs:
      break;
  }
  Spline spline = spline_on_knots(curves, curve, place);
  if (curves.ranges.empty()) return spline;
  const double from = curves.ranges[2 * curve], to = curves.ranges[2 * curve + 1];
  if (from == spline.begin() && to == spline.end()) return spline;
  return part(spline, from, to);
}

}  // namespace

Result<Spline> spline_of(const ControlCurves& curves, Count curve, CurvePlace place) {
  assert(curve < curves.curve_count());
  auto spline = made_of(curves, curve, place);
  // Phantom points and tangents are up to three times as large as what was given.
  if (spline && !all_finite(spline->points)) return does_not_fit();
  return spline;
}

namespace {

Count refined_count(const ControlCurves& curves, Count curve, CurvePlace place, Index level) {
  const Count count = curves.points_of_curve(curve), parts = Count{1} << level;
  const bool closed = curves.wrap == CurveWrap::periodic;
  switch (curves.basis) {
    case CurveBasis::bezier:
      return 3 * (count / 3) * parts + 1;
    case CurveBasis::hermite:
      return 3 * (count / 2 - (closed ? 0 : 1)) * parts + 1;
    case CurveBasis::catmull_rom:
      return 3 * (closed ? count : count - (curves.wrap == CurveWrap::pinned ? 1 : 3)) * parts + 1;
    default:
      break;
  }
  // Of a whole curve on knots the knots tell, without a copy of its points.
  if (curves.basis == CurveBasis::nurbs && curves.ranges.empty()) {
    const double* const knots = curves.knots.data() + place.knots;
    Count spans = 0;
    for (Count k = order_of(curves, curve) - Count{1}; k < count; ++k) spans += knots[k] < knots[k + 1];
    return count + spans * (parts - 1);
  }
  const Result<Spline> spline = spline_of(curves, curve, place);
  return spline ? refined_point_count(*spline, level) : 0;
}

}  // namespace

Count refined_piecewise_count(const ControlCurves& curves, Index level) {
  Count total = 0;
  CurvePlace place;
  for (Count c = 0; c < curves.curve_count(); place = next_place(curves, c, place), ++c)
    total += refined_count(curves, c, place, level);
  return total;
}

// --- Refinement -------------------------------------------------------------------------------------------

namespace {

// Parameters at which the points of a refined curve are taken to stand.
std::vector<double> parameters_of(const Spline& spline, CurveBasis basis) {
  std::vector<double> ts;
  if (basis == CurveBasis::nurbs) {
    for (Count i = 0; i < spline.point_count(); ++i) {
      double mean = 0;
      for (Index k = 1; k <= spline.degree; ++k) mean += spline.knots[i + k] / spline.degree;
      ts.push_back(std::clamp(mean, spline.begin(), spline.end()));
    }
    return ts;
  }
  const std::vector<BezierPiece> pieces = bezier_pieces(spline);
  for (const BezierPiece& piece : pieces)
    for (Index k = 0; k < 3; ++k) ts.push_back(piece.begin + (piece.end - piece.begin) * k / 3);
  ts.push_back(pieces.back().end);
  return ts;
}

Result<void> add_limits(const Spline& refined, const CurveOptions& options, const Budget& budget,
                        RefinedPiecewise& all) {
  if (!options.limit && !options.tangents) return {};
  const Index dimension = refined.dimension();
  std::vector<double> rows(2 * std::size_t{dimension});
  BudgetPoller poller(budget);
  for (const double t : parameters_of(refined, all.basis)) {
    if (auto stop = poller.spend(64)) return *stop;
    if (auto done = derivatives(refined, t, 1, rows); !done) return done;
    if (options.limit)
      all.limit_points.insert(all.limit_points.end(), rows.begin(), rows.begin() + dimension);
    if (options.tangents) all.tangents.insert(all.tangents.end(), rows.begin() + dimension, rows.end());
  }
  return {};
}

}  // namespace

Result<RefinedPiecewise> refine_piecewise(const ControlCurves& curves, const CurveOptions& options,
                                          const Budget& budget) {
  RefinedPiecewise all;
  if (curves.basis == CurveBasis::nurbs) all.basis = CurveBasis::nurbs;
  CurvePlace place;
  for (Count c = 0; c < curves.curve_count(); place = next_place(curves, c, place), ++c) {
    if (auto stop = budget.poll()) return *stop;
    const auto spline = spline_of(curves, c, place);
    if (!spline) return spline.error();
    const auto refined = refine_spans(*spline, options.level, budget);
    if (!refined) return refined.error();
    const Count before = all.points.size();
    if (all.basis == CurveBasis::nurbs) {
      const std::vector<double> points = projected(*refined), own = weights(*refined);
      all.points.insert(all.points.end(), points.begin(), points.end());
      all.weights.insert(all.weights.end(), own.begin(), own.end());
      all.knots.insert(all.knots.end(), refined->knots.begin(), refined->knots.end());
      all.orders.push_back(refined->degree + 1);
    } else {
      const auto points = bezier_points(*refined, budget);
      if (!points) return points.error();
      all.points.insert(all.points.end(), points->begin(), points->end());
    }
    all.vertex_counts.push_back(static_cast<Index>((all.points.size() - before) / curves.width));
    if (auto done = add_limits(*refined, options, budget, all); !done) return std::move(done).error();
  }
  return all;
}

}  // namespace subdivd

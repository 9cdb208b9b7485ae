#include "server/handlers/compute_curves.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/curves/bases.h"
#include "core/curves/bspline.h"
#include "core/curves/degree.h"
#include "core/curves/edit.h"
#include "core/curves/flatten_subdivided.h"
#include "core/curves/knot_insertion.h"
#include "core/curves/knot_removal.h"
#include "core/curves/piecewise.h"
#include "proto/prepare.h"
#include "server/handlers/drawn_curve.h"

namespace subdivd::server {
namespace {

using proto::CurveForm;
using proto::CurveMeasure;
using proto::CurveRequest;
using proto::CurveTask;
using proto::CurveTaskKind;
using proto::EditedCurves;

constexpr double kLengthTolerance = 1e-9;

// What one curve may take: a smooth one far less, one of many spans in proportion.
Count most_polyline_points(Count points) { return std::max(Count{1} << 16, 64 * points); }
Count most_length_pieces(Count points) { return std::max(LengthOptions{}.max_pieces, 16 * points); }

// An error about something beside the curves: its place is a member of the body.
Error at_member(Error error, const char* member, std::optional<std::uint64_t> index = {}) {
  error.where = {member};
  if (index) error.where.emplace_back(*index);
  return error;
}

// --- Sizes ------------------------------------------------------------------------------------------------

// Points that come out for one that goes in, at most: segments of Catmull-Rom and Hermite curves become
// Bezier pieces, spans become pieces, and at degree d a span has d points of its own.
Count growth(CurveBasis basis, const CurveTask& task) {
  const bool drawn = basis == CurveBasis::catmull_rom || basis == CurveBasis::hermite;
  const Count pieces = task.to == CurveForm::nurbs ? 1 : 4;
  return (drawn ? 3 : 1) * std::max<Count>(pieces, task.to_degree.value_or(0) + (task.to_degree ? 1 : 0));
}

Count numbers_of(const CurveRequest& request) {
  const CurveTask& task = request.task;
  Count numbers = 0;
  // A point, five derivatives, a normal and what says where.
  for (const ControlPatch& surface : request.curves.surfaces)
    numbers = std::max(numbers, task.sample_us.size() * (Count{6} * surface.width + 6));
  for (const ControlCurves& curves : request.curves.curves) {
    const Count points = curves.point_count(), count = curves.curve_count();
    const Count width = curves.width + 2;  // weight and knot
    switch (task.kind) {
      case CurveTaskKind::evaluate:
        numbers = std::max(
            numbers, task.sample_ts.size() *
                         ((Count{task.frames ? 4u : task.derivatives} + task.derivatives + 1) * width + 12));
        break;
      case CurveTaskKind::measure:
        numbers += count * (Count{task.equal_lengths.value_or(0)} + Count{task.convergence.value_or(0)} * 2 +
                            4 * width + task.closest_to.size() * 3);
        if (task.flatten)
          for (Count c = 0; c < count; ++c)
            numbers += most_polyline_points(curves.points_of_curve(c)) * width;
        break;
      default:
        numbers +=
            (points * growth(curves.basis, task) + count * (task.insert.size() + 2 * Count{kMaxDegree})) *
            width;
        break;
    }
  }
  return numbers;
}

// --- Curves of a request ----------------------------------------------------------------------------------

// Calls work(curve, set, ordinal) for what make(curves, ordinal, place) makes of every curve, in the order of
// the body; what cannot be made is blamed on its set of curves.
template <class Make, class Work>
Result<void> for_each_curve(const CurveRequest& request, const Budget& budget, Make&& make, Work&& work) {
  for (std::size_t i = 0; i < request.curves.curves.size(); ++i) {
    const ControlCurves& curves = request.curves.curves[i];
    CurvePlace place;
    for (Count c = 0; c < curves.curve_count(); place = next_place(curves, c, place), ++c) {
      if (auto stop = budget.poll()) return *stop;
      auto curve = make(curves, c, place);
      if (!curve) return proto::blame_input(request.curves, std::move(curve).error(), "curves", i);
      if (auto done = work(*std::move(curve), i, c); !done) return done;
    }
  }
  return {};
}

}  // namespace

Result<Count> predict_curve_task(const CurveRequest& request, Count most) {
  constexpr Count kTextOfNumber = 26, kBytesOfNumber = 64;
  const Count numbers = numbers_of(request);
  if (numbers * kTextOfNumber <= most) return numbers * kBytesOfNumber;
  return Error{ErrorCode::too_large,
               "the answer would take up to " + std::to_string(numbers * kTextOfNumber) + " bytes; " +
                   std::to_string(most) + " are allowed: ask for less, or for fewer curves",
               {},
               numbers * kTextOfNumber,
               most};
}

// --- Measuring --------------------------------------------------------------------------------------------

namespace {

Result<void> measure_closest(const Spline& spline, const CurveTask& task, const Budget& budget,
                             CurveMeasure& measure) {
  if (!task.closest_to.empty() && task.closest_width != spline.dimension())
    return Error{ErrorCode::wrong_length,
                 "the points have " + std::to_string(task.closest_width) +
                     " coordinates, those of the curve " + std::to_string(spline.dimension()),
                 {"closestTo"},
                 0,
                 0};
  for (std::size_t at = 0; at < task.closest_to.size(); at += task.closest_width) {
    auto closest = closest_point(spline, std::span(task.closest_to).subspan(at, task.closest_width), budget);
    if (!closest) return at_member(std::move(closest).error(), "closestTo", at / task.closest_width);
    measure.closest.push_back(*std::move(closest));
  }
  return {};
}

// A spline or a subdivided curve.
template <class Curve>
Result<Polyline> flattened(const Curve& drawn, const ControlCurves& curves, Count curve,
                           const CurveTask& task, const Budget& budget) {
  const FlattenOptions options = {.tolerance = *task.flatten,
                                  .max_points = most_polyline_points(curves.points_of_curve(curve))};
  auto polyline = flatten(drawn, options, budget);
  if (!polyline) return at_member(std::move(polyline).error(), "flatten");
  return polyline;
}

// What has no formula has a polyline, and that only.
Result<CurveMeasure> measured(const SubdividedCurve& drawn, const ControlCurves& curves, Count curve,
                              const CurveTask& task, const Budget& budget) {
  if (!task.flatten || task.equal_lengths || task.convergence || !task.closest_to.empty())
    return Error{
        ErrorCode::unsupported,
        "this curve has no polynomial pieces: it has no length or box here, only a polyline (flatten)",
        {"basis"},
        0,
        0};
  CurveMeasure measure;
  auto polyline = flattened(drawn, curves, curve, task, budget);
  if (!polyline) return std::move(polyline).error();
  measure.polyline = *std::move(polyline);
  return measure;
}

Result<CurveMeasure> measured(const Spline& spline, const ControlCurves& curves, Count curve,
                              const CurveTask& task, const Budget& budget) {
  CurveMeasure measure;
  auto length = arc_length(spline,
                           {.tolerance = task.tolerance.value_or(kLengthTolerance),
                            .max_pieces = most_length_pieces(curves.points_of_curve(curve))},
                           budget);
  if (!length) return at_member(std::move(length).error(), "tolerance");
  measure.length = *length;
  auto box = bounds(spline, budget);
  if (!box) return std::move(box).error();
  measure.box = *std::move(box);
  if (auto done = measure_closest(spline, task, budget, measure); !done) return std::move(done).error();
  if (task.flatten) {
    auto polyline = flattened(spline, curves, curve, task, budget);
    if (!polyline) return std::move(polyline).error();
    measure.polyline = *std::move(polyline);
  }
  if (task.equal_lengths) {
    auto parameters = equal_parameters(spline, *task.equal_lengths,
                                       {.tolerance = kPositionOptions.tolerance,
                                        .max_pieces = most_length_pieces(curves.points_of_curve(curve))},
                                       budget);
    if (!parameters) return at_member(std::move(parameters).error(), "equalLengths");
    measure.equal_parameters = *std::move(parameters);
  }
  if (task.convergence) {
    auto convergence = measure_convergence(curves, static_cast<Index>(curve), *task.convergence, budget);
    if (!convergence) return at_member(std::move(convergence).error(), "convergence");
    measure.convergence = *std::move(convergence);
  }
  return measure;
}

}  // namespace

Result<std::vector<CurveMeasure>> compute_measures(const CurveRequest& request, const Budget& budget) {
  std::vector<CurveMeasure> all;
  const auto measure = [&](const DrawnCurve& curve, std::size_t set, Count ordinal) -> Result<void> {
    const ControlCurves& curves = request.curves.curves[set];
    auto one = std::visit(
        [&](const auto& drawn) { return measured(drawn, curves, ordinal, request.task, budget); }, curve);
    if (!one && one.error().where == Path{"basis"})
      return proto::blame_input(request.curves, std::move(one).error(), "curves", set);
    if (!one) return std::move(one).error();
    all.push_back(*std::move(one));
    return {};
  };
  if (auto done = for_each_curve(request, budget, drawn, measure); !done) return std::move(done).error();
  return all;
}

// --- Editing ----------------------------------------------------------------------------------------------

namespace {

Result<Approximation> inserted(const Spline& spline, const CurveTask& task, const Budget& budget) {
  // In the caller's order they may fall; sorted ones are inserted, and a fault is told by its own place.
  std::vector<double> knots = task.insert;
  std::ranges::sort(knots);
  auto refined = refine_knots(spline, knots, budget);
  if (refined) return Approximation{*std::move(refined), 0};
  Error error = std::move(refined).error();
  if (error.where.empty()) return error;
  const double bad = knots[std::get<std::uint64_t>(error.where[0])];
  const auto place = std::ranges::find_if(task.insert, [&](double t) { return t == bad || t != t; });
  return at_member(std::move(error), "insert", static_cast<std::uint64_t>(place - task.insert.begin()));
}

Result<Approximation> thinned(const Spline& spline, const CurveTask& task, const Budget& budget,
                              Count& removed) {
  const double tolerance = task.tolerance.value_or(0);
  if (!task.remove) {
    auto thinning = remove_knots(spline, tolerance, budget);
    if (!thinning) return std::move(thinning).error();
    removed = thinning->removed;
    return std::move(thinning->result);
  }
  Approximation result{spline, 0};
  for (std::size_t k = 0; k < task.remove->size(); ++k) {
    if (auto stop = budget.poll()) return *stop;
    // A knot that an earlier removal of the same has taken is no fault.
    const double t = (*task.remove)[k];
    if (removed > 0 && multiplicity(spline.knots, t) > 0 && multiplicity(result.spline.knots, t) == 0)
      continue;
    auto removal = remove_knot(result.spline, t, 1, tolerance - result.bound);
    if (!removal) {
      Error error = std::move(removal).error();
      return error.where.empty() ? at_member(std::move(error), "remove", k) : error;
    }
    removed += removal->times;
    result.bound += removal->result.bound;
    result.spline = std::move(removal->result.spline);
  }
  return result;
}

Result<Approximation> redrawn(const Spline& spline, const CurveTask& task, const Budget& budget) {
  Approximation result{spline, 0};
  const auto put = [&](Result<Spline> next, const char* member) -> Result<void> {
    if (!next) return at_member(std::move(next).error(), member);
    result.spline = *std::move(next);
    return {};
  };
  if (task.range)
    if (auto done = put(part(result.spline, (*task.range)[0], (*task.range)[1]), "range"); !done)
      return std::move(done).error();
  if (task.to_degree && *task.to_degree > result.spline.degree)
    if (auto done =
            put(elevate_degree(result.spline, *task.to_degree - result.spline.degree, budget), "toDegree");
        !done)
      return std::move(done).error();
  while (task.to_degree && *task.to_degree < result.spline.degree) {
    auto reduced = reduce_degree(result.spline, budget);
    if (!reduced) return at_member(std::move(reduced).error(), "toDegree");
    result.bound += reduced->bound;
    result.spline = std::move(reduced->spline);
    // Rounding alone, where no tolerance is given.
    const double allowed = task.tolerance.value_or(1e-10 * extent(spline));
    if (!(result.bound <= allowed))
      return Error{ErrorCode::out_of_range,
                   "at degree " + std::to_string(result.spline.degree) + " the curve may be " +
                       std::to_string(result.bound) + " away; the tolerance is " + std::to_string(allowed),
                   {"toDegree"},
                   0,
                   0};
  }
  if (task.reversed) result.spline = reversed(result.spline);
  if (task.domain)
    if (auto done = put(reparametrized(result.spline, (*task.domain)[0], (*task.domain)[1]), "domain"); !done)
      return std::move(done).error();
  return result;
}

// The points of a spline in another basis.
Result<std::vector<double>> points_in(CurveForm form, const Spline& spline, double tolerance,
                                      const Budget& budget) {
  switch (form) {
    case CurveForm::bezier:
      return bezier_points(spline, budget);
    case CurveForm::bspline:
      return bspline_points(spline, tolerance, budget);
    case CurveForm::catmull_rom:
      return catmull_rom_points(spline, tolerance, budget);
    case CurveForm::hermite:
      return hermite_points(spline, tolerance, budget);
    case CurveForm::nurbs:
      break;
  }
  return projected(spline);
}

CurveBasis basis_of(CurveForm form) {
  switch (form) {
    case CurveForm::bezier:
      return CurveBasis::bezier;
    case CurveForm::bspline:
      return CurveBasis::bspline;
    case CurveForm::catmull_rom:
      return CurveBasis::catmull_rom;
    case CurveForm::hermite:
      return CurveBasis::hermite;
    case CurveForm::nurbs:
      break;
  }
  return CurveBasis::nurbs;
}

Result<Approximation> edited(const Spline& spline, const CurveTask& task, const Budget& budget,
                             Count& removed) {
  switch (task.kind) {
    case CurveTaskKind::insert_knot:
      return inserted(spline, task, budget);
    case CurveTaskKind::remove_knot:
      return thinned(spline, task, budget, removed);
    default:
      return redrawn(spline, task, budget);
  }
}

void append(const Spline& spline, std::vector<double> points, RefinedCurves<double>& curves) {
  curves.vertex_counts.push_back(static_cast<Index>(points.size() / curves.width));
  curves.points.insert(curves.points.end(), points.begin(), points.end());
  if (curves.basis != CurveBasis::nurbs) return;
  curves.orders.push_back(spline.degree + 1);
  curves.knots.insert(curves.knots.end(), spline.knots.begin(), spline.knots.end());
  const std::vector<double> own = weights(spline);
  curves.weights.insert(curves.weights.end(), own.begin(), own.end());
}

}  // namespace

Result<EditedCurves> compute_edited(const CurveRequest& request, const Budget& budget) {
  const CurveTask& task = request.task;
  const CurveForm form = task.kind == CurveTaskKind::convert ? task.to : CurveForm::nurbs;
  EditedCurves all;
  for (const ControlCurves& curves : request.curves.curves) {
    RefinedCurves<double> empty;
    empty.name = curves.name;
    empty.level = 0;
    empty.width = curves.width;
    empty.wrap = CurveWrap::nonperiodic;
    empty.basis = basis_of(form);
    all.answer.curves.push_back(std::move(empty));
  }
  const auto on_knots = [](const ControlCurves& curves, Count curve, CurvePlace place) {
    return spline_of(curves, curve, place);
  };
  const auto edit = [&](const Spline& spline, std::size_t set, Count) -> Result<void> {
    Count removed = 0;
    auto changed = edited(spline, task, budget, removed);
    if (!changed) return std::move(changed).error();
    const double tolerance = task.tolerance.value_or(1e-10 * extent(spline));
    auto points = points_in(form, changed->spline, tolerance, budget);
    if (!points) return at_member(std::move(points).error(), "to");
    append(changed->spline, *std::move(points), all.answer.curves[set]);
    all.removed.push_back(removed);
    all.error_bounds.push_back(changed->bound);
    return {};
  };
  if (auto done = for_each_curve(request, budget, on_knots, edit); !done) return std::move(done).error();
  return all;
}

}  // namespace subdivd::server

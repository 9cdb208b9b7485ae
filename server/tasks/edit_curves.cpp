#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <variant>

#include "core/base/pace.h"
#include "core/base/text_of.h"
#include "core/curves/bases.h"
#include "core/curves/piecewise.h"
#include "core/splines/approximation.h"
#include "core/splines/degree.h"
#include "core/splines/edit.h"
#include "core/splines/knot_insertion.h"
#include "core/splines/knot_removal.h"
#include "server/tasks/compute_curves.h"
#include "server/tasks/each_curve.h"

namespace subdivd::server::tasks {
namespace {

using proto::CurveForm;
using proto::CurveRequest;
using proto::CurveTask;
using proto::CurveTaskKind;
using proto::EditedCurves;

Result<Approximation> insert_knots(const Spline& spline, const CurveTask& task, const Budget& budget) {
  // In the caller's order they may fall; sorted ones are inserted, and a fault is told by its own place.
  const auto knots = stoppable(budget, [&](const Pace& pace) {
    std::vector<double> sorted;
    pace.copy(task.insert, sorted);
    pace.sort(sorted.begin(), sorted.end(), std::less<>());
    return sorted;
  });
  if (!knots) return knots.error();
  auto refined = refine_knots(spline, *knots, budget);
  if (refined) return Approximation{*std::move(refined), 0};
  Error error = std::move(refined).error();
  if (error.where.empty()) return error;
  const double bad = (*knots)[std::get<std::uint64_t>(error.where[0])];
  const auto place = std::ranges::find_if(task.insert, [&](double t) { return t == bad || t != t; });
  return at_member(std::move(error), "insert", static_cast<std::uint64_t>(place - task.insert.begin()));
}

Result<Approximation> remove_knots_of(const Spline& spline, const CurveTask& task, const Budget& budget,
                                      Count& removed) {
  const double tolerance = task.tolerance.value_or(0);
  auto thinning = task.remove ? remove_knots(spline, *task.remove, tolerance, budget)
                              : remove_knots(spline, tolerance, budget);
  if (!thinning) {
    Error error = std::move(thinning).error();
    const bool listed = !error.where.empty() && std::holds_alternative<std::uint64_t>(error.where[0]);
    if (!listed) return error;
    const auto place = std::get<std::uint64_t>(error.where[0]);
    return at_member(std::move(error), "remove", place);
  }
  removed = thinning->removed;
  return std::move(thinning->result);
}

// Down to `degree`, one after the other; what that takes is free again.
Result<void> reduce_to_degree(Approximation& curve, Index degree, double allowed, ReusedMemory& memory) {
  const Count before = memory.used();
  while (curve.spline.degree > degree) {
    auto reduced = reduce_degree(curve.spline, memory.budget());
    if (!reduced) return at_member(std::move(reduced).error(), "toDegree");
    memory.free_to(before);
    curve.bound += reduced->bound;
    curve.spline = std::move(reduced->spline);
    if (curve.bound <= allowed) continue;
    return Error{ErrorCode::out_of_range,
                 "at degree " + std::to_string(curve.spline.degree) + " the curve may be " +
                     text_of(curve.bound) + " away; the tolerance is " + text_of(allowed),
                 {"toDegree"}};
  }
  return {};
}

// `tolerance`: what the task says, or rounding alone.
Result<Approximation> convert_curve(Spline spline, const CurveTask& task, double tolerance,
                                    ReusedMemory& memory) {
  const Budget& budget = memory.budget();
  Approximation result{std::move(spline), 0};
  const auto put = [&](Result<Spline> next, const char* member) -> Result<void> {
    if (!next) return at_member(std::move(next).error(), member);
    result.spline = *std::move(next);
    return {};
  };
  if (task.range)
    if (auto done = put(part(result.spline, (*task.range)[0], (*task.range)[1], budget), "range"); !done)
      return std::move(done).error();
  if (task.to_degree && *task.to_degree > result.spline.degree)
    if (auto done =
            put(elevate_degree(result.spline, *task.to_degree - result.spline.degree, budget), "toDegree");
        !done)
      return std::move(done).error();
  if (task.to_degree)
    if (auto done = reduce_to_degree(result, *task.to_degree, tolerance, memory); !done)
      return std::move(done).error();
  if (task.reversed) {
    auto back = stoppable(budget, [&](const Pace& pace) { return reverse(result.spline, pace); });
    if (auto done = put(std::move(back), "reversed"); !done) return std::move(done).error();
  }
  if (task.domain && !task.join)
    if (auto done = put(reparametrize(result.spline, (*task.domain)[0], (*task.domain)[1], budget), "domain");
        !done)
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
  return stoppable(budget, [&](const Pace& pace) { return control_points_of(spline, pace); });
}

CurveBasis basis_of(CurveForm form) {
  switch (form) {
    case CurveForm::bezier:
      return Bezier{};
    case CurveForm::bspline:
      return UniformBSpline{};
    case CurveForm::catmull_rom:
      return CatmullRom{};
    case CurveForm::hermite:
      return Hermite{};
    case CurveForm::nurbs:
      break;
  }
  return Nurbs{};
}

Result<Approximation> edit_curve(Spline spline, const CurveTask& task, double tolerance, ReusedMemory& memory,
                                 Count& removed) {
  switch (task.kind) {
    case CurveTaskKind::insert_knot:
      return insert_knots(spline, task, memory.budget());
    case CurveTaskKind::remove_knot:
      return remove_knots_of(spline, task, memory.budget(), removed);
    default:
      return convert_curve(std::move(spline), task, tolerance, memory);
  }
}

void append_to_set(const Spline& spline, const std::vector<double>& points, RefinedCurves<double>& curves,
                   const Pace& pace) {
  curves.vertex_counts.push_back(static_cast<Index>(points.size() / curves.width));
  pace.append(points, curves.points);
  Nurbs* nurbs = std::get_if<Nurbs>(&curves.basis);
  if (nurbs == nullptr) return;
  nurbs->orders.push_back(spline.degree + 1);
  pace.append(spline.knots, nurbs->knots);
  pace.append(weights(spline, pace), nurbs->weights);
}

// Finds a place in the answer for the edited curves: each in its set, or all joined into one.
class Collector {
 public:
  Collector(const CurveRequest& request, const Budget& budget)
      : request_(request),
        task_(request.task),
        budget_(budget),
        form_(task_.kind == CurveTaskKind::convert ? task_.to : CurveForm::nurbs) {
    for (const ControlCurves& curves : request.curves.curves) {
      RefinedCurves<double> empty;
      empty.name = curves.name;
      empty.level = 0;
      empty.width = curves.width;
      empty.wrap = CurveWrap::nonperiodic;
      empty.basis = basis_of(form_);
      all_.answer.curves.push_back(std::move(empty));
    }
  }

  Result<void> add(Approximation curve, Count removed, double tolerance, std::size_t set) {
    if (!task_.join) return write(curve, removed, tolerance, set);
    auto done = append(joined_, std::move(curve), tolerance, budget_);
    if (done) return {};
    Error error = std::move(done).error();
    error.where.clear();
    return proto::blame_input(request_.curves, std::move(error), "curves", set);
  }

  Result<EditedCurves> finish() {
    if (!joined_.whole) return std::move(all_);
    all_.answer.curves.resize(1);
    if (task_.domain) {
      auto moved = reparametrize(joined_.whole->spline, (*task_.domain)[0], (*task_.domain)[1], budget_);
      if (!moved) return at_member(std::move(moved).error(), "domain");
      joined_.whole->spline = *std::move(moved);
    }
    if (auto done = write(*joined_.whole, 0, joined_.tolerance, 0); !done) return std::move(done).error();
    return std::move(all_);
  }

 private:
  Result<void> write(const Approximation& curve, Count removed, double tolerance, std::size_t set) {
    auto points = points_in(form_, curve.spline, tolerance, budget_);
    if (!points) return at_member(std::move(points).error(), "to");
    const auto done = stoppable(budget_, [&](const Pace& pace) {
      append_to_set(curve.spline, *points, all_.answer.curves[set], pace);
    });
    if (!done) return done;
    all_.removed.push_back(removed);
    all_.error_bounds.push_back(curve.bound);
    return {};
  }

  const CurveRequest& request_;
  const CurveTask& task_;
  const Budget& budget_;
  const CurveForm form_;
  EditedCurves all_;
  JoinedCurve joined_;
};

}  // namespace

Result<EditedCurves> compute_edited(const CurveRequest& request, const Budget& whole) {
  ReusedMemory memory(whole);
  const Budget& budget = memory.budget();
  Collector collector(request, budget);
  const auto on_knots = [](const ControlCurves& curves, Count curve, CurvePlace place, const Budget& one) {
    return spline_of(curves, curve, place, one);
  };
  const auto edit = [&](Spline spline, std::size_t set, Count) -> Result<void> {
    const auto least = stoppable(budget, [&](const Pace& pace) { return rounding_tolerance(spline, pace); });
    if (!least) return least.error();
    const double tolerance = request.task.tolerance.value_or(*least);
    Count removed = 0;
    auto changed = edit_curve(std::move(spline), request.task, tolerance, memory, removed);
    if (!changed) return std::move(changed).error();
    return collector.add(*std::move(changed), removed, tolerance, set);
  };
  if (auto done = for_each_curve(request, memory, on_knots, edit); !done) return std::move(done).error();
  return collector.finish();
}

}  // namespace subdivd::server::tasks

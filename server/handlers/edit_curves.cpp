#include <algorithm>
#include <string>
#include <utility>

#include "core/curves/bases.h"
#include "core/curves/piecewise.h"
#include "core/splines/degree.h"
#include "core/splines/edit.h"
#include "core/splines/knot_insertion.h"
#include "core/splines/knot_removal.h"
#include "server/handlers/compute_curves.h"
#include "server/handlers/each_curve.h"

namespace subdivd::server {
namespace {

using proto::CurveForm;
using proto::CurveRequest;
using proto::CurveTask;
using proto::CurveTaskKind;
using proto::EditedCurves;

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
  if (task.domain && !task.join)
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
    if (!joined_) {
      joined_ = std::move(curve);
      tolerance_ = tolerance;
      return {};
    }
    const double gap = std::max(tolerance_, tolerance);
    if (auto done = subdivd::append(joined_->spline, curve.spline, gap, budget_); !done) {
      Error error = std::move(done).error();
      error.where.clear();
      return proto::blame_input(request_.curves, std::move(error), "curves", set);
    }
    joined_->bound = std::max(joined_->bound, curve.bound + gap / 2);
    tolerance_ = gap;
    return {};
  }

  Result<EditedCurves> finish() {
    if (!joined_) return std::move(all_);
    all_.answer.curves.resize(1);
    if (task_.domain) {
      auto moved = reparametrized(joined_->spline, (*task_.domain)[0], (*task_.domain)[1]);
      if (!moved) return at_member(std::move(moved).error(), "domain");
      joined_->spline = *std::move(moved);
    }
    if (auto done = write(*joined_, 0, tolerance_, 0); !done) return std::move(done).error();
    return std::move(all_);
  }

 private:
  Result<void> write(const Approximation& curve, Count removed, double tolerance, std::size_t set) {
    auto points = points_in(form_, curve.spline, tolerance, budget_);
    if (!points) return at_member(std::move(points).error(), "to");
    append(curve.spline, *std::move(points), all_.answer.curves[set]);
    all_.removed.push_back(removed);
    all_.error_bounds.push_back(curve.bound);
    return {};
  }

  const CurveRequest& request_;
  const CurveTask& task_;
  const Budget& budget_;
  const CurveForm form_;
  EditedCurves all_;
  std::optional<Approximation> joined_;
  double tolerance_ = 0;
};

}  // namespace

Result<EditedCurves> compute_edited(const CurveRequest& request, const Budget& whole) {
  ReusedMemory memory(whole);
  const Budget& budget = memory.budget();
  Collector collector(request, budget);
  const auto on_knots = [](const ControlCurves& curves, Count curve, CurvePlace place) {
    return spline_of(curves, curve, place);
  };
  const auto edit = [&](const Spline& spline, std::size_t set, Count) -> Result<void> {
    Count removed = 0;
    auto changed = edited(spline, request.task, budget, removed);
    if (!changed) return std::move(changed).error();
    const double tolerance = request.task.tolerance.value_or(1e-10 * extent(spline));
    return collector.add(*std::move(changed), removed, tolerance, set);
  };
  if (auto done = for_each_curve(request, memory, on_knots, edit); !done) return std::move(done).error();
  return collector.finish();
}

}  // namespace subdivd::server

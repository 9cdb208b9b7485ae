#include <algorithm>
#include <string>
#include <variant>

#include "core/base/pace.h"
#include "core/curves/piecewise.h"
#include "server/tasks/compute_curves.h"
#include "server/tasks/each_curve.h"

namespace subdivd::server::tasks {
namespace {

using proto::CurveForm;
using proto::CurveRequest;
using proto::CurveTask;
using proto::CurveTaskKind;

// What an answer holds: numbers, and the curves and sets of curves that they belong to.
struct AnswerCounts {
  Count numbers = 0, curves = 0, sets = 0;
  Count names = 0;  // bytes
};

// --- Edited curves ----------------------------------------------------------------------------------------

// A curve after its task; never more than this. What is removed, cut off or reduced makes it smaller.
SplineSize size_after_task(SplineSize size, const CurveTask& task) {
  size.points += task.insert.size();
  if (!task.to_degree) return size;
  if (*task.to_degree > size.degree) size.points += size.spans * (*task.to_degree - size.degree);
  size.degree = *task.to_degree;
  return size;
}

SplineSize size_at_degree(SplineSize size, Index degree) {
  if (degree > size.degree) size.points += size.spans * (degree - size.degree);
  size.degree = std::max(size.degree, degree);
  return size;
}

// In the answer: coordinates, weights and knots, the counts of both, and what was removed and lost. Brackets
// around every point are as long as a twelfth of a number.
Count numbers_of(const SplineSize& size, Index width, bool rational, CurveForm form) {
  constexpr Count kBeside = 4;
  const auto of_points = [&](Count points) { return points * width + points / 12 + kBeside + 1; };
  switch (form) {
    case CurveForm::bezier:
      return of_points(3 * size.spans + 1);
    case CurveForm::bspline:
    case CurveForm::catmull_rom:
      return of_points(size.spans + 3);
    case CurveForm::hermite:
      return of_points(2 * (size.spans + 1));
    case CurveForm::nurbs:
      break;
  }
  return of_points(size.points) + size.points * (rational ? 2 : 1) + size.degree + 1;
}

// Calls f(size, curves) for every curve as its task leaves it.
template <class F>
void for_each_edited(const CurveRequest& request, const Pace& pace, F&& f) {
  for (const ControlCurves& curves : request.curves.curves) {
    CurvePlace place;
    for (Count c = 0; c < curves.curve_count(); place = next_place(curves, c, place), ++c) {
      pace.spend(4);
      f(size_after_task(spline_size(curves, c, place, pace), request.task), curves);
    }
  }
}

bool is_rational(const ControlCurves& curves) {
  const Nurbs* nurbs = std::get_if<Nurbs>(&curves.basis);
  return nurbs != nullptr && !nurbs->weights.empty();
}

// All curves as one, raised to the highest degree among them.
Count numbers_joined(const CurveRequest& request, const Pace& pace) {
  Index degree = 1, width = 1;
  bool rational = false;
  for_each_edited(request, pace, [&](const SplineSize& size, const ControlCurves& curves) {
    degree = std::max(degree, size.degree);
    width = std::max(width, curves.width);
    rational = rational || is_rational(curves);
  });
  SplineSize all{degree, 0, 0};
  for_each_edited(request, pace, [&](const SplineSize& size, const ControlCurves&) {
    all.points += size_at_degree(size, degree).points;
    all.spans += size.spans;
  });
  return numbers_of(all, width, rational, request.task.to);
}

Count numbers_edited(const CurveRequest& request, const Pace& pace) {
  if (request.task.join) return numbers_joined(request, pace);
  Count numbers = 0;
  for_each_edited(request, pace, [&](const SplineSize& size, const ControlCurves& curves) {
    numbers += numbers_of(size, curves.width, is_rational(curves), request.task.to);
  });
  return numbers;
}

Result<void> check_removals(const CurveRequest& request, Count curves) {
  const Count listed = request.task.remove ? request.task.remove->size() : 0;
  if (curves <= 1 || listed <= kMostListedRemovals / curves) return {};
  return Error{.code = ErrorCode::too_large,
               .message = std::to_string(listed) + " knots would be looked for in each of " +
                          std::to_string(curves) + " curves; " + std::to_string(kMostListedRemovals) +
                          " searches are allowed: list fewer knots, or leave the list out",
               .where = {"remove"},
               .predicted = listed,
               .allowed = kMostListedRemovals / curves};
}

// --- What was found about curves --------------------------------------------------------------------------

Count numbers_sampled(const CurveRequest& request, const Pace& pace) {
  const CurveTask& task = request.task;
  Count numbers = 0;
  // A point, five derivatives, a normal and what says where.
  for (const ControlPatch& surface : request.curves.surfaces) {
    pace.spend(1);
    numbers = std::max(numbers, task.sample_us.size() * (Count{6} * surface.width + 6));
  }
  const Count rows = Count{task.frames ? 4u : task.derivatives} + task.derivatives + 1;
  for (const ControlCurves& curves : request.curves.curves) {
    pace.spend(1);
    numbers = std::max(numbers, task.sample_ts.size() * (rows * (Count{curves.width} + 2) + 12));
  }
  return numbers;
}

Count numbers_measured(const CurveRequest& request, const Pace& pace) {
  const CurveTask& task = request.task;
  Count numbers = 0;
  for (const ControlCurves& curves : request.curves.curves) {
    pace.spend(1);
    const Count width = Count{curves.width} + 2;
    numbers += curves.curve_count() *
               (Count{task.equal_lengths.value_or(0)} + Count{task.convergence.value_or(0)} * 2 + 4 * width +
                task.closest_to.size() * 3);
    if (task.flatten)
      pace.for_each(curves.curve_count(),
                    [&](Count c) { numbers += most_polyline_points(curves.points_of_curve(c)) * width; });
  }
  return numbers;
}

// --- Together ---------------------------------------------------------------------------------------------

Result<AnswerCounts> answer_counts(const CurveRequest& request, const Pace& pace) {
  AnswerCounts all;
  for (const ControlCurves& set : request.curves.curves) {
    pace.spend(1);
    all.curves += set.curve_count();
    all.names += set.name.size();
  }
  all.sets = request.curves.curves.size();
  switch (request.task.kind) {
    case CurveTaskKind::evaluate:
      all.numbers = numbers_sampled(request, pace);
      return all;
    case CurveTaskKind::measure:
      all.numbers = numbers_measured(request, pace);
      return all;
    default:
      break;
  }
  if (auto few = check_removals(request, all.curves); !few) return std::move(few).error();
  all.numbers = numbers_edited(request, pace);
  return all;
}

// Beside the numbers: what every curve has of its own, in vectors that grow, and every point to come close
// to.
Count bytes_beside(const CurveRequest& request, const AnswerCounts& all) {
  constexpr Count kOfMeasure = 1536, kOfClosestPoint = 160, kOfSet = 1536, kOfEdited = 320, kOfName = 8;
  switch (request.task.kind) {
    case CurveTaskKind::evaluate:
      return 0;  // takes what it keeps of curves when it does
    case CurveTaskKind::measure:
      break;
    default:
      return all.sets * kOfSet + all.curves * kOfEdited + all.names * kOfName;
  }
  const Count points =
      request.task.closest_width > 0 ? request.task.closest_to.size() / request.task.closest_width : 0;
  return all.curves * (kOfMeasure + points * kOfClosestPoint);
}

}  // namespace

Result<Count> predict_curve_task(const CurveRequest& request, Count most, const Budget& budget) {
  constexpr Count kTextOfNumber = 26, kBytesOfNumber = 64;
  const auto all = stoppable(budget, [&](const Pace& pace) { return answer_counts(request, pace); });
  if (!all) return all.error();
  const Count text = all->numbers * kTextOfNumber;
  if (text <= most) return all->numbers * kBytesOfNumber + bytes_beside(request, *all);
  return Error{.code = ErrorCode::too_large,
               .message = "the answer would take up to " + std::to_string(text) + " bytes; " +
                          std::to_string(most) + " are allowed: ask for less, or for fewer curves",
               .predicted = text,
               .allowed = most};
}

}  // namespace subdivd::server::tasks

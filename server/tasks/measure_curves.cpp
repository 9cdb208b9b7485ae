#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "core/curves/evaluable_curve.h"
#include "core/curves/flatten_subdivided.h"
#include "server/tasks/compute_curves.h"
#include "server/tasks/each_curve.h"

namespace subdivd::server::tasks {
namespace {

using proto::CurveMeasure;
using proto::CurveRequest;
using proto::CurveTask;

constexpr double kLengthTolerance = 1e-9;

Result<void> measure_closest(const Spline& spline, const CurveTask& task, ReusedMemory& memory,
                             CurveMeasure& measure) {
  measure.closest.reserve(task.closest_to.size() / std::max<Index>(task.closest_width, 1));
  if (!task.closest_to.empty() && task.closest_width != spline.dimension())
    return Error{ErrorCode::wrong_length,
                 "the points have " + std::to_string(task.closest_width) +
                     " coordinates, those of the curve " + std::to_string(spline.dimension()),
                 {"closestTo"}};
  const Count before = memory.used();
  for (std::size_t at = 0; at < task.closest_to.size(); at += task.closest_width) {
    auto closest =
        closest_point(spline, std::span(task.closest_to).subspan(at, task.closest_width), memory.budget());
    if (!closest) return at_member(std::move(closest).error(), "closestTo", at / task.closest_width);
    measure.closest.push_back(*std::move(closest));
    memory.free_to(before);
  }
  return {};
}

// A spline or a subdivided curve.
template <class Curve>
Result<Polyline> flatten_curve(const Curve& evaluable, const ControlCurves& curves, Count curve,
                               const CurveTask& task, const Budget& budget) {
  const FlattenOptions options = {.tolerance = *task.flatten,
                                  .max_points = most_polyline_points(curves.points_of_curve(curve))};
  auto polyline = flatten(evaluable, options, budget);
  if (!polyline) return at_member(std::move(polyline).error(), "flatten");
  return polyline;
}

// What has no formula has a polyline, and that only.
Result<CurveMeasure> measure_curve(const SubdividedCurve& evaluable, const ControlCurves& curves, Count curve,
                                   Count, const CurveTask& task, ReusedMemory& memory) {
  if (!task.flatten || task.equal_lengths || task.convergence || !task.closest_to.empty())
    return Error{
        ErrorCode::unsupported,
        "this curve has no polynomial pieces: it has no length or box here, only a polyline (flatten)",
        {"basis"}};
  CurveMeasure measure;
  auto polyline = flatten_curve(evaluable, curves, curve, task, memory.budget());
  if (!polyline) return std::move(polyline).error();
  measure.polyline = *std::move(polyline);
  return measure;
}

// What an error of a measurement is about: the curve itself, where it is left to be blamed on its set, or what
// was asked of it.
bool is_about_curve(const Error& error) {
  constexpr std::array<std::string_view, 3> kOfCurve{"basis", "points", "pointWeights"};
  const auto* const name = error.where.empty() ? nullptr : std::get_if<std::string>(&error.where[0]);
  return name != nullptr && std::ranges::count(kOfCurve, *name) != 0;
}
Error of_curve_or_member(Error error, const char* member) {
  return is_about_curve(error) ? std::move(error) : at_member(std::move(error), member);
}

// `first`: where the points of the curve begin.
Result<CurveMeasure> measure_curve(const Spline& spline, const ControlCurves& curves, Count curve,
                                   Count first, const CurveTask& task, ReusedMemory& memory) {
  const Budget& budget = memory.budget();
  const Count before = memory.used();  // one after the other takes the same memory
  CurveMeasure measure;
  // The box first: of weights too far apart it knows the number within the whole curve.
  auto box = bounds(spline, budget);
  if (!box) return std::move(box).error();
  measure.box = *std::move(box);
  memory.free_to(before);
  auto length = arc_length(spline,
                           {.tolerance = task.tolerance.value_or(kLengthTolerance),
                            .max_pieces = most_length_pieces(curves.points_of_curve(curve))},
                           budget);
  if (!length) return of_curve_or_member(std::move(length).error(), "tolerance");
  measure.length = *length;
  memory.free_to(before);
  if (auto done = measure_closest(spline, task, memory, measure); !done) return std::move(done).error();
  if (task.flatten) {
    auto polyline = flatten_curve(spline, curves, curve, task, budget);
    if (!polyline) return std::move(polyline).error();
    measure.polyline = *std::move(polyline);
  }
  memory.free_to(before);
  if (task.equal_lengths) {
    auto parameters = equal_parameters(spline, *task.equal_lengths,
                                       {.tolerance = kPositionOptions.tolerance,
                                        .max_pieces = most_length_pieces(curves.points_of_curve(curve))},
                                       budget);
    if (!parameters) return of_curve_or_member(std::move(parameters).error(), "equalLengths");
    measure.equal_parameters = *std::move(parameters);
  }
  memory.free_to(before);
  if (task.convergence) {
    auto convergence =
        measure_convergence(curves, static_cast<Index>(curve), first, *task.convergence, budget);
    if (!convergence) return at_member(std::move(convergence).error(), "convergence");
    measure.convergence = *std::move(convergence);
  }
  return measure;
}

}  // namespace

Result<std::vector<CurveMeasure>> compute_measures(const CurveRequest& request, const Budget& budget) {
  std::vector<CurveMeasure> all;
  Count count = 0;
  for (const ControlCurves& curves : request.curves.curves) count += curves.curve_count();
  all.reserve(count);  // they would be moved as often as the vector grew
  ReusedMemory memory(budget);
  Count first = 0;  // of the points of the present curve
  const auto measure = [&](const EvaluableCurve& curve, std::size_t set, Count ordinal) -> Result<void> {
    const ControlCurves& curves = request.curves.curves[set];
    if (ordinal == 0) first = 0;
    auto one = std::visit(
        [&](const auto& evaluable) {
          return measure_curve(evaluable, curves, ordinal, first, request.task, memory);
        },
        curve);
    if (!one) {
      Error error = std::move(one).error();
      if (!is_about_curve(error)) return error;
      // Weights are one for each point of the set.
      if (error.where.size() == 2) std::get<std::uint64_t>(error.where[1]) += first;
      return proto::blame_input(request.curves, std::move(error), "curves", set);
    }
    first += curves.points_of_curve(ordinal);
    all.push_back(*std::move(one));
    return {};
  };
  if (auto done = for_each_curve(request, memory, evaluable_curve, measure); !done)
    return std::move(done).error();
  return all;
}

}  // namespace subdivd::server::tasks

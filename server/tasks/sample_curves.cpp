#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "core/base/pace.h"
#include "core/curves/evaluable_curve.h"
#include "core/splines/bspline.h"
#include "core/splines/differential.h"
#include "core/splines/growing_memory.h"
#include "core/surfaces/patch.h"
#include "proto/prepare.h"
#include "server/tasks/compute_curves.h"
#include "server/tasks/each_curve.h"
#include "server/tasks/reused_memory.h"

namespace subdivd::server::tasks {
namespace {

using proto::CurveRequest;
using proto::CurveSamples;
using proto::CurveTask;

struct CurveInRequest {
  std::size_t set;
  Count curve;
  CurvePlace place;
};

Count curve_count(const CurveRequest& request) {
  Count count = 0;
  for (const ControlCurves& curves : request.curves.curves) count += curves.curve_count();
  return count;
}

std::vector<CurveInRequest> all_curves(const CurveRequest& request, const Pace& pace) {
  std::vector<CurveInRequest> all;
  all.reserve(curve_count(request));
  for (std::size_t i = 0; i < request.curves.curves.size(); ++i) {
    const std::vector<CurvePlace> places = curve_places(request.curves.curves[i], pace);
    pace.for_each(places.size(), [&](Count c) { all.push_back({i, c, places[c]}); });
  }
  return all;
}

// Elementary steps to work out one sample: the basis, and what is summed up over it.
Count steps_of_sample(const EvaluableCurve& curve, const CurveTask& task) {
  const Spline* spline = std::get_if<Spline>(&curve);
  const Count rows = (task.frames ? 4 : 1) + Count{task.derivatives};
  if (spline == nullptr) return 256 + 8 * rows * std::get<SubdividedCurve>(curve).dimension();
  const Count order = spline->degree + Count{1};
  return 64 + order * rows * (order + spline->width);
}

// What a curve keeps beside itself.
Count held_bytes(const EvaluableCurve& curve) {
  const Spline* spline = std::get_if<Spline>(&curve);
  if (spline == nullptr) return 0;
  return (spline->knots.capacity() + spline->points.capacity()) * sizeof(double) + 2 * kBytesPerBlock;
}

Error no_such(const char* what, const char* member, std::size_t sample, Index number, std::size_t count) {
  return {ErrorCode::out_of_range,
          std::string("there is no ") + what + ' ' + std::to_string(number) + "; the body has " +
              std::to_string(count),
          {"samples", member, std::uint64_t{sample}}};
}

// What a curve is like at one parameter, written behind what is known of the samples before.
class Sampler {
 public:
  Sampler(const CurveTask& task, CurveSamples& samples) : task_(task), samples_(samples) {}

  // The rows of the point and its derivatives, as many as are written and as the frame needs.
  Result<void> add(const Spline& spline, double t) {
    const Index dimension = spline.dimension();
    const Index order = task_.frames ? std::max<Index>(task_.derivatives, 3) : task_.derivatives;
    std::vector<double> rows((Count{order} + 1) * dimension);
    if (auto done = derivatives(spline, t, order, rows); !done) return done;
    if (task_.frames) describe(spline, t, std::span(rows).first(4 * std::size_t{dimension}));
    return keep(dimension, std::move(rows));
  }

  // Frames have a tangent only: there are no second derivatives.
  Result<void> add(const SubdividedCurve& curve, double t) {
    const Index dimension = curve.dimension();
    const Index order = std::max<Index>(task_.derivatives, task_.frames ? 1 : 0);
    std::vector<double> rows((Count{order} + 1) * dimension);
    if (auto done = derivatives(curve, t, order, rows); !done) return done;
    if (task_.frames) {
      auto tangent = unit_tangent(rows, dimension, {});
      samples_.frames.push_back(tangent ? std::optional(FrenetFrame{*std::move(tangent), {}, {}})
                                        : std::nullopt);
      samples_.curvatures.emplace_back();
      samples_.torsions.emplace_back();
    }
    return keep(dimension, std::move(rows));
  }

 private:
  void describe(const Spline& spline, double t, std::span<const double> rows) {
    const Index dimension = spline.dimension();
    std::vector<double> noise;
    if (auto known = derivative_noise(spline, t, 3)) noise = *std::move(known);
    auto frame = frenet_frame(rows, dimension, noise);
    if (!frame)  // a tangent at least
      if (auto tangent = unit_tangent(rows, dimension, noise))
        frame = FrenetFrame{*std::move(tangent), {}, {}};
    samples_.frames.push_back(std::move(frame));
    samples_.curvatures.push_back(curvature(rows, dimension, noise));
    samples_.torsions.push_back(dimension == 3 ? torsion(rows, noise) : std::nullopt);
  }

  Result<void> keep(Index dimension, std::vector<double> rows) {
    samples_.widths.push_back(dimension);
    samples_.rows.push_back(std::move(rows));
    return {};
  }

  const CurveTask& task_;
  CurveSamples& samples_;
};

// A fault of the parameter, or of what was asked for at it.
Error at_sample(Error error, const CurveTask& task, std::size_t sample) {
  if (error.where == Path{"order"})
    error.where = {task.derivatives > 0 ? "derivatives" : "frames"};
  else
    error.where = {"samples", "ts", std::uint64_t{sample}};
  return error;
}

// What every sample has, before any is known.
CurveSamples empty_samples(const CurveTask& task, const Pace& pace) {
  CurveSamples samples;
  pace.copy(task.sample_curves, samples.curves);
  pace.copy(task.sample_ts, samples.ts);
  samples.order = task.derivatives;
  samples.framed = task.frames;
  samples.widths.reserve(task.sample_ts.size());
  samples.rows.reserve(task.sample_ts.size());
  if (task.frames) {
    samples.frames.reserve(task.sample_ts.size());
    samples.curvatures.reserve(task.sample_ts.size());
    samples.torsions.reserve(task.sample_ts.size());
  }
  return samples;
}

// Curves are made when they are asked for, and kept.
class CurveCache {
 public:
  CurveCache(const CurveRequest& request, ReusedMemory& memory, const Pace& pace)
      : request_(request), memory_(memory), places_(all_curves(request, pace)) {
    pace.fill(curves_, places_.size(), std::nullopt);
  }

  std::size_t size() const { return places_.size(); }
  std::size_t set_of(Index number) const { return places_[number].set; }

  Result<const EvaluableCurve*> curve(Index number) {
    std::optional<EvaluableCurve>& curve = curves_[number];
    if (curve) return &*curve;
    const Budget& budget = memory_.budget();
    const auto& [set, ordinal, place] = places_[number];
    const Count kept = memory_.used(), bytes = spline_bytes(request_.curves.curves[set], ordinal);
    if (auto taken = budget.take_memory(bytes); !taken) return std::move(taken).error();
    auto made = evaluable_curve(request_.curves.curves[set], ordinal, place, budget);
    if (!made) return proto::blame_input(request_.curves, std::move(made).error(), "curves", set);
    curve = *std::move(made);
    memory_.free_to(kept);
    if (auto taken = budget.take_memory(held_bytes(*curve)); !taken) return std::move(taken).error();
    return &*curve;
  }

 private:
  const CurveRequest& request_;
  ReusedMemory& memory_;
  std::vector<CurveInRequest> places_;
  std::vector<std::optional<EvaluableCurve>> curves_;
};

Result<CurveSamples> sample_curves(const CurveRequest& request, ReusedMemory& memory, const Pace& pace) {
  const CurveTask& task = request.task;
  CurveCache cache(request, memory, pace);
  CurveSamples samples = empty_samples(task, pace);
  Sampler sampler(task, samples);
  for (std::size_t k = 0; k < task.sample_ts.size(); ++k) {
    const Index number = task.sample_curves[k];
    if (number >= cache.size()) return no_such("curve", "curves", k, number, cache.size());
    const auto curve = cache.curve(number);
    if (!curve) return curve.error();
    pace.spend(steps_of_sample(**curve, task));
    const auto done =
        std::visit([&](const auto& one) { return sampler.add(one, task.sample_ts[k]); }, **curve);
    if (!done && done.error().where == Path{"points"})  // too large, at whatever parameter
      return proto::blame_input(request.curves, done.error(), "curves", cache.set_of(number));
    if (!done) return at_sample(done.error(), task, k);
  }
  return samples;
}

}  // namespace

Result<CurveSamples> compute_samples(const CurveRequest& request, const Budget& budget) {
  ReusedMemory memory(budget);
  constexpr Count kOfCurve =
      sizeof(CurveInRequest) + 3 * sizeof(CurvePlace) + sizeof(std::optional<EvaluableCurve>);
  if (auto taken = memory.budget().take_memory(curve_count(request) * kOfCurve); !taken) return taken.error();
  return stoppable(memory.budget(), [&](const Pace& pace) { return sample_curves(request, memory, pace); });
}

namespace {

Result<proto::SurfaceSamples> sample_surfaces(const CurveRequest& request, const Pace& pace) {
  const CurveTask& task = request.task;
  const std::vector<ControlPatch>& surfaces = request.curves.surfaces;
  proto::SurfaceSamples samples;
  samples.samples.reserve(task.sample_us.size());
  for (std::size_t k = 0; k < task.sample_us.size(); ++k) {
    pace.spend(64);
    const Index number = task.sample_surfaces[k];
    if (number >= surfaces.size()) return no_such("surface", "surfaces", k, number, surfaces.size());
    auto sample = evaluate<double>(surfaces[number], task.sample_us[k], task.sample_vs[k]);
    if (sample) {
      samples.samples.push_back(*std::move(sample));
      continue;
    }
    // A parameter is blamed by its name, u or v; numbers that outgrow their type are those of the surface.
    Error error = std::move(sample).error();
    const bool u = error.where == Path{"u"};
    if (!u && error.where != Path{"v"})
      return proto::blame_input(request.curves, std::move(error), "surfaces", number);
    error.where = {"samples", u ? "us" : "vs", std::uint64_t{k}};
    return error;
  }
  return samples;
}

}  // namespace

Result<proto::SurfaceSamples> compute_surface_samples(const CurveRequest& request, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) { return sample_surfaces(request, pace); });
}

}  // namespace subdivd::server::tasks

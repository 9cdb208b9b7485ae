#include "server/tasks/curve_task.h"

#include <utility>

#include "server/tasks/compute_curves.h"

namespace subdivd::server::tasks {
namespace {

// `computed` as `encode` writes it.
template <class T, class Encode>
Result<proto::Payload> write(Result<T> computed, Phases& phases, Encode&& encode) {
  phases.end("compute");
  if (!computed) return std::move(computed).error();
  auto payload = encode(*std::move(computed));
  phases.end("write");
  return payload;
}

}  // namespace

Result<proto::Payload> answer_curves(const proto::CurveRequest& request, const proto::Limits& limits,
                                     const Budget& budget, Phases& phases) {
  const auto bytes = predict_curve_task(request, limits.max_output_bytes, budget);
  if (!bytes) return bytes.error();
  if (auto taken = budget.take_memory(*bytes); !taken) return std::move(taken).error();
  switch (request.task.kind) {
    case proto::CurveTaskKind::evaluate:
      if (request.task.on_surfaces)
        return write(compute_surface_samples(request, budget), phases,
                     [&](auto samples) { return proto::encode_samples(request, samples, budget); });
      return write(compute_samples(request, budget), phases,
                   [&](auto samples) { return proto::encode_samples(request, samples, budget); });
    case proto::CurveTaskKind::measure:
      return write(compute_measures(request, budget), phases,
                   [&](auto measures) { return proto::encode_measures(request, measures, budget); });
    default:
      return write(compute_edited(request, budget), phases,
                   [&](auto edited) { return proto::encode_edited(request, std::move(edited), budget); });
  }
}

}  // namespace subdivd::server::tasks

// Bodies under /v1/curves: the first byte says what is asked, the rest is the body. What is accepted is
// answered within its time with JSON that another parser reads, or refused with a reason that is not ours.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "core/curves/subdivision.h"
#include "proto/curve_task.h"
#include "proto/problem.h"
#include "server/tasks/compute_curves.h"
#include "tests/support/payload_text.h"

namespace {

using namespace subdivd;
using Kind = proto::CurveTaskKind;

void require(bool fact) {
  if (!fact) std::abort();
}

// nlohmann writes what is not finite as null; nothing but a missing direction may be that.
void require_answer(const proto::Payload& payload) {
  require(nlohmann::json::accept(test::text_of(payload)));
}

template <class Found>
bool found(const Result<Found>& result) {
  if (result) return true;
  require(result.error().code != ErrorCode::internal);
  return false;
}

// A refusal late in the work is an answer, too.
void answer_with(const Result<proto::Payload>& payload) {
  if (found(payload)) require_answer(*payload);
}

void answer(const proto::CurveRequest& request, const Budget& budget) {
  switch (request.task.kind) {
    case Kind::refine:
      for (const ControlCurves& curves : request.curves.curves)
        (void)found(refine<double>(curves, proto::curve_options(request.curves, curves), budget));
      for (const ControlPatch& surface : request.curves.surfaces)
        (void)found(refine<double>(surface, proto::patch_options(request.curves, surface), budget));
      return;
    case Kind::evaluate:
      if (request.task.on_surfaces) {
        if (const auto samples = server::tasks::compute_surface_samples(request, budget); found(samples))
          answer_with(proto::encode_samples(request, *samples, budget));
        return;
      }
      if (const auto samples = server::tasks::compute_samples(request, budget); found(samples))
        answer_with(proto::encode_samples(request, *samples, budget));
      return;
    case Kind::measure:
      if (const auto measures = server::tasks::compute_measures(request, budget); found(measures))
        answer_with(proto::encode_measures(request, *measures, budget));
      return;
    default:
      if (auto edited = server::tasks::compute_edited(request, budget); found(edited))
        if (const auto payload = proto::encode_edited(request, *std::move(edited)); found(payload))
          require_answer(*payload);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto kind = static_cast<Kind>(data[0] % 6);
  const std::string_view body(reinterpret_cast<const char*>(data) + 1, size - 1);
  proto::Limits limits;
  limits.max_level = 3;
  limits.max_output_bytes = 1 << 20;
  const auto request = proto::decode_curves(body, kind, {}, limits);
  if (!request) {
    require(request.error().code != ErrorCode::internal);
    require(nlohmann::json::accept(proto::problem_json(proto::to_problem(request.error(), 422))));
    return 0;
  }
  for (const ControlCurves& curves : request->curves.curves) require(curves.check().ok());
  for (const ControlPatch& surface : request->curves.surfaces) require(surface.check().ok());
  if (!server::tasks::predict_curve_task(*request, limits.max_output_bytes)) return 0;
  Budget budget;
  budget.max_bytes = Count{64} << 20;
  budget.deadline = Budget::Clock::now() + std::chrono::milliseconds(500);
  answer(*request, budget);
  return 0;
}

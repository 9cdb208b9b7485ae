#pragma once
// What must hold for a body of OBJ or OFF, whatever it is.

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "proto/decode.h"
#include "proto/problem.h"
#include "server/tasks/refine_task.h"
#include "tests/support/payload_text.h"

namespace subdivd::test {

inline void require(bool fact) {
  if (!fact) std::abort();
}

// As OBJ or OFF: as long as it says, no longer than predicted, and read again, unless nothing was left to write.
inline void try_text_answer(proto::RefineRequest request, proto::Format format, const proto::Limits& limits) {
  request.options.format = format;
  if (!proto::check_format(request, {})) return;
  const auto predicted = proto::predict_refine(request, limits);
  if (!predicted) return;
  server::tasks::Phases phases;
  const auto payload = server::tasks::refine(request, limits, Budget{}, phases);
  if (!payload) return;
  const std::string text = test::text_of(*payload);
  require(text.size() == payload->size() && text.size() <= predicted->answer_bytes);
  const auto kind = format == proto::Format::obj ? proto::BodyKind::obj : proto::BodyKind::off;
  const auto again = proto::decode_refine(text, kind, {}, proto::Limits{});
  require(again.ok() || again.error().code == ErrorCode::missing_field ||
          again.error().code == ErrorCode::wrong_length || again.error().code == ErrorCode::not_a_triangle);
}

// What is accepted has passed check(), and its answer is JSON; what is refused, is refused in words.
inline void try_text_body(std::string_view body, proto::BodyKind kind) {
  proto::Limits limits;
  limits.max_level = 2;
  limits.max_output_bytes = 1 << 20;
  for (const char* triangulate : {"false", "true"}) {
    const auto request = proto::decode_refine(body, kind, {{"triangulate", triangulate}}, limits);
    if (!request) {
      require(request.error().code != ErrorCode::internal);
      require(nlohmann::json::accept(proto::problem_json(proto::to_problem(request.error(), 422))));
      continue;
    }
    for (const ControlMesh& mesh : request->meshes) require(mesh.check().ok());
    for (const ControlCurves& curves : request->curves) require(curves.check().ok());
    if (!proto::predict_refine(*request, limits)) continue;
    server::tasks::Phases phases;
    const auto payload = server::tasks::refine(*request, limits, Budget{}, phases);
    if (payload) require(nlohmann::json::accept(test::text_of(*payload)));
    for (const proto::Format format : {proto::Format::obj, proto::Format::off})
      try_text_answer(*request, format, limits);
  }
}

}  // namespace subdivd::test

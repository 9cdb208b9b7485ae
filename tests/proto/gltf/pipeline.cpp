#include "tests/proto/gltf/pipeline.h"

#include <stdexcept>
#include <utility>

#include "proto/decode.h"
#include "server/tasks/refine_task.h"
#include "tests/support/payload_text.h"

namespace subdivd::test {

using namespace proto;

std::string to_pointer(const Path& path) {
  std::string pointer;
  for (const PathStep& step : path) {
    pointer += '/';
    if (const auto* name = std::get_if<std::string>(&step)) {
      pointer += *name;
    } else {
      pointer += std::to_string(std::get<std::uint64_t>(step));
    }
  }
  return pointer;
}

Result<Outcome> answer(RefineRequest request) {
  if (!request.options.format) request.options.format = Format::glb;
  const auto predicted = predict_refine(request, Limits{});
  if (!predicted) return predicted.error();
  server::tasks::Phases phases;
  const auto payload = server::tasks::refine(request, Limits{}, Budget{}, phases);
  if (!payload) return payload.error();
  return Outcome{std::move(request), predicted->answer_bytes, text_of(*payload)};
}

Result<Outcome> refine_gltf(const std::string& body, Format format, Options options, const Limits& limits) {
  auto request = gltf::read(body, format, options, limits);
  if (!request) return request.error();
  request->options.format = options.format.value_or(format);
  if (auto ready = make_ready(*request, {}, limits); !ready) return ready.error();
  return answer(*std::move(request));
}

Outcome must_refine(const std::string& body, Options options, Format format) {
  auto outcome = refine_gltf(body, format, options);
  if (!outcome) throw std::runtime_error(to_pointer(outcome.error().where) + ": " + outcome.error().message);
  return *std::move(outcome);
}

RefineRequest must_read(const std::string& body, Options options, Format format) {
  auto request = gltf::read(body, format, options, {});
  if (!request) throw std::runtime_error(to_pointer(request.error().where) + ": " + request.error().message);
  return *std::move(request);
}

}  // namespace subdivd::test

#include "tests/proto/gltf/pipeline.h"

#include <stdexcept>
#include <utility>

namespace subdivd::test {

using namespace proto;

std::string to_string(const Payload& payload) {
  std::string text;
  for (const Chunk& chunk : payload.chunks)
    text.append(reinterpret_cast<const char*>(chunk.bytes.data()), chunk.bytes.size());
  return text;
}

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
  RefineOptions options{.level = request.options.level,
                        .schemes = request.options.schemes,
                        .crease_method = request.options.crease_method,
                        .limit = request.options.limit,
                        .normals = request.options.normals};
  RefineAnswer<float> refined;
  std::vector<RefinedSize> sizes;
  for (const ControlMesh& mesh : request.meshes) {
    auto size = predict_size<float>(mesh, options);
    if (!size) return size.error();
    sizes.push_back(*size);
    auto made = refine<float>(mesh, options, Budget());
    if (!made) return made.error();
    refined.meshes.push_back(*std::move(made));
  }
  for (const ControlCurves& curves : request.curves) {
    auto made =
        refine<float>(curves, CurveOptions{request.options.level, request.options.limit, false}, Budget());
    if (!made) return made.error();
    refined.curves.push_back(*std::move(made));
  }
  Outcome outcome;
  const auto predicted = gltf::predicted_bytes(request, sizes);
  if (!predicted) return predicted.error();
  outcome.predicted = *predicted;
  auto payload = gltf::write(request, std::move(refined), request.options.format.value_or(Format::glb),
                             R"({"options":{"level":2}})");
  if (!payload) return payload.error();
  outcome.bytes = to_string(*payload);
  outcome.request = std::move(request);
  return outcome;
}

Result<Outcome> refine_gltf(const std::string& body, Format format, Options options, const Limits& limits) {
  auto request = gltf::read(body, format, options, limits);
  if (!request) return request.error();
  for (ControlMesh& mesh : request->meshes) {
    if (options.interpolate_boundary) mesh.interpolate_boundary = *options.interpolate_boundary;
    if (auto dropped = drop_degenerate_faces(mesh); !dropped) return dropped.error();
    if (auto good = mesh.check(); !good) return good.error();
  }
  for (const ControlCurves& curves : request->curves)
    if (auto good = curves.check(); !good) return good.error();
  request->options.format = options.format.value_or(format);
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

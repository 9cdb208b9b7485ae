#include "tests/proto/support.h"

#include <fstream>
#include <iterator>
#include <utility>

#include "core/curves/subdivision.h"
#include "core/refine/refine.h"
#include "proto/problem.h"

namespace subdivd::proto::test {
namespace {

template <class Real>
Result<AnyAnswer> compute_as(const RefineRequest& request) {
  RefineAnswer<Real> answer;
  for (const ControlMesh& mesh : request.meshes) {
    Result<RefinedMesh<Real>> refined = refine<Real>(mesh, mesh_options(request), Budget{});
    if (!refined) return refined.error();
    answer.meshes.push_back(std::move(*refined));
  }
  for (const ControlCurves& curves : request.curves) {
    Result<RefinedCurves<Real>> refined = refine<Real>(curves, curve_options(request, curves), Budget{});
    if (!refined) return refined.error();
    answer.curves.push_back(std::move(*refined));
  }
  for (const ControlPatch& surface : request.surfaces) {
    Result<RefinedPatch<Real>> refined = refine<Real>(surface, patch_options(request, surface), Budget{});
    if (!refined) return refined.error();
    answer.surfaces.push_back(std::move(*refined));
  }
  return AnyAnswer(std::move(answer));
}

}  // namespace

Result<RefineRequest> decode(std::string_view body, const QueryParameters& query, const Limits& limits) {
  return decode_refine(body, BodyKind::json, query, limits);
}

std::string refusal(std::string_view body, const QueryParameters& query, const Limits& limits) {
  const Result<RefineRequest> request = decode(body, query, limits);
  if (request) return "accepted";
  const Problem problem = to_problem(request.error(), 422);
  if (problem.errors.empty()) return problem.code;
  const ProblemItem& item = problem.errors.front();
  std::string text = item.code;
  text += item.parameter.empty() ? " " : " ?";
  return text + (item.parameter.empty() ? item.pointer : item.parameter);
}

std::string message(std::string_view body, const QueryParameters& query) {
  const Result<RefineRequest> request = decode(body, query);
  return request ? std::string() : request.error().message;
}

Result<AnyAnswer> compute(const RefineRequest& request) {
  return answer_precision(request) == Precision::single_precision ? compute_as<float>(request)
                                                                  : compute_as<double>(request);
}

std::string text_of(const Payload& payload) {
  std::string text;
  for (const Chunk& chunk : payload.chunks)
    text.append(reinterpret_cast<const char*>(chunk.bytes.data()), chunk.bytes.size());
  return text;
}

Result<std::string> answer(std::string_view body, const QueryParameters& query, const Limits& limits) {
  Result<RefineRequest> request = decode(body, query, limits);
  if (!request) return request.error();
  const Result<Prediction> prediction = predict_refine(*request, limits);
  if (!prediction) return prediction.error();
  Result<AnyAnswer> computed = compute(*request);
  if (!computed) return computed.error();
  Result<Payload> payload = encode_refine(*request, std::move(*computed));
  if (!payload) return payload.error();
  return text_of(*payload);
}

std::uint64_t Random::next() {
  state_ += 0x9E3779B97F4A7C15u;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

std::string source_file(const std::string& name) {
  std::ifstream stream(std::string(SUBDIVD_SOURCE_DIR) + "/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace subdivd::proto::test

#include "tests/proto/support.h"

#include <fstream>
#include <iterator>
#include <utility>

#include "proto/problem.h"
#include "server/tasks/refine_task.h"
#include "tests/support/payload_text.h"

namespace subdivd::proto::test {

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

Result<AnyAnswer> compute(const RefineRequest& request) { return server::tasks::compute(request, Limits{}); }

Result<std::string> answer(std::string_view body, const QueryParameters& query, const Limits& limits) {
  Result<RefineRequest> request = decode(body, query, limits);
  if (!request) return request.error();
  server::tasks::Phases phases;
  Result<Payload> payload = server::tasks::refine(*request, limits, Budget{}, phases);
  if (!payload) return payload.error();
  return subdivd::test::text_of(*payload);
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

#include "server/http/status.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <variant>

#include "proto/problem.h"

namespace subdivd::server {
namespace {

struct Title {
  std::string_view code, title;
};

constexpr std::array kTitles = {
    Title{"bad_request", "The request is not well-formed HTTP"},
    Title{"uri_too_long", "The request target is too long"},
    Title{"headers_too_large", "The head of the request is too large"},
    Title{"request_timeout", "The request did not arrive in time"},
    Title{"incomplete_body", "The body did not arrive whole"},
    Title{"body_too_large", "The body is too large"},
    Title{"expectation_failed", "The expectation cannot be met"},
    Title{"http_version_not_supported", "The HTTP version is not supported"},
    Title{"not_implemented", "The transfer encoding is not supported"},
    Title{"not_found", "There is nothing at this path"},
    Title{"method_not_allowed", "The method is not allowed here"},
    Title{"not_acceptable", "No answer of an acceptable kind can be given"},
    Title{"unsupported_media_type", "The kind of the body is not supported"},
    Title{"unsupported_encoding", "The encoding of the body is not supported"},
    Title{"overloaded", "The server is busy"},
    Title{"shutting_down", "The server is shutting down"},
    Title{"not_ready", "The server is not ready"},
    Title{"internal", "The server failed"},
};

bool blames_query(const Error& error) {
  const auto* first = error.where.empty() ? nullptr : std::get_if<std::string>(&error.where.front());
  return first != nullptr && first->starts_with('?');
}

Response response_of(const proto::Problem& problem) {
  Response response;
  response.status = problem.status;
  response.content_type = proto::kProblemContentType;
  if (problem.status == 503) response.headers.emplace_back("Retry-After", "1");
  response.body.push_back(Bytes::of(proto::problem_json(problem)));
  return response;
}

}  // namespace

int status_of(const Error& error) {
  switch (error.code) {
    case ErrorCode::malformed:
      return 400;
    case ErrorCode::deadline_exceeded:
    case ErrorCode::cancelled:
    case ErrorCode::overloaded:
      return 503;
    case ErrorCode::internal:
      return 500;
    default:
      return blames_query(error) && error.code != ErrorCode::too_large ? 400 : 422;
  }
}

std::string_view title_of_refusal(std::string_view code) {
  const auto found =
      std::find_if(kTitles.begin(), kTitles.end(), [&](const Title& title) { return title.code == code; });
  return found == kTitles.end() ? std::string_view("The request was refused") : found->title;
}

std::vector<std::string_view> refusal_codes() {
  std::vector<std::string_view> codes;
  for (const Title& title : kTitles) codes.push_back(title.code);
  return codes;
}

Response problem_response(const Error& error) {
  return response_of(proto::to_problem(error, status_of(error)));
}

Response problem_response(const Refusal& refusal) {
  proto::Problem problem;
  problem.status = refusal.status;
  problem.code = refusal.code;
  problem.title = title_of_refusal(refusal.code);
  problem.detail = refusal.detail;
  if (refusal.predicted != 0) problem.predicted = refusal.predicted;
  if (refusal.allowed != 0) problem.allowed = refusal.allowed;
  return response_of(problem);
}

}  // namespace subdivd::server

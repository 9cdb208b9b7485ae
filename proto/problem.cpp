#include "proto/problem.h"

#include <nlohmann/json.hpp>
#include <variant>

#include "proto/client_text.h"

namespace subdivd::proto {
namespace {

using Json = nlohmann::ordered_json;

void append_escaped(std::string& pointer, std::string_view step) {
  for (const char c : step) {
    if (c == '~')
      pointer += "~0";
    else if (c == '/')
      pointer += "~1";
    else
      pointer += c;
  }
}

// "name" when the path leads to a query parameter, otherwise empty.
std::string parameter_of(const Path& where) {
  if (where.empty()) return {};
  const auto* first = std::get_if<std::string>(&where.front());
  if (first == nullptr || !first->starts_with('?')) return {};
  return client_text(std::string_view(*first).substr(1));
}

}  // namespace

std::string json_pointer(const Path& path) {
  std::string pointer;
  for (const PathStep& step : path) {
    pointer += '/';
    if (const auto* name = std::get_if<std::string>(&step))
      append_escaped(pointer, client_text(*name));
    else
      pointer += std::to_string(std::get<std::uint64_t>(step));
  }
  return pointer;
}

std::string_view title_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::malformed:
      return "The body is not what it claims to be";
    case ErrorCode::missing_field:
      return "A required member is missing";
    case ErrorCode::unknown_field:
      return "A member or option does not exist";
    case ErrorCode::duplicate_field:
      return "A member is given twice";
    case ErrorCode::wrong_type:
      return "A value has the wrong type";
    case ErrorCode::out_of_range:
      return "A number is outside its range";
    case ErrorCode::bad_enum:
      return "A word is not among the valid ones";
    case ErrorCode::wrong_length:
      return "Array lengths contradict each other";
    case ErrorCode::not_finite:
      return "A number is not finite";
    case ErrorCode::not_a_triangle:
      return "A face is neither a triangle nor a larger polygon";
    case ErrorCode::not_an_edge:
      return "A crease runs where there is no edge";
    case ErrorCode::duplicate_tag:
      return "A corner or hole is given twice";
    case ErrorCode::too_few_points:
      return "A curve has too few points";
    case ErrorCode::unsupported:
      return "This version cannot process the request";
    case ErrorCode::too_large:
      return "The request exceeds a limit";
    case ErrorCode::deadline_exceeded:
      return "The time for the request ran out";
    case ErrorCode::cancelled:
      return "The request was cancelled";
    case ErrorCode::overloaded:
      return "The server is busy";
    case ErrorCode::internal:
      return "The server failed";
  }
  return "The server failed";
}

std::string problem_json(const Problem& problem) {
  Json json;
  json["type"] = std::string("urn:subdivd:problem:") + problem.code;
  json["title"] = problem.title;
  json["status"] = problem.status;
  json["detail"] = problem.detail;
  json["code"] = problem.code;
  if (!problem.errors.empty()) {
    Json items = Json::array();
    for (const ProblemItem& item : problem.errors) {
      Json one;
      if (item.parameter.empty())
        one["pointer"] = item.pointer;
      else
        one["parameter"] = item.parameter;
      one["code"] = item.code;
      one["detail"] = item.detail;
      items.push_back(std::move(one));
    }
    json["errors"] = std::move(items);
  }
  if (problem.predicted) json["predicted"] = *problem.predicted;
  if (problem.allowed) json["allowed"] = *problem.allowed;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Problem to_problem(const Error& error, int status) {
  Problem problem;
  problem.status = status;
  problem.code = name_of(error.code);
  problem.title = title_of(error.code);
  if (error.code == ErrorCode::internal) {
    problem.detail = "Something went wrong on our side";
    return problem;
  }
  problem.detail = error.message;
  ProblemItem item;
  item.parameter = parameter_of(error.where);
  if (item.parameter.empty()) item.pointer = json_pointer(error.where);
  item.code = problem.code;
  item.detail = error.message;
  // Nothing in the body is to blame when the clock, the caller or the lack of memory ended the work.
  if (error.code != ErrorCode::deadline_exceeded && error.code != ErrorCode::cancelled &&
      error.code != ErrorCode::overloaded)
    problem.errors.push_back(std::move(item));
  if (error.code == ErrorCode::too_large && (error.predicted != 0 || error.allowed != 0)) {
    problem.predicted = error.predicted;
    problem.allowed = error.allowed;
  }
  return problem;
}

}  // namespace subdivd::proto

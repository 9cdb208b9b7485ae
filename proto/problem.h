#pragma once
// Refusals as they travel: application/problem+json (RFC 9457).

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace subdivd::proto {

struct ProblemItem {
  std::string pointer;    // JSON Pointer (RFC 6901) into the body; empty: the body as a whole
  std::string code;       // as Problem::code
  std::string detail;     // one sentence for people
  std::string parameter;  // name of the query parameter to blame; empty: the body is
};

struct Problem {
  int status = 500;
  std::string code;    // stable, snake_case: name_of(ErrorCode), or one of the transport's own
  std::string title;   // the same for every occurrence of the code
  std::string detail;  // of this occurrence
  std::vector<ProblemItem> errors;
  std::optional<std::uint64_t> predicted, allowed;  // where a limit refuses
};

inline constexpr std::string_view kProblemContentType = "application/problem+json";

// The JSON text. `type` is "urn:subdivd:problem:<code>". Bytes that are not UTF-8 become U+FFFD.
std::string problem_json(const Problem& problem);

// Title and pointer (or parameter, when `where` begins with "?name") from an Error. The text of
// ErrorCode::internal stays inside: the caller only learns that we failed.
Problem to_problem(const Error& error, int status);

// One sentence without an article's full stop, e.g. "A number is outside its range".
std::string_view title_of(ErrorCode code);

// RFC 6901: every step after a '/', '~' as "~0", '/' as "~1". Names are cut as client_text.h says.
std::string json_pointer(const Path& path);

}  // namespace subdivd::proto

#pragma once
// Bodies of text, through the door.

#include <string>
#include <string_view>

#include "proto/decode.h"

namespace subdivd::proto::test {

// A line that is at fault, and what the refusal says of it.
struct BadLine {
  const char *line, *expected;
};

// "code message" of the refusal, "accepted" when there is none.
inline std::string text_refusal(std::string_view body, BodyKind kind, const QueryParameters& query = {},
                                const Budget& budget = {}) {
  // An exact-size copy on the heap: AddressSanitizer sees a read past the end.
  const std::string copy(body);
  const auto request = decode_refine(copy, kind, query, {}, budget);
  return request ? "accepted" : std::string(name_of(request.error().code)) + ' ' + request.error().message;
}

// Every beginning of the body is answered, whatever the answer is.
inline void decode_beginnings(std::string_view body, BodyKind kind) {
  for (std::size_t size = 0; size <= body.size(); ++size) (void)text_refusal(body.substr(0, size), kind);
}

}  // namespace subdivd::proto::test

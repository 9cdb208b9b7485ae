#pragma once
// The head of a request: request line and header fields, judged before anything else looks at them.
//
// cpp-httplib reads leniently: Transfer-Encoding beside Content-Length, two Content-Lengths, "abc" as a
// length and percent-escapes in values all pass. Whatever two parsers can read differently lets an attacker
// smuggle a request past a proxy, so this one reads strictly and everything after it only sees the result.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "server/transport/message.h"
#include "server/transport/service.h"

namespace subdivd::server {

inline constexpr std::size_t kMaxHeadBytes = 32 * 1024;
inline constexpr std::size_t kMaxTargetBytes = 8 * 1024;
inline constexpr std::size_t kMaxHeaders = 100;

struct Head {
  enum class Framing { none, length, chunked };

  std::string method;
  std::string target;
  int minor_version = 1;
  std::vector<Field> headers;  // names lower-cased, values trimmed
  Framing framing = Framing::none;
  std::uint64_t content_length = 0;
  bool keep_alive = true;
  bool expects_continue = false;

  bool has_body() const { return framing == Framing::chunked || content_length > 0; }
};

// `text` is everything up to and including the empty line.
std::variant<Head, Refusal> parse_head(std::string_view text);

}  // namespace subdivd::server

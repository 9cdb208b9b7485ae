#include "server/transport/head.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "server/transport/authority.h"
#include "server/transport/grammar.h"

namespace subdivd::server {
namespace {

constexpr std::string_view kLineEnd = "\r\n";

Refusal bad(std::string detail) { return {400, "bad_request", std::move(detail)}; }

// Does a comma-separated list hold `word` (lower-case)?
bool lists(std::string_view list, std::string_view word) {
  while (!list.empty()) {
    const std::string_view item = list.substr(0, list.find(','));
    if (lowered(trimmed(item)) == word) return true;
    list.remove_prefix(std::min(list.size(), item.size() + 1));
  }
  return false;
}

std::optional<Refusal> read_request_line(std::string_view line, Head& head) {
  const std::size_t first = line.find(' ');
  const std::size_t last = line.rfind(' ');
  if (first == std::string_view::npos || first == last)
    return bad("the request line must be a method, a target and a version with one space between them");
  head.method = line.substr(0, first);
  head.target = line.substr(first + 1, last - first - 1);
  const std::string_view version = line.substr(last + 1);
  if (!is_token(head.method)) return bad("the method is no token");
  if (head.target.size() > kMaxTargetBytes)
    return Refusal{414, "uri_too_long", "the request target is longer than 8192 bytes", head.target.size(),
                   kMaxTargetBytes};
  const bool visible = std::all_of(head.target.begin(), head.target.end(),
                                   [](char c) { return c > ' ' && c < 0x7F && c != '#'; });
  if (!visible) return bad("the request target holds bytes that must be percent-encoded");
  if (version == "HTTP/1.1") {
    head.minor_version = 1;
  } else if (version == "HTTP/1.0") {
    head.minor_version = 0;
  } else if (version.starts_with("HTTP/")) {
    return Refusal{505, "http_version_not_supported", "this server speaks HTTP/1.1 and HTTP/1.0"};
  } else {
    return bad("the request line must end in HTTP/1.1");
  }
  return std::nullopt;
}

std::optional<Refusal> read_header_line(std::string_view line, Head& head) {
  // A line that begins with a blank continues the one before (obs-fold): parsers differ, so nobody may.
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return bad("a header line has no colon");
  if (!is_token(line.substr(0, colon))) return bad("a header name holds a character that no name may hold");
  const std::string_view value = trimmed(line.substr(colon + 1));
  if (!std::all_of(value.begin(), value.end(), is_text_character))
    return bad("a header value holds a control character");
  if (head.headers.size() == kMaxHeaders)
    return Refusal{431, "headers_too_large", "a request may have 100 header lines"};
  head.headers.emplace_back(lowered(line.substr(0, colon)), value);
  return std::nullopt;
}

std::optional<Refusal> read_length(const std::string& value, Head& head) {
  const char* end = value.data() + value.size();
  const bool digits =
      !value.empty() && value.size() <= 18 && std::all_of(value.begin(), value.end(), is_digit);
  if (!digits || std::from_chars(value.data(), end, head.content_length).ptr != end)
    return bad("Content-Length must be one decimal number");
  head.framing = Head::Framing::length;
  return std::nullopt;
}

// Decides where the request ends and whether another may follow.
std::optional<Refusal> read_framing(Head& head) {
  const int minor_version = head.minor_version;
  int hosts = 0, lengths = 0, encodings = 0;
  head.keep_alive = minor_version == 1;
  for (const auto& [name, value] : head.headers) {
    if (name == "host") {
      ++hosts;
      // Empty is what a client sends that has no name for us [RFC 9112, 3.2].
      if (!value.empty() && !is_authority(value)) return bad("Host must be a name or an address, and a port");
    } else if (name == "content-length") {
      if (++lengths > 1) return bad("Content-Length is given more than once");
      if (auto refusal = read_length(value, head)) return refusal;
    } else if (name == "transfer-encoding") {
      if (++encodings > 1) return bad("Transfer-Encoding is given more than once");
      if (lowered(value) != "chunked")
        return Refusal{501, "not_implemented", "the only transfer encoding known here is chunked"};
    } else if (name == "connection") {
      if (lists(value, "close")) head.keep_alive = false;
    } else if (name == "expect") {
      if (lowered(value) != "100-continue")
        return Refusal{417, "expectation_failed", "the only expectation known here is 100-continue"};
      head.expects_continue = minor_version == 1;
    }
  }
  if (hosts > 1 || (hosts == 0 && minor_version == 1)) return bad("a request must have one Host header");
  if (encodings == 0) return std::nullopt;
  if (lengths > 0) return bad("Transfer-Encoding and Content-Length exclude each other");
  if (minor_version == 0) return bad("HTTP/1.0 knows no Transfer-Encoding");
  head.framing = Head::Framing::chunked;
  return std::nullopt;
}

}  // namespace

std::variant<Head, Refusal> parse_head(std::string_view text) {
  Head head;
  bool first = true;
  while (!text.empty()) {
    const std::size_t end = text.find(kLineEnd);
    if (end == std::string_view::npos) return bad("a line of the head does not end in CR LF");
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + kLineEnd.size());
    if (line.find_first_of(std::string_view("\r\n\0", 3)) != std::string_view::npos)
      return bad("a line of the head holds a bare CR, LF or NUL");
    if (line.empty()) break;
    auto refusal = first ? read_request_line(line, head) : read_header_line(line, head);
    if (refusal) return *std::move(refusal);
    first = false;
  }
  if (first) return bad("the request is empty");
  if (auto refusal = read_framing(head)) return *std::move(refusal);
  return head;
}

}  // namespace subdivd::server

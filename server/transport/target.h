#pragma once
// Request targets: "/v1/refine?level=3" taken apart.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/transport/message.h"

namespace subdivd::server {

// "%41" → "A", and "+" → " " when `plus_is_space` (query strings). Empty for a bad escape such as "%4".
std::optional<std::string> percent_decode(std::string_view text, bool plus_is_space);

struct Target {
  std::string path;  // decoded, starts with '/' (or is "*")
  std::vector<Field> query;
};

// Takes "/path?query", "http://host/path?query" and "*". Empty when it is none of these, holds a bad escape
// or decodes to something other than UTF-8.
std::optional<Target> parse_target(std::string_view target);

bool is_utf8(std::string_view text);

}  // namespace subdivd::server

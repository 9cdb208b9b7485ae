#pragma once
// The daemon's settings: one table from which flags, environment, defaults, --help and the documentation in
// README.md are made.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace subdivd::server {

struct Config {
  std::string host;
  int port = 0;
  std::size_t threads = 0;
  std::size_t max_connections = 0;  // 0: as many as descriptors allow
  std::size_t max_concurrent = 0;   // 0: one per processor
  std::size_t request_threads = 0;  // 0: one per processor
  std::size_t max_waiting = 0;
  std::uint64_t max_body_bytes = 0;
  std::uint64_t max_output_bytes = 0;
  std::uint64_t max_memory_bytes = 0;
  std::uint32_t max_level = 0;
  double deadline_seconds = 0;
  double read_timeout = 0;
  double idle_timeout = 0;
  double drain_seconds = 0;
  std::vector<std::string> cors_origins;  // "*": any; empty: none
  std::string log_level;
  bool self_test = false;
};

struct Setting {
  std::string_view flag;           // without the dashes
  std::string_view default_value;  // as one would write it
  std::string_view range;          // valid values, for people
  std::string_view help;           // one sentence without full stop
  // Reads `text` into the field; false when it is not in `range`.
  bool (*set)(Config& config, std::string_view text);
};

std::span<const Setting> setting_table();
std::string environment_name(const Setting& setting);  // "max-level" → "SUBDIVD_MAX_LEVEL"
Config default_config();
// Refuses (bad value or unknown flag) in words that name flag, value and valid values.
Result<void> set(Config& config, std::string_view flag, std::string_view value);

// What the command line asks for.
struct Invocation {
  enum class Action { serve, print, health_check };
  Action action = Action::serve;
  Config config;
  std::string text;  // print: what; health_check: the URL
};
// Flags over SUBDIVD_* environment variables over defaults.
Result<Invocation> parse_command_line(int argc, const char* const* argv);

// The table as it stands in README.md.
std::string settings_as_markdown();

}  // namespace subdivd::server

#include "server/config.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>

#include "server/version.h"

namespace subdivd::server {
namespace {

template <class Number>
std::optional<Number> number_in(std::string_view text, Number least, Number most) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stopped, fault] = std::from_chars(text.data(), end, value);
  if (fault != std::errc() || stopped != end || !(value >= least && value <= most)) return std::nullopt;
  return value;
}

template <auto Field, auto kLeast, auto kMost>
bool set_number(Config& config, std::string_view text) {
  using Number = std::remove_reference_t<decltype(config.*Field)>;
  const auto value = number_in<Number>(text, static_cast<Number>(kLeast), static_cast<Number>(kMost));
  if (value) config.*Field = *value;
  return value.has_value();
}

// Seconds, up to a day; the least in hundredths, for clang 14 takes no double as a template argument.
template <auto Field, int kLeastHundredths>
bool set_seconds(Config& config, std::string_view text) {
  const auto value = number_in<double>(text, kLeastHundredths / 100.0, 86400);
  if (value) config.*Field = *value;
  return value.has_value();
}

// "1000", "64KiB", "256MiB", "1GiB"
template <auto Field>
bool set_bytes(Config& config, std::string_view text) {
  std::uint64_t unit = 1;
  for (const std::string_view suffix : {"KiB", "MiB", "GiB"}) {
    unit *= 1024;
    if (!text.ends_with(suffix)) continue;
    const auto count =
        number_in<std::uint64_t>(text.substr(0, text.size() - 3), 1, (std::uint64_t{1} << 40) / unit);
    if (count) config.*Field = *count * unit;
    return count.has_value();
  }
  return set_number<Field, 1, std::uint64_t{1} << 40>(config, text);
}

template <auto Field>
bool set_switch(Config& config, std::string_view text) {
  config.*Field = text == "on";
  return text == "on" || text == "off";
}

bool set_host(Config& config, std::string_view text) {
  config.host = text;
  return !text.empty();
}

bool set_log_level(Config& config, std::string_view text) {
  constexpr std::array<std::string_view, 5> kLevels = {"debug", "info", "warn", "error", "off"};
  config.log_level = text;
  return std::find(kLevels.begin(), kLevels.end(), text) != kLevels.end();
}

bool is_origin(std::string_view text) {
  const bool scheme = text.starts_with("http://") || text.starts_with("https://");
  const bool clean = std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < 0x7F; });
  return scheme && clean && !text.ends_with('/');
}

bool set_origins(Config& config, std::string_view text) {
  config.cors_origins.clear();
  if (text == "none") return true;
  while (!text.empty()) {
    const std::string_view origin = text.substr(0, text.find(','));
    if (origin != "*" && !is_origin(origin)) return false;
    config.cors_origins.emplace_back(origin);
    text.remove_prefix(std::min(text.size(), origin.size() + 1));
  }
  return !config.cors_origins.empty();
}

// clang-format off
constexpr std::array kSettings = {
  Setting{"host", "127.0.0.1", "an address or a name",
          "Where to listen; anything but loopback belongs behind a proxy", set_host},
  Setting{"port", "8080", "0 to 65535",
          "0 takes any free port and prints it", set_number<&Config::port, 0, 65535>},
  Setting{"threads", "128", "1 to 1024",
          "Requests read, answered and sent at once; more wait for up to ten seconds", set_number<&Config::threads, 1, 1024>},
  Setting{"max-connections", "0", "0 to 1000000",
          "Open connections, idle ones included; 0 means 10000, or as many as descriptors allow", set_number<&Config::max_connections, 0, 1000000>},
  Setting{"max-concurrent", "0", "0 to 1024",
          "Requests computed at once; 0 means one per processor", set_number<&Config::max_concurrent, 0, 1024>},
  Setting{"request-threads", "0", "0 to 1024",
          "Threads that compute one request, as long as no other needs their processors; 0 means one per processor", set_number<&Config::request_threads, 0, 1024>},
  Setting{"max-waiting", "32", "0 to 100000",
          "Requests that may wait to be computed, small and large ones counted apart; more are turned away with 503", set_number<&Config::max_waiting, 0, 100000>},
  Setting{"max-body-bytes", "256MiB", "1 to 1024GiB",
          "Size of a request's body", set_bytes<&Config::max_body_bytes>},
  Setting{"max-output-bytes", "1GiB", "1 to 1024GiB",
          "Predicted size of an answer", set_bytes<&Config::max_output_bytes>},
  Setting{"max-memory-bytes", "4GiB", "1 to 1024GiB",
          "Bodies, work and answers of all requests together", set_bytes<&Config::max_memory_bytes>},
  Setting{"max-level", "8", "0 to 15",
          "Highest refinement level that a request may ask for", set_number<&Config::max_level, 0, 15>},
  Setting{"deadline-seconds", "60", "0.01 to 86400",
          "How long a request may be computed, waiting included", set_seconds<&Config::deadline_seconds, 1>},
  Setting{"read-timeout", "30", "0.01 to 86400",
          "Seconds for a request's head, for its body, for memory that others have and for sending the answer, plus about one for every MiB", set_seconds<&Config::read_timeout, 1>},
  Setting{"idle-timeout", "75", "0.01 to 86400",
          "Seconds between two requests of one connection, as announced by Keep-Alive", set_seconds<&Config::idle_timeout, 1>},
  Setting{"drain-seconds", "30", "0 to 86400",
          "How long requests in flight may go on after SIGTERM", set_seconds<&Config::drain_seconds, 0>},
  Setting{"cors-origins", "*", "*, none or origins with commas between them",
          "Web pages of these origins may read answers", set_origins},
  Setting{"log-level", "info", "debug, info, warn, error or off",
          "Requests are logged at info, failures of the server at error", set_log_level},
  Setting{"self-test", "on", "on or off",
          "Compare small meshes with OpenSubdiv at start; /readyz says how it went", set_switch<&Config::self_test>},
};
// clang-format on

const Setting* find(std::string_view flag) {
  const auto found = std::find_if(kSettings.begin(), kSettings.end(),
                                  [&](const Setting& setting) { return setting.flag == flag; });
  return found == kSettings.end() ? nullptr : &*found;
}

Error refused(std::string message) { return {ErrorCode::out_of_range, std::move(message)}; }

}  // namespace

std::span<const Setting> setting_table() { return kSettings; }

std::string environment_name(const Setting& setting) {
  std::string name = "SUBDIVD_" + std::string(setting.flag);
  std::transform(name.begin(), name.end(), name.begin(), [](char c) {
    return c == '-' ? '_' : c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  return name;
}

Config default_config() {
  Config config;
  for (const Setting& setting : kSettings) setting.set(config, setting.default_value);
  return config;
}

Result<void> set(Config& config, std::string_view flag, std::string_view value) {
  const Setting* setting = find(flag);
  if (setting == nullptr) return refused("there is no setting --" + std::string(flag));
  if (setting->set(config, value)) return {};
  return refused("--" + std::string(flag) + " (" + environment_name(*setting) + ") must be " +
                 std::string(setting->range) + ", not '" + std::string(value) + "'");
}

Result<Invocation> parse_command_line(int argc, const char* const* argv) {
  CLI::App app("subdivd refines subdivision surfaces and curves over HTTP.", "subdivd");
  app.set_version_flag("--version", "subdivd " + std::string(kVersion));
  std::string url;
  app.add_option("--health-check", url,
                 "Ask a running daemon's /livez or /readyz at this URL; exit with 0 or 1")
      ->type_name("URL");
  std::map<std::string_view, std::string> given;
  for (const Setting& setting : kSettings) {
    app.add_option("--" + std::string(setting.flag), given[setting.flag],
                   std::string(setting.help) + ". Default: " + std::string(setting.default_value))
        ->envname(environment_name(setting))
        ->type_name(std::string(setting.range));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return Invocation{Invocation::Action::print, {}, app.help()};
  } catch (const CLI::CallForVersion&) {
    return Invocation{Invocation::Action::print, {}, app.version() + "\n"};
  } catch (const CLI::Error& error) {
    return refused(std::string(error.what()) + "; see subdivd --help");
  }
  if (!url.empty()) return Invocation{Invocation::Action::health_check, {}, url};
  Invocation invocation{Invocation::Action::serve, default_config(), {}};
  for (const auto& [flag, value] : given) {
    if (app.get_option("--" + std::string(flag))->count() == 0) continue;
    if (auto accepted = set(invocation.config, flag, value); !accepted) return std::move(accepted).error();
  }
  return invocation;
}

std::string settings_as_markdown() {
  std::string text = "| flag | environment | default | values | what it does |\n|---|---|---|---|---|\n";
  for (const Setting& setting : kSettings)
    text += "| `--" + std::string(setting.flag) + "` | `" + environment_name(setting) + "` | `" +
            std::string(setting.default_value) + "` | " + std::string(setting.range) + " | " +
            std::string(setting.help) + " |\n";
  return text;
}

}  // namespace subdivd::server

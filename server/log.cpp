#include "server/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <array>
#include <cstdio>
#include <memory>

namespace subdivd::server {
namespace {

constexpr std::size_t kMaxQuoted = 300;  // of a client's text; the rest is cut off

}  // namespace

void start_log(const std::string& level) {
  auto logger =
      std::make_shared<spdlog::logger>("subdivd", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ %l %v", spdlog::pattern_time_type::utc);
  logger->set_error_handler(
      [](const std::string&) {});  // the default one writes to the stream that just failed
  logger->set_level(spdlog::level::from_str(level));
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

// The line is an argument, never the format.
void log_info(std::string_view line) { spdlog::info("{}", line); }
void log_warning(std::string_view line) { spdlog::warn("{}", line); }
void log_error(std::string_view line) { spdlog::error("{}", line); }

std::string escaped(std::string_view text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string result = "\"";
  for (const char c : text.substr(0, kMaxQuoted)) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (byte >= 0x20 && byte < 0x7F) {
      result += c;
    } else {
      result += "\\x";
      result += kHex[byte >> 4];
      result += kHex[byte & 15];
    }
  }
  return result + (text.size() > kMaxQuoted ? "\"..." : "\"");
}

std::string access_line(const Exchange& exchange) {
  std::array<char, 96> numbers{};
  std::snprintf(numbers.data(), numbers.size(), " status=%d bytes=%llu ms=%.1f peer=", exchange.status,
                static_cast<unsigned long long>(exchange.body_bytes), exchange.milliseconds);
  return "method=" + escaped(exchange.request.method) + " target=" + escaped(exchange.request.target) +
         numbers.data() + escaped(exchange.request.peer) + (exchange.completed ? "" : " broken");
}

}  // namespace subdivd::server

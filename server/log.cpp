#include "server/log.h"

#include <spdlog/async.h>
#include <spdlog/details/null_mutex.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <thread>

namespace subdivd::server {
namespace {

constexpr std::size_t kMaxQuoted = 300;      // of a client's text; the rest is cut off
constexpr std::size_t kWaitingLines = 4096;  // some 300 bytes each

// How many lines were handed over, and how many have been written, or have failed to be.
std::atomic<std::uint64_t> posted{0}, written{0};

// Standard error; only the writing thread ever waits for its reader.
class ErrorStream final : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    const char* rest = line.data();
    std::size_t size = line.size();
    while (size > 0) {
      const ssize_t count = ::write(STDERR_FILENO, rest, size);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) break;  // a full disk, a closed pipe: the line is lost
      rest += count;
      size -= static_cast<std::size_t>(count);
    }
    ++written;
  }
  void flush_() override {}
};

void post(spdlog::level::level_enum level, std::string_view line) {
  if (!spdlog::should_log(level)) return;
  ++posted;
  spdlog::log(level, "{}", line);  // the line is an argument, never the format
}

}  // namespace

void start_log(const std::string& level) {
  spdlog::init_thread_pool(kWaitingLines, 1);
  auto logger = std::make_shared<spdlog::async_logger>("subdivd", std::make_shared<ErrorStream>(),
                                                       spdlog::thread_pool(),
                                                       spdlog::async_overflow_policy::overrun_oldest);
  logger->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ %l %v", spdlog::pattern_time_type::utc);
  // The default one writes to the stream that just failed. A line that failed counts as written: nobody waits
  // for it.
  logger->set_error_handler([](const std::string&) { ++written; });
  logger->set_level(spdlog::level::from_str(level));
  spdlog::set_default_logger(std::move(logger));
}

std::uint64_t dropped_log_lines() {
  const auto pool = spdlog::thread_pool();
  return pool == nullptr ? 0 : pool->overrun_counter();
}

bool finish_log(std::chrono::milliseconds patience) {
  constexpr std::chrono::milliseconds kSlice{5};
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (written + dropped_log_lines() < posted) {
    if (std::chrono::steady_clock::now() >= deadline) return false;
    std::this_thread::sleep_for(kSlice);
  }
  return true;
}

void log_info(std::string_view line) { post(spdlog::level::info, line); }
void log_warning(std::string_view line) { post(spdlog::level::warn, line); }
void log_error(std::string_view line) { post(spdlog::level::err, line); }

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

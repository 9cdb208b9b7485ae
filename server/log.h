#pragma once
// The log: one line per event on standard error. Nothing a client sent gets there unescaped. A log that
// cannot be written never ends the process, and one whose reader stalls never holds it up: a thread of its
// own writes, the newest few thousand lines wait for it, and older ones are dropped and counted.

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "server/transport/service.h"

namespace subdivd::server {

void start_log(const std::string& level);  // debug, info, warn, error or off
// Lines that nobody will read, because they came faster than they were read.
std::uint64_t dropped_log_lines();
// Waits until every line so far has been written; false when that takes longer than `patience`. Then nothing
// may wait for the log any more: not even the end of main().
bool finish_log(std::chrono::milliseconds patience);

void log_info(std::string_view line);
void log_warning(std::string_view line);
void log_error(std::string_view line);

// In quotes, with every byte that is not visible ASCII or a blank as \xNN: a client must not be able to begin
// a line of its own, or to speak to the terminal.
std::string escaped(std::string_view text);

// method="GET" target="/livez" status=200 bytes=3 ms=0.1 peer="127.0.0.1", and `broken` at the end when the
// client left before the last byte.
std::string access_line(const Exchange& exchange);

}  // namespace subdivd::server

#pragma once
// The log: one line per event on standard error. Nothing a client sent gets there unescaped, and a log that
// cannot be written never ends the process.

#include <string>
#include <string_view>

#include "server/transport/service.h"

namespace subdivd::server {

void start_log(const std::string& level);  // debug, info, warn, error or off
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

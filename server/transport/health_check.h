#pragma once
#include <string>

namespace subdivd::server {

// Asks a running daemon, as a container's health check does: true when `url` (http://host:port/path) answers
// 200 within 3 s.
bool is_healthy(const std::string& url);

}  // namespace subdivd::server

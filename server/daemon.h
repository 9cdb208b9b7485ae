#pragma once
// The running daemon: from a configuration to the exit code.

#include "server/config.h"

namespace subdivd::server {

// Serves until SIGTERM or SIGINT, drains, returns 0; 1 when it cannot start. Call once, before any thread
// exists: it blocks the signals that it waits for.
int run(const Config& config);

}  // namespace subdivd::server

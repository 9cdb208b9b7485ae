#pragma once
#include <cstddef>

namespace subdivd::server {

// Raises the limit of open descriptors to what the system allows. Returns how many connections may be open:
// `wanted`, or 10,000 when that is 0, but no more than fit beside a reserve for files.
std::size_t allow_connections(std::size_t wanted);

}  // namespace subdivd::server

#pragma once
#include <string_view>

namespace subdivd::server {

inline constexpr std::string_view kVersion = SUBDIVD_VERSION;

}  // namespace subdivd::server

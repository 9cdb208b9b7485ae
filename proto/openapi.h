#pragma once
// The description of the HTTP surface, OpenAPI 3.1: proto/openapi.json, embedded at build time.

#include <string_view>

namespace subdivd::proto {

std::string_view openapi_json();

}  // namespace subdivd::proto

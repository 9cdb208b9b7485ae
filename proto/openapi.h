#pragma once
// The description of the HTTP surface, OpenAPI 3.1: made by proto/openapi when the program is built.

#include <string_view>

namespace subdivd::proto {

std::string_view openapi_json();

}  // namespace subdivd::proto

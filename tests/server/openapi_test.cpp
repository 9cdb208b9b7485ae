// What the OpenAPI document says is what the application does.
#include "proto/openapi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "server/http/application.h"
#include "server/http/status.h"

namespace subdivd::server::testing {
namespace {

using nlohmann::json;

const json& document() {
  static const json parsed = json::parse(proto::openapi_json());
  return parsed;
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) { return c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c; });
  return text;
}

TEST(OpenApi, lists_the_very_routes_of_the_application) {
  const Application application(default_config(), 1'000'000'000);
  std::set<std::string> listed, served;
  for (const auto& [path, operations] : document()["paths"].items())
    for (const auto& [method, unused] : operations.items()) listed.insert(upper(method) + ' ' + path);
  for (const Route& route : application.router().routes())
    served.insert(std::string(route.method) + ' ' + std::string(route.path));
  EXPECT_EQ(listed, served);
}

TEST(OpenApi, lists_other_kinds_than_json_where_the_application_takes_it) {
  const Application application(default_config(), 1'000'000'000);
  for (const Route& route : application.router().routes()) {
    if (route.method != "POST") continue;
    const json& content = document()["paths"][std::string(route.path)]["post"]["requestBody"]["content"];
    for (const char* type : {"model/gltf-binary", "model/gltf+json", "model/obj", "text/plain"})
      EXPECT_EQ(content.contains(type), route.takes_gltf) << route.path << ' ' << type;
  }
}

TEST(OpenApi, lists_the_very_codes_of_refusals) {
  std::set<std::string> listed, given;
  for (const json& code : document()["components"]["schemas"]["Problem"]["properties"]["code"]["enum"])
    EXPECT_TRUE(listed.insert(code).second) << code << " stands there twice";
  for (const std::string_view code : refusal_codes()) given.emplace(code);
  for (int code = 0; code <= static_cast<int>(ErrorCode::internal); ++code)
    given.emplace(name_of(static_cast<ErrorCode>(code)));
  EXPECT_EQ(listed, given);
}

TEST(OpenApi, lists_the_status_of_every_error_code) {
  for (const auto& [path, operations] : document()["paths"].items()) {
    if (!operations.contains("post")) continue;
    for (int code = 0; code <= static_cast<int>(ErrorCode::internal); ++code)
      for (const Path& where : {Path(), Path{"?level"}}) {
        const Error error{.code = static_cast<ErrorCode>(code), .where = where};
        EXPECT_TRUE(operations["post"]["responses"].contains(std::to_string(status_of(error))))
            << path << ' ' << name_of(error.code);
      }
  }
}

}  // namespace
}  // namespace subdivd::server::testing

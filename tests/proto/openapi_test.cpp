// What the OpenAPI document says is what the readers do.

#include "proto/openapi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "proto/decode.h"
#include "proto/options.h"
#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

using nlohmann::json;

json document() { return json::parse(openapi_json()); }
json schema(const char* name) { return document()["components"]["schemas"][name]; }

TEST(openapi, is_version_3_1) { EXPECT_EQ(document()["openapi"], "3.1.0"); }

// Values that a schema of an option admits, and some that it does not, as a query writes them.
std::pair<std::vector<std::string>, std::vector<std::string>> values_of(const json& schema) {
  if (schema["type"] == "boolean") return {{"true", "false"}, {"yes", ""}};
  if (schema["type"] == "integer")
    return {{schema["minimum"].dump(), schema["maximum"].dump(), schema["default"].dump()},
            {"-1", std::to_string(schema["maximum"].get<int>() + 1), "1.5", "x"}};
  return {schema["enum"], {"x", ""}};
}

TEST(openapi, parameters_take_the_values_that_are_documented_and_no_others) {
  const json all = document()["components"]["parameters"];
  EXPECT_GT(all.size(), 10u);
  for (const auto& [name, parameter] : all.items()) {
    const auto [taken, refused] = values_of(parameter["schema"]);
    for (const std::string& value : taken) {
      Options options;
      EXPECT_TRUE(set_parameters(options, {{name, value}})) << name << '=' << value;
    }
    for (const std::string& value : refused) {
      Options options;
      EXPECT_FALSE(set_parameters(options, {{name, value}})) << name << '=' << value;
    }
  }
  Options options;
  EXPECT_FALSE(set_parameters(options, {{"undocumented", "1"}}));
}

TEST(openapi, options_of_a_body_take_the_values_that_are_documented_and_no_others) {
  const json properties = schema("Options")["properties"];
  // With a mesh of a triangle and with one of a quad: schemes take different faces.
  const auto refused = [](const std::string& name, const json& value) {
    const json triangle = {{"points", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {"faceVertexIndices", {0, 1, 2}}};
    const json quad = {{"points", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
                       {"faceVertexIndices", {0, 1, 2, 3}},
                       {"faceVertexCounts", {4}}};
    return std::ranges::none_of(std::array{triangle, quad}, [&](json body) {
      body["options"] = {{name, value}};
      return decode_refine(body.dump(), {}, {}, {}).ok();
    });
  };
  for (const auto& [name, value] : properties.items()) {
    const bool word = value["type"] == "string", boolean = value["type"] == "boolean";
    for (const json& taken : word ? value["enum"] : json::array({value["default"]}))
      EXPECT_FALSE(refused(name, taken)) << name << taken;
    EXPECT_TRUE(refused(name, word      ? json("x")
                              : boolean ? json(1)
                                        : json(value["maximum"].get<int>() + 1)))
        << name;
  }
  EXPECT_TRUE(refused("undocumented", 1));
}

TEST(openapi, every_reference_leads_somewhere) {
  const json all = document();
  std::set<std::string> references;
  const std::string text(openapi_json());
  const std::string mark = "\"$ref\":\"#";
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1))
    references.insert(text.substr(at + mark.size(), text.find('"', at + mark.size()) - at - mark.size()));
  EXPECT_GT(references.size(), 10u);
  for (const std::string& pointer : references)
    EXPECT_TRUE(all.contains(json::json_pointer(pointer))) << pointer;
}

// What the reader knows is what the schema lists: the message about an unknown member names them all.
void expect_same_members(const json& properties, const std::string& body) {
  const std::string text = message(body);
  const std::size_t list = text.find("valid: ");
  ASSERT_NE(list, std::string::npos) << text;
  std::set<std::string> known, listed;
  for (std::size_t at = list + 7; at < text.size();) {
    std::size_t end = text.find_first_of(", ", at);
    if (end == std::string::npos) end = text.size();
    const std::string word = text.substr(at, end - at);
    if (!word.empty() && word != "or") known.insert(word);
    at = end + 1;
  }
  for (const auto& [name, unused] : properties.items()) listed.insert(name);
  EXPECT_EQ(known, listed);
}

TEST(openapi, lists_the_members_of_a_request) {
  expect_same_members(schema("RefineRequest")["properties"], R"({"?":1})");
}

TEST(openapi, lists_the_members_of_a_mesh) {
  expect_same_members(schema("Mesh")["properties"], R"({"meshes":[{"?":1}]})");
}

TEST(openapi, lists_the_members_of_a_primvar) {
  expect_same_members(schema("Primvar")["properties"], R"({"primvars":{"a":{"?":1}}})");
}

TEST(openapi, lists_the_members_of_curves) {
  expect_same_members(schema("Curves")["properties"], R"({"curves":[{"?":1}]})");
}

}  // namespace
}  // namespace subdivd::proto::test

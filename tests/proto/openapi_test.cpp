// openapi.json says what the code does.

#include "proto/openapi.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "proto/json/words.h"
#include "proto/options.h"
#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

using nlohmann::json;

json document() { return json::parse(openapi_json()); }
json schema(const char* name) { return document()["components"]["schemas"][name]; }

TEST(openapi, is_the_file_of_the_source) { EXPECT_EQ(openapi_json(), source_file("proto/openapi.json")); }

TEST(openapi, is_version_3_1) { EXPECT_EQ(document()["openapi"], "3.1.0"); }

TEST(openapi, parameters_are_the_table_of_options) {
  const json expected = json::parse(openapi_parameters());
  EXPECT_EQ(document()["components"]["parameters"], expected) << "components.parameters should be\n"
                                                              << openapi_parameters();
}

TEST(openapi, the_schema_of_options_is_the_table_of_options) {
  EXPECT_EQ(schema("Options"), json::parse(options_schema())) << "schemas.Options should be\n"
                                                              << options_schema();
}

TEST(openapi, both_endpoints_take_every_parameter) {
  for (const char* path : {"/v1/refine", "/v1/verify"}) {
    std::set<std::string> taken;
    const json all = document();
    for (const json& parameter : all["paths"][path]["post"]["parameters"])
      taken.insert(parameter["$ref"].get<std::string>());
    for (const std::string_view name : option_names())
      EXPECT_TRUE(taken.contains("#/components/parameters/" + std::string(name))) << path << ' ' << name;
    EXPECT_EQ(taken.size(), option_names().size());
  }
}

TEST(openapi, every_reference_leads_somewhere) {
  const json all = document();
  std::set<std::string> references;
  const std::string text(openapi_json());
  const std::string mark = "\"$ref\": \"#";
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

TEST(openapi, lists_the_interpolations) {
  const auto words = proto::json::interpolation_words();
  EXPECT_EQ(schema("Primvar")["properties"]["interpolation"]["enum"],
            nlohmann::json(std::vector<std::string>(words.begin(), words.end())));
}

TEST(openapi, holds_every_example) {
  const json shown =
      document()["paths"]["/v1/refine"]["post"]["requestBody"]["content"]["application/json"]["examples"];
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(SUBDIVD_SOURCE_DIR) + "/proto/examples")) {
    ++files;
    const std::string name = entry.path().stem().string();
    ASSERT_TRUE(shown.contains(name)) << name;
    EXPECT_EQ(shown[name]["value"], json::parse(source_file("proto/examples/" + name + ".json")));
  }
  EXPECT_EQ(shown.size(), files);
}

}  // namespace
}  // namespace subdivd::proto::test

#include "proto/problem.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

using nlohmann::json;

const Error kError{
    ErrorCode::out_of_range, "index 9 is past the 3 points", {"meshes", std::uint64_t{0}}, 0, 0};

TEST(problem, has_the_members_of_rfc_9457) {
  const json problem = json::parse(problem_json(to_problem(kError, 422)));
  EXPECT_EQ(problem["type"], "urn:subdivd:problem:out_of_range");
  EXPECT_EQ(problem["title"], "A number is outside its range");
  EXPECT_EQ(problem["status"], 422);
  EXPECT_EQ(problem["detail"], "index 9 is past the 3 points");
}

TEST(problem, points_at_the_offending_value) {
  const json problem = json::parse(problem_json(to_problem(kError, 422)));
  EXPECT_EQ(problem["errors"][0]["pointer"], "/meshes/0");
  EXPECT_EQ(problem["errors"][0]["code"], "out_of_range");
}

TEST(problem, a_query_parameter_is_named_instead_of_a_pointer) {
  const json problem = json::parse(problem_json(to_problem({ErrorCode::bad_enum, "no", {"?weld"}}, 400)));
  EXPECT_EQ(problem["errors"][0]["parameter"], "weld");
  EXPECT_FALSE(problem["errors"][0].contains("pointer"));
}

TEST(problem, pointers_escape_tilde_and_slash) {
  EXPECT_EQ(json_pointer({"primvars", "a/b~c~1", std::uint64_t{3}}), "/primvars/a~1b~0c~01/3");
}

TEST(problem, the_empty_path_is_the_empty_pointer) { EXPECT_EQ(json_pointer({}), ""); }

TEST(problem, bad_utf8_is_replaced) {
  const json problem =
      json::parse(problem_json(to_problem({ErrorCode::malformed, "\xFF\xC0 here", {"\x80"}}, 400)));
  EXPECT_EQ(problem["errors"][0]["pointer"], "/\xEF\xBF\xBD");
}

TEST(problem, limits_tell_both_numbers) {
  const json problem = json::parse(problem_json(to_problem(
      {.code = ErrorCode::too_large, .message = "much", .predicted = 18446744073709551615u, .allowed = 7},
      422)));
  EXPECT_EQ(problem["predicted"], 18446744073709551615u);
  EXPECT_EQ(problem["allowed"], 7u);
}

TEST(problem, nothing_internal_leaks) {
  const std::string text =
      problem_json(to_problem({ErrorCode::internal, "assertion failed in plain.cpp"}, 500));
  EXPECT_EQ(text.find("plain.cpp"), std::string::npos);
}

// Every code there is: ErrorCode has no count, but its names end in "internal".
std::vector<ErrorCode> all_codes() {
  std::vector<ErrorCode> codes;
  for (int i = 0;; ++i) {
    codes.push_back(static_cast<ErrorCode>(i));
    if (codes.back() == ErrorCode::internal) return codes;
  }
}

TEST(problem, every_code_has_a_title_of_its_own) {
  std::set<std::string_view> titles;
  for (const ErrorCode code : all_codes()) EXPECT_TRUE(titles.insert(title_of(code)).second) << name_of(code);
}

TEST(problem, the_readme_lists_every_code_with_its_title) {
  const std::string readme = source_file("proto/README.md");
  for (const ErrorCode code : all_codes()) {
    std::string row = "| `";
    row.append(name_of(code)).append("` | ").append(title_of(code)).append(" |");
    EXPECT_NE(readme.find(row), std::string::npos) << row;
  }
}

TEST(problem, the_readme_lists_no_code_that_does_not_exist) {
  const std::string whole = source_file("proto/README.md");
  const std::string readme = whole.substr(whole.find("## Refusals"));
  std::size_t rows = 0;
  for (std::size_t at = readme.find("\n| `"); at != std::string::npos; at = readme.find("\n| `", at + 1))
    ++rows;
  EXPECT_EQ(rows, all_codes().size());
}

}  // namespace
}  // namespace subdivd::proto::test

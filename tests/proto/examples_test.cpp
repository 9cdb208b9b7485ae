// Every file of proto/examples is a request that works.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

std::vector<std::string> example_names() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(SUBDIVD_SOURCE_DIR) + "/proto/examples"))
    names.push_back(entry.path().stem().string());
  return names;
}

class examples : public testing::TestWithParam<std::string> {};

TEST_P(examples, is_refined_into_a_valid_request) {
  const std::string body = source_file("proto/examples/" + GetParam() + ".json");
  const Result<std::string> text = answer(body);
  ASSERT_TRUE(text.ok()) << text.error().message;
  EXPECT_EQ(refusal(*text), "accepted");
}

TEST_P(examples, is_shown_in_the_readme) {
  EXPECT_NE(source_file("proto/README.md").find("examples/" + GetParam() + ".json"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(proto, examples, testing::ValuesIn(example_names()),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace subdivd::proto::test

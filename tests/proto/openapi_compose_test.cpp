// What "$use" puts where.

#include <gtest/gtest.h>

#include <stdexcept>

#include "proto/openapi/compose.h"

namespace subdivd::proto::openapi::test {
namespace {

Json composed(const char* text, const char* shared) {
  return compose(Json::parse(text), Json::parse(shared));
}

TEST(compose, leaves_what_uses_nothing) {
  EXPECT_EQ(composed(R"({"a":[1,{"b":null}]})", "{}"), Json::parse(R"({"a":[1,{"b":null}]})"));
}
TEST(compose, puts_a_value_in_the_place_of_its_name) {
  EXPECT_EQ(composed(R"({"maximum":{"$use":"n"}})", R"({"n":7})"), Json::parse(R"({"maximum":7})"));
}
TEST(compose, puts_members_before_ones_own) {
  EXPECT_EQ(composed(R"({"c":3,"$use":"m"})", R"({"m":{"a":1,"b":2}})").dump(), R"({"a":1,"b":2,"c":3})");
}
TEST(compose, lets_ones_own_member_count) {
  EXPECT_EQ(composed(R"({"$use":"m","a":2})", R"({"m":{"a":1}})"), Json::parse(R"({"a":2})"));
}
TEST(compose, lets_the_last_of_several_names_count) {
  EXPECT_EQ(composed(R"({"$use":["m","n"]})", R"({"m":{"a":1,"b":1},"n":{"a":2}})"),
            Json::parse(R"({"a":2,"b":1})"));
}
TEST(compose, puts_elements_between_ones_own) {
  EXPECT_EQ(composed(R"([0,{"$use":"l"},3])", R"({"l":[1,2]})"), Json::parse("[0,1,2,3]"));
}
TEST(compose, follows_names_in_what_is_used) {
  EXPECT_EQ(composed(R"({"$use":"a"})", R"({"a":[{"$use":"b"}],"b":[1]})"), Json::parse("[1]"));
}
TEST(compose, refuses_a_name_that_is_not_there) {
  EXPECT_THROW(composed(R"({"$use":"a"})", "{}"), std::runtime_error);
}
TEST(compose, refuses_names_that_use_each_other) {
  EXPECT_THROW(composed(R"({"$use":"a"})", R"({"a":{"$use":"b"},"b":{"x":{"$use":"a"}}})"),
               std::runtime_error);
}
TEST(compose, refuses_members_of_what_has_none) {
  EXPECT_THROW(composed(R"({"$use":"a","x":1})", R"({"a":1})"), std::runtime_error);
}

}  // namespace
}  // namespace subdivd::proto::openapi::test

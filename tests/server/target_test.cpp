#include "server/transport/target.h"

#include <gtest/gtest.h>

namespace subdivd::server {
namespace {

TEST(Target, keeps_the_order_and_the_duplicates_of_the_query) {
  const auto target = parse_target("/a?b=1&c=2&b=3");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->query, (std::vector<Field>{{"b", "1"}, {"c", "2"}, {"b", "3"}}));
}
TEST(Target, decodes_path_and_query) {
  const auto target = parse_target("/%61+b?n%61me=a+b%2B%26");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->path, "/a+b");
  EXPECT_EQ(target->query.at(0), Field("name", "a b+&"));
}
TEST(Target, takes_a_name_without_value) {
  EXPECT_EQ(parse_target("/?verify")->query.at(0), Field("verify", ""));
}
TEST(Target, skips_empty_pairs) { EXPECT_EQ(parse_target("/?&&a=1&")->query.size(), 1u); }
TEST(Target, takes_the_absolute_form) {
  const auto target = parse_target("http://host:80/a?b=1");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->path, "/a");
}
TEST(Target, takes_an_absolute_form_without_path) { EXPECT_EQ(parse_target("http://host")->path, "/"); }
TEST(Target, takes_an_absolute_form_with_a_query_alone) {
  const auto target = parse_target("HTTP://host?a=1");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->path, "/");
  EXPECT_EQ(target->query.size(), 1u);
}
TEST(Target, refuses_an_absolute_form_without_a_proper_host) {
  for (const char* text :
       {"http://", "http:///a", "http://u:p@host/", "http://a<b/", "http://host:x/", "http://:80/"})
    EXPECT_FALSE(parse_target(text)) << text;
}
TEST(Target, takes_the_asterisk) { EXPECT_EQ(parse_target("*")->path, "*"); }
TEST(Target, refuses_relative_paths) { EXPECT_FALSE(parse_target("a/b")); }
TEST(Target, refuses_an_authority_alone) { EXPECT_FALSE(parse_target("host:443")); }
TEST(Target, refuses_bad_escapes) {
  for (const char* text : {"/%", "/%4", "/%zz", "/?a=%", "/?%4=a"}) EXPECT_FALSE(parse_target(text)) << text;
}
TEST(Target, refuses_escapes_that_are_not_utf8) {
  for (const char* text : {"/?a=%ff", "/%c0%80", "/?a=%ed%a0%80", "/?%e2%82=1", "/?a=%f5%80%80%80"})
    EXPECT_FALSE(parse_target(text)) << text;
}
TEST(Target, takes_utf8_of_every_length) { EXPECT_TRUE(parse_target("/?a=%c3%a9%e2%82%ac%f0%9f%98%80")); }

}  // namespace
}  // namespace subdivd::server

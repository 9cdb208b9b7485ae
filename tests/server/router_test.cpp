#include "server/http/router.h"

#include <gtest/gtest.h>

namespace subdivd::server {
namespace {

using Values = std::vector<std::string>;

Values values_of(std::string_view route, std::string_view path) {
  Values values = {"no match"};
  matches(route, path, &values);
  return values;
}

Router assets() {
  return Router({{"POST", "/v1/assets", nullptr},
                 {"GET", "/v1/assets/{id}", nullptr},
                 {"DELETE", "/v1/assets/{id}", nullptr},
                 {"PUT", "/v1/assets/{id}", nullptr},
                 {"GET", "/v1/assets/{id}/refined.{format}", nullptr}});
}

TEST(Router, finds_values_in_steps) {
  EXPECT_EQ(values_of("/v1/schemes/{name}/{valence}", "/v1/schemes/loop/5"), (Values{"loop", "5"}));
}
TEST(Router, finds_values_beside_letters) {
  EXPECT_EQ(values_of("/v1/assets/{id}/refined.{format}", "/v1/assets/a1/refined.glb"),
            (Values{"a1", "glb"}));
  EXPECT_EQ(values_of("/a/{id}.json", "/a/b.c.json"), Values{"b.c"});
}
TEST(Router, takes_no_empty_value) {
  EXPECT_FALSE(matches("/a/{id}", "/a/", nullptr));
  EXPECT_FALSE(matches("/a/refined.{format}", "/a/refined.", nullptr));
  EXPECT_FALSE(matches("/a/x{id}x", "/a/xx", nullptr));
}
TEST(Router, takes_no_other_letters) {
  EXPECT_FALSE(matches("/a/refined.{format}", "/a/refinedxglb", nullptr));
  EXPECT_FALSE(matches("/a/{id}.json", "/a/b.glb", nullptr));
}
TEST(Router, leaves_values_alone_where_nothing_matches) {
  EXPECT_EQ(values_of("/a/{id}/b", "/a/1/c"), Values{"no match"});
}
TEST(Router, tells_methods_of_one_path_apart) {
  const Router router = assets();
  EXPECT_EQ(router.find("DELETE", "/v1/assets/a")->method, "DELETE");
  EXPECT_EQ(router.find("PUT", "/v1/assets/a")->method, "PUT");
  EXPECT_EQ(router.find("POST", "/v1/assets/a"), nullptr);
}
TEST(Router, answers_head_with_get) { EXPECT_EQ(assets().find("HEAD", "/v1/assets/a")->method, "GET"); }
TEST(Router, lists_the_methods_of_a_path) {
  EXPECT_EQ(assets().allowed_methods("/v1/assets/a"), "GET, HEAD, DELETE, PUT, OPTIONS");
  EXPECT_EQ(assets().allowed_methods("/v1/assets"), "POST, OPTIONS");
  EXPECT_EQ(assets().allowed_methods("/v1"), "");
  EXPECT_EQ(assets().allowed_methods("*"), "GET, HEAD, DELETE, POST, PUT, OPTIONS");
}

}  // namespace
}  // namespace subdivd::server

#include "server/http/cors.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace subdivd::server {
namespace {

std::string header(const Response& response, const std::string& name) {
  const auto found = std::find_if(response.headers.begin(), response.headers.end(),
                                  [&](const Field& field) { return field.first == name; });
  return found == response.headers.end() ? "" : found->second;
}
Response allowed(const Cors& cors, const char* origin) {
  Request request;
  if (origin != nullptr) request.headers.emplace_back("origin", origin);
  Response response;
  cors.allow(request, response);
  return response;
}
const char* const kOrigin = "Access-Control-Allow-Origin";

TEST(Cors, allows_every_origin_with_an_asterisk) {
  EXPECT_EQ(header(allowed(Cors({"*"}), "https://a.example"), kOrigin), "*");
}
TEST(Cors, allows_a_listed_origin_by_name) {
  EXPECT_EQ(header(allowed(Cors({"https://b.example", "https://a.example"}), "https://a.example"), kOrigin),
            "https://a.example");
}
TEST(Cors, allows_no_other_origin) {
  EXPECT_EQ(header(allowed(Cors({"https://a.example"}), "https://a.example.evil"), kOrigin), "");
}
TEST(Cors, tells_caches_that_answers_differ_by_origin) {
  EXPECT_EQ(header(allowed(Cors({"https://a.example"}), nullptr), "Vary"), "Origin");
}
TEST(Cors, says_nothing_when_no_origin_is_allowed) {
  EXPECT_TRUE(allowed(Cors({}), "https://a.example").headers.empty());
}
TEST(Cors, answers_a_preflight_of_an_allowed_origin_only) {
  Request request;
  request.headers = {{"origin", "https://a.example"}, {"access-control-request-method", "POST"}};
  Response good, bad;
  Cors({"https://a.example"}).answer_preflight(request, "POST, OPTIONS", good);
  Cors({"https://b.example"}).answer_preflight(request, "POST, OPTIONS", bad);
  EXPECT_EQ(header(good, "Access-Control-Allow-Methods"), "POST, OPTIONS");
  EXPECT_TRUE(bad.headers.empty());
}

}  // namespace
}  // namespace subdivd::server

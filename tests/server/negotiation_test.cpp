#include "server/http/negotiation.h"

#include <gtest/gtest.h>

namespace subdivd::server {
namespace {

using proto::BodyKind;
using proto::Format;

Request with(const char* name, const char* value) {
  Request request;
  request.headers.emplace_back(name, value);
  return request;
}
std::optional<BodyKind> kind(const char* content_type) {
  return body_kind(with("content-type", content_type));
}
std::optional<Format> format(const char* accept, Format came_in = Format::glb) {
  return preferred_format(with("accept", accept), came_in);
}

TEST(Negotiation, knows_the_kinds_of_body) {
  EXPECT_EQ(kind("application/json"), BodyKind::json);
  EXPECT_EQ(kind("model/gltf-binary"), BodyKind::glb);
  EXPECT_EQ(kind("model/gltf+json"), BodyKind::gltf);
  EXPECT_EQ(kind("model/obj"), BodyKind::obj);
}
TEST(Negotiation, ignores_case_and_parameters_of_the_type) {
  EXPECT_EQ(kind("Application/JSON ; charset=utf-8"), BodyKind::json);
}
TEST(Negotiation, leaves_types_that_say_nothing_to_the_bytes) {
  for (const char* type :
       {"application/octet-stream", "application/x-www-form-urlencoded", "text/plain;charset=UTF-8", ""})
    EXPECT_EQ(kind(type), BodyKind::unspecified) << type;
}
TEST(Negotiation, takes_a_missing_type) { EXPECT_EQ(body_kind(Request{}), BodyKind::unspecified); }
TEST(Negotiation, refuses_other_types) {
  for (const char* type :
       {"text/html", "multipart/form-data; boundary=a", "application/jsonx", "image/png", "*/*"})
    EXPECT_EQ(kind(type), std::nullopt) << type;
}
TEST(Negotiation, answers_what_came_in_without_accept) {
  EXPECT_EQ(preferred_format(Request{}, Format::gltf), Format::gltf);
}
TEST(Negotiation, answers_what_came_in_when_all_is_welcome) { EXPECT_EQ(format("*/*"), Format::glb); }
TEST(Negotiation, follows_an_exact_type) { EXPECT_EQ(format("application/json"), Format::json); }
TEST(Negotiation, prefers_the_higher_quality) {
  EXPECT_EQ(format("application/json;q=0.5, model/gltf+json;q=0.9"), Format::gltf);
}
TEST(Negotiation, prefers_what_came_in_among_equals) {
  EXPECT_EQ(format("application/json, model/gltf+json", Format::gltf), Format::gltf);
}
TEST(Negotiation, understands_half_wildcards) { EXPECT_EQ(format("model/*", Format::json), Format::glb); }
TEST(Negotiation, knows_obj_and_that_plain_text_may_be_anything) {
  EXPECT_EQ(format("model/obj"), Format::obj);
  EXPECT_EQ(format("model/obj, application/json;q=0.5"), Format::obj);
  EXPECT_EQ(format("text/plain"), std::nullopt);
}
TEST(Negotiation, lets_the_closer_range_decide) {
  EXPECT_EQ(format("*/*, model/gltf-binary;q=0"), Format::json);
  EXPECT_EQ(format("model/gltf-binary;q=0.1, */*;q=0.9"), Format::json);
}
TEST(Negotiation, finds_nothing_among_foreign_types) {
  EXPECT_EQ(format("text/html, image/*"), std::nullopt);
}
TEST(Negotiation, takes_quality_zero_for_no) { EXPECT_EQ(format("application/json;q=0"), std::nullopt); }
TEST(Negotiation, takes_a_malformed_quality_for_no) {
  for (const char* accept :
       {"application/json;q=x", "application/json;q=2", "application/json;q=-1", "application/json;q="})
    EXPECT_EQ(format(accept), std::nullopt) << accept;
}
TEST(Negotiation, joins_several_headers) {
  Request request = with("accept", "text/html");
  request.headers.emplace_back("accept", "application/json");
  EXPECT_EQ(preferred_format(request, Format::glb), Format::json);
}
TEST(Negotiation, tells_whether_json_is_welcome) {
  EXPECT_TRUE(accepts_json(Request{}));
  EXPECT_FALSE(accepts_json(with("accept", "model/gltf-binary")));
}

}  // namespace
}  // namespace subdivd::server

#include "server/http/status.h"

#include <gtest/gtest.h>

#include "server/log.h"

namespace subdivd::server {
namespace {

int status(ErrorCode code, Path where = {}) { return status_of({code, "message", std::move(where), 0, 0}); }
std::string text_of(const Response& response) {
  std::string text;
  for (const Bytes& part : response.body)
    text.append(reinterpret_cast<const char*>(part.bytes.data()), part.bytes.size());
  return text;
}

TEST(Status, answers_400_to_bytes_that_are_nothing_at_all) { EXPECT_EQ(status(ErrorCode::malformed), 400); }
TEST(Status, answers_422_to_a_body_that_breaks_a_rule) {
  for (const ErrorCode code :
       {ErrorCode::missing_field, ErrorCode::unknown_field, ErrorCode::duplicate_field, ErrorCode::wrong_type,
        ErrorCode::out_of_range, ErrorCode::bad_enum, ErrorCode::wrong_length, ErrorCode::not_finite,
        ErrorCode::not_a_triangle, ErrorCode::not_an_edge, ErrorCode::duplicate_tag,
        ErrorCode::too_few_points, ErrorCode::unsupported, ErrorCode::too_large})
    EXPECT_EQ(status(code, {PathStep(std::string("points"))}), 422) << name_of(code);
}
TEST(Status, answers_400_to_a_bad_query_parameter) {
  EXPECT_EQ(status(ErrorCode::bad_enum, {PathStep(std::string("?weld"))}), 400);
}
TEST(Status, answers_503_when_time_is_up) { EXPECT_EQ(status(ErrorCode::deadline_exceeded), 503); }
TEST(Status, answers_500_to_our_own_failures) { EXPECT_EQ(status(ErrorCode::internal), 500); }
TEST(Status, hides_our_own_failures) {
  const Response response = problem_response(Error{ErrorCode::internal, "secret"});
  EXPECT_EQ(text_of(response).find("secret"), std::string::npos);
}
TEST(Status, says_what_was_predicted_and_allowed) {
  const std::string text = text_of(problem_response(
      Error{.code = ErrorCode::too_large, .message = "message", .predicted = 123456, .allowed = 1000}));
  EXPECT_NE(text.find("123456"), std::string::npos);
  EXPECT_NE(text.find("1000"), std::string::npos);
}
TEST(Status, asks_to_come_again_after_503) {
  const Response response = problem_response(Refusal{503, "overloaded", "detail"});
  EXPECT_EQ(response.headers.at(0), Field("Retry-After", "1"));
}
TEST(Status, is_a_problem_document) {
  EXPECT_EQ(problem_response(Refusal{404, "not_found", "detail"}).content_type, "application/problem+json");
}

TEST(Log, escapes_whatever_could_end_a_line_or_drive_a_terminal) {
  EXPECT_EQ(escaped("a\r\nb\x1b[31m\"\\\x7f\xc3\xa9"), R"("a\x0d\x0ab\x1b[31m\"\\\x7f\xc3\xa9")");
}
TEST(Log, cuts_long_text) { EXPECT_EQ(escaped(std::string(1000, 'a')).size(), 300u + 5u); }
TEST(Log, writes_one_line_for_an_exchange) {
  Request request;
  request.method = "GET";
  request.target = "/a\n";
  request.peer = "127.0.0.1";
  EXPECT_EQ(access_line({request, 200, 12, false, 1.25}),
            R"(method="GET" target="/a\x0a" status=200 bytes=12 ms=1.2 peer="127.0.0.1" broken)");
}

}  // namespace
}  // namespace subdivd::server

// The judgement of request heads, without a socket.
#include "server/transport/head.h"

#include <gtest/gtest.h>

#include <string>

namespace subdivd::server {
namespace {

int status_of(const std::string& lines) {
  const auto parsed = parse_head(lines + "\r\n");
  const Refusal* refusal = std::get_if<Refusal>(&parsed);
  return refusal == nullptr ? 200 : refusal->status;
}

Head head_of(const std::string& lines) { return std::get<Head>(parse_head(lines + "\r\n")); }

const std::string kPost = "POST / HTTP/1.1\r\nHost: a\r\n";

TEST(Head, lower_cases_names_and_trims_values) {
  const Head head = head_of("GET / HTTP/1.1\r\nHost: a\r\nX-Test: \t b c \t\r\n");
  EXPECT_EQ(head.headers.at(1), Field("x-test", "b c"));
}
TEST(Head, keeps_percent_escapes_in_values) {
  EXPECT_EQ(head_of(kPost + "X: %0d%0aEvil: 1\r\n").headers.at(1).second, "%0d%0aEvil: 1");
}
TEST(Head, refuses_transfer_encoding_beside_content_length) {
  EXPECT_EQ(status_of(kPost + "Transfer-Encoding: chunked\r\nContent-Length: 5\r\n"), 400);
}
TEST(Head, refuses_content_length_beside_transfer_encoding) {
  EXPECT_EQ(status_of(kPost + "Content-Length: 5\r\nTransfer-Encoding: chunked\r\n"), 400);
}
TEST(Head, refuses_two_different_content_lengths) {
  EXPECT_EQ(status_of(kPost + "Content-Length: 5\r\nContent-Length: 6\r\n"), 400);
}
TEST(Head, refuses_two_equal_content_lengths) {
  EXPECT_EQ(status_of(kPost + "Content-Length: 5\r\nContent-Length: 5\r\n"), 400);
}
TEST(Head, refuses_every_content_length_that_is_no_plain_number) {
  for (const char* value :
       {"abc", "", "-1", "+5", "0x10", "5 5", "5,5", "%35", "1e3", "99999999999999999999"})
    EXPECT_EQ(status_of(kPost + "Content-Length: " + value + "\r\n"), 400) << value;
}
TEST(Head, refuses_every_transfer_encoding_but_chunked) {
  for (const char* value : {"gzip", "chunked, chunked", "gzip, chunked", "identity", "xchunked", ""})
    EXPECT_EQ(status_of(kPost + "Transfer-Encoding: " + value + "\r\n"), 501) << value;
}
TEST(Head, refuses_two_transfer_encodings) {
  EXPECT_EQ(status_of(kPost + "Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n"), 400);
}
TEST(Head, refuses_chunks_in_http_1_0) {
  EXPECT_EQ(status_of("POST / HTTP/1.0\r\nTransfer-Encoding: chunked\r\n"), 400);
}
TEST(Head, lets_a_request_follow_a_chunked_one) {
  EXPECT_TRUE(head_of(kPost + "Transfer-Encoding: Chunked\r\n").keep_alive);
}
TEST(Head, refuses_a_missing_host) { EXPECT_EQ(status_of("GET / HTTP/1.1\r\n"), 400); }
TEST(Head, refuses_two_hosts) { EXPECT_EQ(status_of("GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n"), 400); }
TEST(Head, takes_every_kind_of_host) {
  for (const char* host : {"a", "a.example:80", "127.0.0.1", "[::1]", "[::1]:8080", "a%2db", ""})
    EXPECT_EQ(status_of("GET / HTTP/1.1\r\nHost: " + std::string(host) + "\r\n"), 200) << host;
}
TEST(Head, refuses_what_is_no_host) {
  for (const char* host : {"a b", "<script>", "a/b", "u@a", "a:b", "a:65536", "[::1", "[a]", "a%zz"})
    EXPECT_EQ(status_of("GET / HTTP/1.1\r\nHost: " + std::string(host) + "\r\n"), 400) << host;
}
TEST(Head, lets_http_1_0_go_without_host) { EXPECT_EQ(status_of("GET / HTTP/1.0\r\n"), 200); }
TEST(Head, closes_after_http_1_0) { EXPECT_FALSE(head_of("GET / HTTP/1.0\r\n").keep_alive); }
TEST(Head, closes_when_asked_in_a_list) {
  EXPECT_FALSE(head_of(kPost + "Connection: TE, Close\r\n").keep_alive);
}
TEST(Head, refuses_other_versions) { EXPECT_EQ(status_of("GET / HTTP/2.0\r\nHost: a\r\n"), 505); }
TEST(Head, refuses_a_request_line_without_version) { EXPECT_EQ(status_of("GET /\r\nHost: a\r\n"), 400); }
TEST(Head, refuses_a_space_in_the_target) { EXPECT_EQ(status_of("GET /a b HTTP/1.1\r\nHost: a\r\n"), 400); }
TEST(Head, refuses_raw_bytes_in_the_target) {
  EXPECT_EQ(status_of("GET /\xff HTTP/1.1\r\nHost: a\r\n"), 400);
}
TEST(Head, refuses_an_overlong_target) {
  EXPECT_EQ(status_of("GET /" + std::string(kMaxTargetBytes, 'a') + " HTTP/1.1\r\nHost: a\r\n"), 414);
}
TEST(Head, refuses_more_headers_than_a_hundred) {
  std::string lines = kPost;
  for (std::size_t i = 0; i < kMaxHeaders; ++i) lines += "x: y\r\n";
  EXPECT_EQ(status_of(lines), 431);
}
TEST(Head, refuses_a_folded_line) { EXPECT_EQ(status_of(kPost + "X: a\r\n b\r\n"), 400); }
TEST(Head, refuses_a_blank_before_the_colon) { EXPECT_EQ(status_of(kPost + "Content-Length : 5\r\n"), 400); }
TEST(Head, refuses_a_bare_line_feed) { EXPECT_EQ(status_of(kPost + "X: a\nContent-Length: 5\r\n"), 400); }
TEST(Head, refuses_a_bare_carriage_return) { EXPECT_EQ(status_of(kPost + "X: a\rb\r\n"), 400); }
TEST(Head, refuses_a_nul) { EXPECT_EQ(status_of(kPost + std::string("X: a\0b\r\n", 8)), 400); }
TEST(Head, refuses_control_characters_in_values) { EXPECT_EQ(status_of(kPost + "X: \x1b[31m\r\n"), 400); }
TEST(Head, refuses_other_expectations) { EXPECT_EQ(status_of(kPost + "Expect: 200-ok\r\n"), 417); }

}  // namespace
}  // namespace subdivd::server

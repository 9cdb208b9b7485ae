#include "server/transport/head_scan.h"

#include <gtest/gtest.h>

#include <string>

#include "server/transport/head.h"

namespace subdivd::server {
namespace {

using Verdict = HeadScan::Verdict;

Verdict verdict_of(const std::string& text) { return HeadScan().read(text); }

const std::string kHead = "GET / HTTP/1.1\r\nHost: a\r\nX:\t\xc3\xa9\r\n\r\n";

TEST(HeadScan, ends_at_the_empty_line) {
  HeadScan scan;
  EXPECT_EQ(scan.read(kHead + "body"), Verdict::complete);
  EXPECT_EQ(scan.size(), kHead.size());
}
TEST(HeadScan, does_not_care_how_the_head_arrives) {
  for (std::size_t i = 0; i < kHead.size(); ++i) {
    HeadScan scan;
    EXPECT_EQ(scan.read(kHead.substr(0, i)), Verdict::incomplete) << i;
    EXPECT_EQ(scan.read(kHead + "more"), Verdict::complete) << i;
    EXPECT_EQ(scan.size(), kHead.size()) << i;
  }
}
TEST(HeadScan, sees_at_once_what_can_never_become_a_head) {
  for (const std::string text : {"\x16", " ", "(", "\n", "GET\n", "GET\rX", "GET / HTTP/1.1\r\nHost: a\n",
                                 "G\x01", "G\x7f", "GET / HTTP/1.1\r\n\rX"})
    EXPECT_EQ(verdict_of(text), Verdict::not_http) << ::testing::PrintToString(text);
  EXPECT_EQ(verdict_of(std::string("G\0", 2)), Verdict::not_http);
}
TEST(HeadScan, bounds_the_head) {
  EXPECT_EQ(verdict_of("GET /" + std::string(kMaxHeadBytes, 'a')), Verdict::endless_target);
  EXPECT_EQ(verdict_of("GET / HTTP/1.1\r\nx: " + std::string(kMaxHeadBytes, 'a')), Verdict::too_large);
  const std::string longest = "GET / HTTP/1.1\r\nx: ";
  EXPECT_EQ(verdict_of(longest + std::string(kMaxHeadBytes - longest.size() - 4, 'a') + "\r\n\r\n"),
            Verdict::complete);
}

}  // namespace
}  // namespace subdivd::server

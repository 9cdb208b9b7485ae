// The reader of chunked bodies, without a socket.
#include "server/transport/chunked_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace subdivd::server {
namespace {

struct Read {
  ChunkedBody::State state;
  std::string body, rest;  // what came out, and what was left alone
};

// Feeds the pieces as they would come from a socket: what was not used comes again, with more behind it.
Read read(const std::vector<std::string>& pieces) {
  ChunkedBody chunks;
  std::string body, wire;
  for (const std::string& piece : pieces) {
    wire += piece;
    while (!wire.empty() && chunks.state() == ChunkedBody::State::reading) {
      const ChunkedBody::Step step = chunks.read(wire);
      body += step.data;
      wire.erase(0, step.used);
    }
  }
  return {chunks.state(), body, wire};
}

ChunkedBody::State state_of(const std::string& wire) { return read({wire}).state; }

const std::string kWhole =
    "5\r\nhello\r\n"
    "00A ;a=\"b c\";d\r\n, 10 bytes\r\n"
    "1;x\r\n!\r\n"
    "0\r\nX-Sum: 1 2\r\nEmpty:\r\n\r\n";

TEST(ChunkedBody, reads_sizes_extensions_and_trailers) {
  const Read result = read({kWhole + "GET /"});
  EXPECT_EQ(result.state, ChunkedBody::State::done);
  EXPECT_EQ(result.body, "hello, 10 bytes!");
  EXPECT_EQ(result.rest, "GET /");
}
TEST(ChunkedBody, does_not_care_where_the_wire_was_cut) {
  for (std::size_t i = 0; i <= kWhole.size(); ++i) {
    for (std::size_t k = i; k <= kWhole.size(); ++k) {
      const Read result = read({kWhole.substr(0, i), kWhole.substr(i, k - i), kWhole.substr(k) + "rest"});
      ASSERT_EQ(result.state, ChunkedBody::State::done) << i << ' ' << k;
      ASSERT_EQ(result.body, "hello, 10 bytes!") << i << ' ' << k;
      ASSERT_EQ(result.rest, "rest") << i << ' ' << k;
    }
  }
}
TEST(ChunkedBody, is_not_done_before_the_last_byte) {
  for (std::size_t i = 0; i < kWhole.size(); ++i)
    EXPECT_EQ(state_of(kWhole.substr(0, i)), ChunkedBody::State::reading) << i;
}
TEST(ChunkedBody, takes_an_empty_body) { EXPECT_EQ(state_of("000\r\n\r\n"), ChunkedBody::State::done); }
TEST(ChunkedBody, refuses_every_malformation) {
  for (const std::string wire :
       {"\r\n",         "g\r\n",       "-1\r\n",         "+1\r\n",           " 1\r\n",
        "0x1\r\n",      "1\n",         "1\rx",           "1 \r\n",           "1\t\r\n",
        "1,\r\n",       "1\r\nxy",     "1\r\nx\n",       "1\r\nx\rz",        "1\r\nx0\r\n",
        ";a\r\n",       "1;a\n",       "1;a\rb",         "1;\x01\r\n",       "1;\x7f\r\n",
        "0\r\n\n",      "0\r\n\rx",    "0\r\n x: y\r\n", "0\r\nx\r\n",       "0\r\nx : y\r\n",
        "0\r\n: y\r\n", "0\r\nx: y\n", "0\r\nx: y\rz",   "0\r\nx: \x01\r\n", "0\r\nx: y\r\n z\r\n"})
    EXPECT_EQ(state_of(wire), ChunkedBody::State::malformed) << ::testing::PrintToString(wire);
}
TEST(ChunkedBody, refuses_a_nul_everywhere) {
  const std::string wire = "1;a\r\nx\r\n0\r\nx: y\r\n\r\n";
  for (std::size_t i = 0; i < wire.size(); ++i) {
    if (wire[i] == 'x' && i == 5) continue;  // within the data it may stand
    std::string spoilt = wire;
    spoilt[i] = '\0';
    EXPECT_EQ(state_of(spoilt), ChunkedBody::State::malformed) << i;
  }
}
TEST(ChunkedBody, refuses_sizes_that_overflow) {
  for (const std::string size : {"10000000000000000", "fffffffffffffffff", "1000000000000000000000001"})
    EXPECT_EQ(state_of(size + "\r\n"), ChunkedBody::State::malformed) << size;
}
TEST(ChunkedBody, tells_the_size_of_a_chunk_before_it_comes) {
  ChunkedBody chunks;
  const ChunkedBody::Step step = chunks.read("fff\r\nabc");
  EXPECT_EQ(step.data, "abc");
  EXPECT_EQ(chunks.chunk_left(), 0xfffu - 3);
}
TEST(ChunkedBody, bounds_extensions_of_one_chunk_and_of_all_together) {
  EXPECT_EQ(state_of("1;" + std::string(ChunkedBody::kMaxExtensionBytes + 1, 'a')),
            ChunkedBody::State::malformed);
  std::string many;
  for (std::size_t i = 0; i < ChunkedBody::kMaxExtensionBytes; i += 4) many += "1;abcd\r\nx\r\n";
  EXPECT_EQ(state_of(many), ChunkedBody::State::malformed);
}
TEST(ChunkedBody, bounds_trailers) {
  EXPECT_EQ(state_of("0\r\nx: " + std::string(ChunkedBody::kMaxTrailerBytes, 'a')),
            ChunkedBody::State::malformed);
  std::string many = "0\r\n";
  for (std::size_t i = 0; i < ChunkedBody::kMaxTrailerBytes; i += 3) many += "x:y\r\n";
  EXPECT_EQ(state_of(many), ChunkedBody::State::malformed);
}

}  // namespace
}  // namespace subdivd::server

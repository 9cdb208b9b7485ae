// The memory of a body, without a socket.
#include "server/transport/body.h"

#include <gtest/gtest.h>

#include <string>

namespace subdivd::server {
namespace {

bool is_free(Quota& memory, std::uint64_t bytes) { return Quota::Lease(memory).grow_to(bytes); }

TEST(BodyBuffer, keeps_what_it_holds_when_it_grows) {
  Quota memory(1000);
  std::string body;
  BodyBuffer buffer(memory, body);
  ASSERT_TRUE(buffer.reserve(100, Clock::now()));
  body = std::string(100, 'x');
  ASSERT_TRUE(buffer.reserve(200, Clock::now()));
  EXPECT_EQ(body, std::string(100, 'x'));
  EXPECT_GE(body.capacity(), 200u);
}
TEST(BodyBuffer, pays_for_the_old_room_and_the_new_while_it_moves) {
  Quota memory(100);
  std::string body;
  BodyBuffer buffer(memory, body);
  ASSERT_TRUE(buffer.reserve(40, Clock::now()));
  EXPECT_FALSE(buffer.reserve(61, Clock::now()));
  EXPECT_EQ(buffer.reserved(), 40u);
  EXPECT_TRUE(buffer.reserve(60, Clock::now()));
  EXPECT_TRUE(is_free(memory, 40));
  EXPECT_FALSE(is_free(memory, 41));
}
TEST(BodyBuffer, gives_everything_back) {
  Quota memory(100);
  std::string body = "x";
  {
    BodyBuffer buffer(memory, body);
    ASSERT_TRUE(buffer.reserve(30, Clock::now()));
    ASSERT_TRUE(buffer.reserve(60, Clock::now()));
    ASSERT_FALSE(buffer.reserve(70, Clock::now()));
    buffer.release();
    EXPECT_TRUE(body.empty());
    EXPECT_TRUE(is_free(memory, 100));
    ASSERT_TRUE(buffer.reserve(50, Clock::now()));
  }
  EXPECT_TRUE(is_free(memory, 100));
}

}  // namespace
}  // namespace subdivd::server

// The memory of a body, without a socket.
#include "server/transport/body.h"

#include <gtest/gtest.h>

#include <string>

namespace subdivd::server {
namespace {

constexpr std::uint64_t kKiB = 1024;

// Of 8 MiB: 64 KiB are free; up to 384 KiB are medium (of 3 MiB), the rest large (of 4 MiB).

struct Grown {
  explicit Grown(RequestMemory& memory) : buffer(memory, body) {}
  bool to(std::uint64_t bytes) { return buffer.reserve(bytes, Clock::now(), nullptr); }
  std::string body;
  BodyBuffer buffer;
};

TEST(BodyBuffer, keeps_what_it_holds_when_it_grows) {
  RequestMemory memory(8192 * kKiB);
  Grown one(memory);
  std::string expected;
  for (const std::uint64_t size : {kKiB, 64 * kKiB, 300 * kKiB, 384 * kKiB, 4000 * kKiB}) {
    ASSERT_TRUE(one.to(size));
    EXPECT_EQ(one.body, expected);
    EXPECT_GE(one.body.capacity(), size);
    one.body.resize(size, 'x');
    expected.resize(size, 'x');
  }
}
TEST(BodyBuffer, pays_for_nothing_that_every_thread_has) {
  RequestMemory memory(8192 * kKiB);
  Grown one(memory);
  ASSERT_TRUE(one.to(64 * kKiB));
  EXPECT_EQ(memory.free(), memory.total());
}
TEST(BodyBuffer, pays_from_the_share_of_its_size) {
  RequestMemory memory(8192 * kKiB);
  Grown one(memory);
  ASSERT_TRUE(one.to(300 * kKiB));
  EXPECT_EQ(memory.medium.free(), (3072 - 300) * kKiB);
  ASSERT_TRUE(one.to(1000 * kKiB));
  EXPECT_EQ(memory.medium.free(), 3072 * kKiB);
  EXPECT_EQ(memory.large.free(), (4096 - 1000) * kKiB);
}
// All bodies stood in one queue: four large ones that were announced and not sent kept every tetrahedron
// waiting.
TEST(BodyBuffer, has_room_for_a_small_one_while_large_ones_take_all_of_theirs) {
  RequestMemory memory(8192 * kKiB);
  Grown large(memory), small(memory), medium(memory);
  ASSERT_TRUE(large.to(4096 * kKiB));
  EXPECT_TRUE(small.to(60 * kKiB));
  EXPECT_TRUE(medium.to(384 * kKiB));
  EXPECT_TRUE(Quota::Lease(memory.heads).grow_to(1024 * kKiB));
}
// While it moved, the old room and the new one were paid for from one share, and it waited for itself.
TEST(BodyBuffer, has_room_for_the_largest_body_whose_length_nobody_knew) {
  RequestMemory memory(8192 * kKiB);
  Grown one(memory);
  const std::uint64_t most = memory.most_body();
  for (std::uint64_t size = 1; size < most; size *= 2) {
    const bool fits = size <= one.buffer.reserved() || one.to(one.buffer.next_room(size, most));
    ASSERT_TRUE(fits) << size;
    one.body.resize(size, 'x');
  }
  ASSERT_TRUE(one.to(most));
  EXPECT_FALSE(one.to(most + 1));
}
TEST(BodyBuffer, gives_up_waiting_when_cancelled) {
  RequestMemory memory(8192 * kKiB);
  Grown large(memory), other(memory);
  ASSERT_TRUE(large.to(4096 * kKiB));
  const std::atomic<bool> cancelled = true;
  EXPECT_FALSE(other.buffer.reserve(500 * kKiB, Clock::now() + std::chrono::hours(1), &cancelled));
}
TEST(BodyBuffer, gives_everything_back) {
  RequestMemory memory(8192 * kKiB);
  {
    Grown one(memory);
    ASSERT_TRUE(one.to(100 * kKiB));
    ASSERT_TRUE(one.to(2000 * kKiB));
    ASSERT_FALSE(one.to(5000 * kKiB));
    one.buffer.release();
    EXPECT_TRUE(one.body.empty());
    EXPECT_EQ(memory.free(), memory.total());
    ASSERT_TRUE(one.to(500 * kKiB));
  }
  EXPECT_EQ(memory.free(), memory.total());
}

}  // namespace
}  // namespace subdivd::server

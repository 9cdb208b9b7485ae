#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "server/transport/quota.h"

namespace subdivd::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const auto kNow = [] { return Quota::Clock::now(); };

// What was given back was the old size less the old size, since the new one had been stored before it was
// read: every answer kept what it had been predicted to take beyond its size, and after some thousand
// requests nothing was free any more.
TEST(Quota, gets_back_what_a_lease_shrinks_by) {
  Quota quota(1000);
  Quota::Lease lease(quota);
  ASSERT_TRUE(lease.grow_to(800));
  lease.shrink_to(300);
  EXPECT_EQ(quota.free(), 700u);
  lease.release();
  EXPECT_EQ(quota.free(), 1000u);
}
TEST(Quota, is_whole_after_any_order_of_growing_and_shrinking) {
  Quota quota(1000);
  for (std::uint64_t a : {0, 1, 500, 1000})
    for (std::uint64_t b : {0, 1, 500, 1000})
      for (std::uint64_t c : {0, 1, 500, 1000}) {
        Quota::Lease lease(quota);
        EXPECT_TRUE(lease.grow_to(a));
        lease.shrink_to(b);
        EXPECT_EQ(lease.bytes(), std::min(a, b));
        EXPECT_TRUE(lease.grow_to(c));
        EXPECT_EQ(quota.free(), 1000 - lease.bytes());
        lease.shrink_to(b);
      }
  EXPECT_EQ(quota.free(), 1000u);
}
TEST(Quota, refuses_what_is_not_free_and_changes_nothing) {
  Quota quota(1000);
  Quota::Lease first(quota), second(quota);
  ASSERT_TRUE(first.grow_to(600));
  EXPECT_FALSE(second.grow_to(401));
  EXPECT_EQ(second.bytes(), 0u);
  EXPECT_EQ(quota.free(), 400u);
}
TEST(Quota, lets_one_wait_for_another) {
  Quota quota(1000);
  auto first = std::make_unique<Quota::Lease>(quota);
  ASSERT_TRUE(first->grow_to(600));
  Quota::Lease second(quota);
  std::thread waiting([&] { EXPECT_TRUE(second.grow_to(1000, kNow() + seconds(30), nullptr)); });
  std::this_thread::sleep_for(milliseconds(20));
  first.reset();
  waiting.join();
  EXPECT_EQ(quota.free(), 0u);
}
TEST(Quota, gives_up_at_the_deadline_and_when_cancelled) {
  Quota quota(1000);
  Quota::Lease first(quota), second(quota);
  ASSERT_TRUE(first.grow_to(600));
  EXPECT_FALSE(second.grow_to(500, kNow() + milliseconds(20), nullptr));
  const std::atomic<bool> cancelled = true;
  EXPECT_FALSE(second.grow_to(500, kNow() + seconds(30), &cancelled));
  EXPECT_TRUE(second.grow_to(400)) << "nobody waits any more";
}
TEST(Quota, never_waits_for_more_than_there_is) {
  Quota quota(1000);
  Quota::Lease lease(quota);
  EXPECT_FALSE(lease.grow_to(1001, kNow() + seconds(3600), nullptr));
}
TEST(Quota, is_whole_after_many_threads) {
  Quota quota(1000);
  std::vector<std::thread> threads;
  for (std::uint64_t t = 0; t < 8; ++t)
    threads.emplace_back([&quota, t] {
      for (std::uint64_t i = 0; i < 2000; ++i) {
        Quota::Lease lease(quota);
        if (lease.grow_to(1 + (i * 37 + t * 101) % 700, kNow() + seconds(30), nullptr))
          lease.shrink_to((i * 13) % 300);
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(quota.free(), 1000u);
}

}  // namespace
}  // namespace subdivd::server

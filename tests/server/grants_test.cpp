#include "server/grants.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace subdivd::server {
namespace {

using Clock = Grants::Clock;
using Denied = Grants::Denied;
using Lane = Grants::Lane;
using Outcome = std::variant<std::shared_ptr<Grants::Grant>, Denied>;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Count kMiB = Count{1} << 20;
constexpr Grants::Wish kLarge{Lane::large, 0};
constexpr Grants::Wish kSmall{Lane::small, 0};

Grants::Shares shares(std::size_t places, std::size_t max_waiting) {
  Grants::Shares shares;
  shares.places = places;
  shares.small_places = 1;
  shares.max_waiting = max_waiting;
  shares.bytes = 80 * kMiB;  // 10 for the small lane, 70 for the large one
  return shares;
}
bool granted(const Outcome& outcome) { return outcome.index() == 0; }
Grants::Grant& grant_of(const Outcome& outcome) { return *std::get<0>(outcome); }
void expect_whole(const Grants& grants) {
  const Grants::State state = grants.state();
  EXPECT_EQ(state.free_bytes, state.bytes);
  EXPECT_EQ(state.free_places, state.places);
  EXPECT_EQ(state.waiting, 0u);
}

TEST(Grants, admit_as_many_as_may_run) {
  Grants grants(shares(2, 0));
  const auto first = grants.enter(kLarge, Clock::now(), nullptr);
  const auto second = grants.enter(kLarge, Clock::now(), nullptr);
  EXPECT_TRUE(granted(first) && granted(second));
}
TEST(Grants, turn_away_what_may_not_wait) {
  Grants grants(shares(1, 0));
  const auto first = grants.enter(kLarge, Clock::now(), nullptr);
  EXPECT_EQ(std::get<Denied>(grants.enter(kLarge, Clock::now() + seconds(10), nullptr)), Denied::full);
}
TEST(Grants, admit_again_when_one_has_left) {
  Grants grants(shares(1, 0));
  { const auto first = grants.enter(kLarge, Clock::now(), nullptr); }
  EXPECT_TRUE(granted(grants.enter(kLarge, Clock::now(), nullptr)));
}
TEST(Grants, give_up_at_the_deadline) {
  Grants grants(shares(1, 1));
  const auto first = grants.enter(kLarge, Clock::now(), nullptr);
  const auto start = Clock::now();
  EXPECT_EQ(std::get<Denied>(grants.enter(kLarge, start + milliseconds(100), nullptr)), Denied::too_late);
  EXPECT_GE(Clock::now() - start, milliseconds(100));
}
TEST(Grants, give_up_when_cancelled) {
  Grants grants(shares(1, 1));
  const auto first = grants.enter(kLarge, Clock::now(), nullptr);
  const std::atomic<bool> cancelled = true;
  EXPECT_EQ(std::get<Denied>(grants.enter(kLarge, Clock::now() + seconds(10), &cancelled)),
            Denied::cancelled);
}
TEST(Grants, keep_no_trace_of_one_who_gave_up) {
  Grants grants(shares(1, 1));
  {
    const auto first = grants.enter({Lane::large, 50 * kMiB}, Clock::now(), nullptr);
    EXPECT_FALSE(granted(grants.enter({Lane::large, 50 * kMiB}, Clock::now() + milliseconds(10), nullptr)));
  }
  expect_whole(grants);
}
TEST(Grants, serve_small_requests_while_large_ones_take_every_place) {
  Grants grants(shares(1, 0));
  const auto large = grants.enter({Lane::large, 70 * kMiB}, Clock::now(), nullptr);
  EXPECT_TRUE(granted(grants.enter({Lane::small, kMiB}, Clock::now(), nullptr)));
}
TEST(Grants, do_not_let_a_slow_small_request_keep_the_next_one_waiting) {
  Grants grants(shares(1, 1));
  const auto slow = grants.enter(kSmall, Clock::now(), nullptr);
  EXPECT_TRUE(granted(grants.enter(kSmall, Clock::now() + seconds(30), nullptr)));
}
TEST(Grants, send_what_takes_much_memory_to_the_large_lane) {
  Grants grants(shares(1, 0));
  const auto large = grants.enter(kLarge, Clock::now(), nullptr);
  EXPECT_FALSE(granted(grants.enter({Lane::small, 40 * kMiB}, Clock::now(), nullptr)));
  const auto small = grants.enter({Lane::small, kMiB}, Clock::now(), nullptr);
  ASSERT_TRUE(grant_of(small).take(kMiB));
  const auto taken = grant_of(small).take(40 * kMiB);
  EXPECT_EQ(taken.error().code, ErrorCode::overloaded);
  EXPECT_EQ(grant_of(small).wish().lane, Lane::large);
  EXPECT_EQ(grant_of(small).wish().bytes, 41 * kMiB);
}
TEST(Grants, say_what_to_come_again_for) {
  Grants grants(shares(2, 0));
  const auto first = grants.enter({Lane::large, 50 * kMiB}, Clock::now(), nullptr);
  {
    const auto second = grants.enter({Lane::large, 10 * kMiB}, Clock::now(), nullptr);
    ASSERT_TRUE(grant_of(second).take(15 * kMiB));
    EXPECT_EQ(grant_of(second).take(15 * kMiB).error().code, ErrorCode::overloaded);
    EXPECT_EQ(grant_of(second).wish().bytes, 30 * kMiB);
  }
  EXPECT_EQ(grants.state().free_bytes, 30 * kMiB);
}
// It came again for what it had been short of, and asked for all of it once more on top: whether a request
// could be had depended on how busy the others were.
TEST(Grants, count_what_was_wished_for_only_once) {
  Grants grants(shares(1, 0));
  const auto again = grants.enter({Lane::large, 40 * kMiB}, Clock::now(), nullptr);
  EXPECT_TRUE(grant_of(again).take(30 * kMiB));
  EXPECT_TRUE(grant_of(again).take(10 * kMiB));
  EXPECT_EQ(grants.state().free_bytes, 40 * kMiB);
  EXPECT_TRUE(grant_of(again).take(30 * kMiB));
  EXPECT_EQ(grants.state().free_bytes, 10 * kMiB);
  EXPECT_EQ(grant_of(again).take(kMiB).error().code, ErrorCode::too_large);
}
TEST(Grants, refuse_for_ever_what_can_never_be_had) {
  Grants grants(shares(1, 1));
  EXPECT_EQ(std::get<Denied>(grants.enter({Lane::large, 71 * kMiB}, Clock::now() + seconds(10), nullptr)),
            Denied::too_large);
  const auto grant = grants.enter({Lane::large, 10 * kMiB}, Clock::now(), nullptr);
  ASSERT_TRUE(grant_of(grant).take(10 * kMiB));
  const auto taken = grant_of(grant).take(61 * kMiB);
  EXPECT_EQ(taken.error().code, ErrorCode::too_large);
  EXPECT_EQ(taken.error().predicted, 71 * kMiB);
  EXPECT_EQ(taken.error().allowed, grants.most_bytes());
  EXPECT_EQ(grant_of(grant).take(~Count{0}).error().code, ErrorCode::too_large) << "no sum may overflow";
}
TEST(Grants, keep_an_answer_but_not_its_place) {
  Grants grants(shares(1, 0));
  {
    const auto first = grants.enter({Lane::large, 50 * kMiB}, Clock::now(), nullptr);
    grant_of(first).keep_only(20 * kMiB);
    EXPECT_EQ(grants.state().free_bytes, 60 * kMiB);
    EXPECT_TRUE(granted(grants.enter(kLarge, Clock::now(), nullptr)));
    EXPECT_FALSE(granted(grants.enter({Lane::large, 51 * kMiB}, Clock::now(), nullptr)));
  }
  expect_whole(grants);
}
// 58 clients that did not read their small answers kept a tetrahedron waiting for half a minute.
TEST(Grants, do_not_let_unread_answers_shut_the_small_lane) {
  Grants grants(shares(1, 0));
  std::vector<Outcome> answers;
  for (int i = 0; i < 20; ++i) {
    answers.push_back(grants.enter({Lane::small, 3 * kMiB}, Clock::now(), nullptr));
    ASSERT_TRUE(granted(answers.back())) << i;
    grant_of(answers.back()).keep_only(3 * kMiB);
  }
  EXPECT_EQ(grants.state().free_bytes, 20 * kMiB);
  answers.clear();
  expect_whole(grants);
}
TEST(Grants, do_not_let_large_requests_that_wait_turn_small_ones_away) {
  Grants grants(shares(1, 1));
  const auto large = grants.enter(kLarge, Clock::now(), nullptr);
  std::thread waits([&] { (void)grants.enter(kLarge, Clock::now() + seconds(1), nullptr); });
  while (grants.state().waiting == 0) std::this_thread::yield();
  const auto small = grants.enter(kSmall, Clock::now(), nullptr);
  EXPECT_TRUE(granted(grants.enter(kSmall, Clock::now() + seconds(30), nullptr)));
  waits.join();
}
TEST(Grants, let_one_wait_again_that_was_short_of_memory) {
  Grants grants(shares(1, 0));
  const auto first = grants.enter(kLarge, Clock::now(), nullptr);
  EXPECT_EQ(std::get<Denied>(grants.enter({Lane::large, kMiB}, Clock::now() + milliseconds(10), nullptr)),
            Denied::too_late);
}
TEST(Grants, let_the_first_to_come_be_the_first_to_be_served) {
  Grants grants(shares(1, 10));
  auto first = grants.enter({Lane::large, 30 * kMiB}, Clock::now(), nullptr);
  std::vector<int> order;
  std::mutex mutex;
  const auto come = [&](int number, Count bytes) {
    const auto grant = grants.enter({Lane::large, bytes}, Clock::now() + seconds(30), nullptr);
    const std::lock_guard lock(mutex);
    order.push_back(granted(grant) ? number : -number);
  };
  std::vector<std::thread> threads;
  for (int k = 1; k <= 3; ++k) {
    threads.emplace_back(come, k, k == 1 ? 70 * kMiB : kMiB);
    while (grants.state().waiting < static_cast<std::size_t>(k)) std::this_thread::yield();
  }
  first = Denied::full;  // gives it back
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(order, (std::vector<int>{1, 2, 3})) << "small wishes do not starve a large one";
}
// What is taken is given back, whatever way a request ends.
TEST(Grants, are_whole_after_many_threads) {
  Grants grants(shares(3, 100));
  std::atomic<int> running = 0, most = 0, served = 0;
  std::vector<std::thread> threads;
  for (unsigned t = 0; t < 16; ++t)
    threads.emplace_back([&, t] {
      for (unsigned i = 0; i < 200; ++i) {
        const Count bytes = (i * 7919 + t * 104729) % (30 * kMiB);
        const auto grant = grants.enter({Lane::large, bytes}, Clock::now() + seconds(60), nullptr);
        if (!granted(grant)) continue;
        const int now = ++running;
        for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
        }
        (void)grant_of(grant).take(bytes / 2);
        if (i % 3 == 0) (void)grant_of(grant).take(60 * kMiB);
        --running;
        if (i % 2 == 0) grant_of(grant).keep_only(bytes / 4);
        ++served;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_LE(most, 3);
  EXPECT_EQ(served, 16 * 200);
  expect_whole(grants);
}

}  // namespace
}  // namespace subdivd::server

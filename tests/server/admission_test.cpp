#include "server/admission.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace subdivd::server {
namespace {

using Clock = Admission::Clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

bool admitted(const std::variant<Admission::Ticket, Admission::Denied>& outcome) {
  return std::holds_alternative<Admission::Ticket>(outcome);
}

TEST(Admission, admits_as_many_as_may_run) {
  Admission gate(2, 0);
  const auto first = gate.enter(Clock::now(), nullptr);
  const auto second = gate.enter(Clock::now(), nullptr);
  EXPECT_TRUE(admitted(first) && admitted(second));
}
TEST(Admission, turns_away_what_may_not_wait) {
  Admission gate(1, 0);
  const auto first = gate.enter(Clock::now(), nullptr);
  EXPECT_EQ(std::get<Admission::Denied>(gate.enter(Clock::now() + seconds(10), nullptr)),
            Admission::Denied::full);
}
TEST(Admission, admits_again_when_one_has_left) {
  Admission gate(1, 0);
  { const auto first = gate.enter(Clock::now(), nullptr); }
  EXPECT_TRUE(admitted(gate.enter(Clock::now(), nullptr)));
}
TEST(Admission, gives_up_at_the_deadline) {
  Admission gate(1, 1);
  const auto first = gate.enter(Clock::now(), nullptr);
  const auto start = Clock::now();
  EXPECT_EQ(std::get<Admission::Denied>(gate.enter(start + milliseconds(100), nullptr)),
            Admission::Denied::too_late);
  EXPECT_GE(Clock::now() - start, milliseconds(100));
}
TEST(Admission, gives_up_when_cancelled) {
  Admission gate(1, 1);
  const auto first = gate.enter(Clock::now(), nullptr);
  const std::atomic<bool> cancelled = true;
  EXPECT_EQ(std::get<Admission::Denied>(gate.enter(Clock::now() + seconds(10), &cancelled)),
            Admission::Denied::cancelled);
}
TEST(Admission, leaves_no_trace_of_one_who_gave_up) {
  Admission gate(1, 1);
  {
    const auto first = gate.enter(Clock::now(), nullptr);
    EXPECT_FALSE(admitted(gate.enter(Clock::now() + milliseconds(10), nullptr)));
  }
  EXPECT_TRUE(admitted(gate.enter(Clock::now() + seconds(10), nullptr)));
}
TEST(Admission, never_runs_more_than_allowed) {
  Admission gate(3, 100);
  std::atomic<int> running = 0, most = 0, served = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 40; ++i) {
    threads.emplace_back([&] {
      const auto ticket = gate.enter(Clock::now() + seconds(30), nullptr);
      if (!admitted(ticket)) return;
      const int now = ++running;
      for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
      }
      std::this_thread::sleep_for(milliseconds(2));
      --running;
      ++served;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_LE(most, 3);
  EXPECT_EQ(served, 40);
}

}  // namespace
}  // namespace subdivd::server

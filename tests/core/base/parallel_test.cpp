#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <new>
#include <vector>

namespace subdivd {
namespace {

TEST(parallel, shares_cover_everything_once) {
  for (const Count total : {Count{0}, Count{1}, Count{5}, Count{1000003}})
    for (const Index threads : {1u, 2u, 3u, 7u}) {
      std::vector<Range> shares(threads);
      const auto done = Team::run(threads, {}, [&](Worker& worker) {
        shares[worker.index()] = worker.share(total);
        EXPECT_EQ(worker.count(), threads);
      });
      ASSERT_TRUE(done.ok());
      Count next = 0;
      for (const Range& share : shares) {
        EXPECT_EQ(share.begin, next);
        next = share.end;
      }
      EXPECT_EQ(next, total);
    }
}

TEST(parallel, what_was_written_before_a_meeting_is_read_after_it) {
  std::vector<int> written(7, 0);
  const auto done = Team::run(7, {}, [&](Worker& worker) {
    written[worker.index()] = 1;
    if (!worker.meet()) return;
    for (const int one : written) EXPECT_EQ(one, 1);
  });
  EXPECT_TRUE(done.ok());
}

TEST(parallel, all_stop_when_one_finds_the_budget_dry) {
  const std::atomic<bool> cancelled{true};
  Budget budget;
  budget.cancelled = &cancelled;
  std::atomic<int> went_on{0};
  const auto done = Team::run(3, budget, [&](Worker& worker) {
    if (worker.index() == 1) (void)worker.go_on(Count{1} << 20);
    if (worker.meet()) ++went_on;
  });
  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().code, ErrorCode::cancelled);
  EXPECT_EQ(went_on, 0);
}

// Memory may run out on any thread: that must neither end the process nor leave the others waiting.
TEST(parallel, what_a_worker_throws_reaches_the_caller) {
  for (const Index thrower : {0u, 1u, 2u}) {
    std::atomic<int> went_on{0};
    const auto run = [&] {
      (void)Team::run(3, {}, [&](Worker& worker) {
        if (!worker.meet()) return;
        if (worker.index() == thrower) throw std::bad_alloc();
        if (worker.meet()) ++went_on;
      });
    };
    EXPECT_THROW(run(), std::bad_alloc);
    EXPECT_EQ(went_on, 0);
  }
}

}  // namespace
}  // namespace subdivd

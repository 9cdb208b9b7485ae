// A team whose memory ends. A program of its own: it replaces operator new.

#include <gtest/gtest.h>

#include <atomic>
#include <new>

#include "core/base/parallel.h"
#include "core/base/thread_pool.h"
#include "tests/support/allocations.h"

namespace subdivd {
namespace {

TEST(StarvedTeam, ends_at_every_allocation_that_fails_and_leaves_its_helpers_to_the_next) {
  ThreadPool pool(2);
  Budget budget;
  budget.helpers = &pool;
  const auto run = [&] {
    std::atomic<Index> sum{0};
    const auto done = Team::run(3, budget, [&](Worker& worker) {
      if (worker.meet()) sum += worker.count();
    });
    EXPECT_TRUE(done.ok());
    EXPECT_EQ(sum, 9u);
  };
  run();  // the pool has its lists
  std::int64_t failed = 0;
  for (bool more = true; more;) {
    const test::Allocations starved({.at = failed});
    try {
      run();
      more = false;
    } catch (const std::bad_alloc&) {
      ++failed;
    }
  }
  EXPECT_GT(failed, 0);
  run();
}

}  // namespace
}  // namespace subdivd

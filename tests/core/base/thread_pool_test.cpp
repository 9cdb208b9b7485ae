#include "core/base/thread_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "core/base/parallel.h"

namespace subdivd {
namespace {

// Counts how often each number was called.
class Counting final : public Helpers::Job {
 public:
  explicit Counting(Index most) : calls_(most + 1) {}
  void run(Index k) override { ++calls_[k]; }
  std::vector<int> calls() const { return {calls_.begin(), calls_.end()}; }

 private:
  std::vector<std::atomic<int>> calls_;
};

TEST(ThreadPool, calls_each_number_once) {
  ThreadPool pool(3);
  EXPECT_EQ(pool.most(), 3u);
  for (int round = 0; round < 200; ++round) {
    Counting job(3);
    ASSERT_EQ(pool.start(5, job), 3u);
    pool.finish(job);
    EXPECT_EQ(job.calls(), (std::vector<int>{0, 1, 1, 1}));
  }
}

TEST(ThreadPool, lends_only_threads_that_have_no_other_work) {
  struct Waiting final : Helpers::Job {
    std::atomic<bool> go{false};
    void run(Index) override { go.wait(false); }
  } waiting;
  ThreadPool pool(3);
  ASSERT_EQ(pool.start(2, waiting), 2u);
  Counting one(3);
  ASSERT_EQ(pool.start(3, one), 1u);
  pool.finish(one);
  EXPECT_EQ(one.calls(), (std::vector<int>{0, 1, 0, 0}));
  waiting.go = true;
  waiting.go.notify_all();
  pool.finish(waiting);
  Counting all(3);
  EXPECT_EQ(pool.start(3, all), 3u);
  pool.finish(all);
}

TEST(ThreadPool, lends_no_more_than_are_spare) {
  Index spare = 0;
  ThreadPool pool(4, [&] { return spare; });
  Counting job(4);
  EXPECT_EQ(pool.start(4, job), 0u);
  spare = 2;
  EXPECT_EQ(pool.start(4, job), 2u);
  pool.finish(job);
  EXPECT_EQ(job.calls(), (std::vector<int>{0, 1, 1, 0, 0}));
}

TEST(ThreadPool, serves_many_at_once) {
  ThreadPool pool(3);
  std::atomic<Count> sum{0};
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 6; ++caller)
    callers.emplace_back([&] {
      Budget budget;
      budget.helpers = &pool;
      for (int round = 0; round < 100; ++round) {
        const auto done = Team::run(4, budget, [&](Worker& worker) {
          const Range share = worker.share(1000);
          if (!worker.meet()) return;
          sum += share.end - share.begin;
        });
        EXPECT_TRUE(done.ok());
      }
    });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(sum, 6u * 100 * 1000);
}

TEST(ThreadPool, helps_a_team_that_throws_and_is_there_for_the_next) {
  ThreadPool pool(2);
  Budget budget;
  budget.helpers = &pool;
  for (Index thrower = 0; thrower < 3; ++thrower) {
    EXPECT_THROW((void)Team::run(3, budget,
                                 [&](Worker& worker) {
                                   if (worker.index() == thrower) throw std::bad_alloc();
                                   (void)worker.meet();
                                 }),
                 std::bad_alloc);
    Index most = 0;
    ASSERT_TRUE(Team::run(3, budget, [&](Worker& worker) {
                  if (worker.index() == 0) most = worker.count();
                }).ok());
    EXPECT_EQ(most, 3u);
  }
}

}  // namespace
}  // namespace subdivd

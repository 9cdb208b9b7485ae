#pragma once
// The threads of a process that help whoever computes.

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "core/base/helpers.h"

namespace subdivd {

class ThreadPool final : public Helpers {
 public:
  // `spare`: asked at every start how many threads may be at work beside those that work already; helpers
  // know of each other, but not of the threads that they help. Fewer threads when the system has no more.
  explicit ThreadPool(Index threads, std::function<Index()> spare = {});
  ~ThreadPool() override;

  Index most() const override { return static_cast<Index>(threads_.size()); }
  Index start(Index most, Job& job) override;
  void finish(Job& job) override;

 private:
  struct Task {
    Job* job;
    Index next, end;  // numbers that no thread has begun with
    Index unfinished;
  };
  void work();
  Task* next_task();

  const std::function<Index()> spare_;
  std::mutex mutex_;
  std::condition_variable begun_, finished_;
  std::vector<Task> tasks_;
  Index promised_ = 0;  // of the threads: at work, or about to begin
  bool ended_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace subdivd

#include "core/base/thread_pool.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace subdivd {

ThreadPool::ThreadPool(Index threads, std::function<Index()> spare) : spare_(std::move(spare)) {
  threads_.reserve(threads);
  try {
    for (Index k = 0; k < threads; ++k) threads_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {
    // Those that there are help as well as they can.
  }
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  begun_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

Index ThreadPool::start(Index most, Job& job) {
  const Index spare = spare_ ? spare_() : ThreadPool::most();
  Index count = 0;
  {
    const std::lock_guard lock(mutex_);
    const Index allowed = std::min(spare, ThreadPool::most());
    count = std::min(most, allowed - std::min(allowed, promised_));
    if (count == 0) return 0;
    tasks_.push_back({&job, 1, count + 1, count});
    promised_ += count;
  }
  for (Index k = 0; k < count; ++k) begun_.notify_one();
  return count;
}

void ThreadPool::finish(Job& job) {
  std::unique_lock lock(mutex_);
  const auto task = [&] { return std::ranges::find(tasks_, &job, &Task::job); };
  finished_.wait(lock, [&] { return task() == tasks_.end() || task()->unfinished == 0; });
  if (task() != tasks_.end()) tasks_.erase(task());
}

ThreadPool::Task* ThreadPool::next_task() {
  const auto found = std::ranges::find_if(tasks_, [](const Task& task) { return task.next < task.end; });
  return found == tasks_.end() ? nullptr : &*found;
}

void ThreadPool::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    begun_.wait(lock, [&] { return ended_ || next_task() != nullptr; });
    if (ended_) return;
    Task* task = next_task();
    Job* const job = task->job;
    const Index k = task->next++;
    lock.unlock();
    job->run(k);
    lock.lock();
    --promised_;
    task = &*std::ranges::find(tasks_, job, &Task::job);
    if (--task->unfinished == 0) finished_.notify_all();
  }
}

}  // namespace subdivd

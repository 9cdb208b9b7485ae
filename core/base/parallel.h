#pragma once
// A fixed partition of work over threads: which worker does what depends on the numbers alone, so the answer
// can be the same bytes for any number of them.

#include <atomic>
#include <barrier>
#include <exception>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/budget.h"
#include "core/base/helpers.h"
#include "core/base/index.h"
#include "core/base/result.h"

namespace subdivd {

// Thrown by work that is to stop (pace.h); the error is empty where a team knows it.
struct Stopped {
  Error error;
};

// [begin, end)
struct Range {
  Count begin = 0, end = 0;
};

class Team;

// What one of the threads of a team sees.
class Worker {
 public:
  Worker(Team& team, Index index, Index count) : team_(&team), index_(index), count_(count) {}

  Index index() const { return index_; }
  Index count() const { return count_; }
  // This worker's part of 0..total-1.
  Range share(Count total) const {
    return {total / count_ * index_ + total % count_ * index_ / count_,
            total / count_ * (index_ + 1) + total % count_ * (index_ + 1) / count_};
  }
  // One that has everything to itself, for what is too little to share. It must not meet.
  Worker alone() const { return {*team_, 0, 1}; }
  // False when the team is to stop. Call after `steps` more elementary steps (points, faces: some 10 ns
  // each); every few thousand of them the budget is polled.
  bool go_on(Count steps);
  // Returns when every worker has come here: what they wrote before, all may read. False when the team is to
  // stop; every worker then gets false.
  bool meet();

 private:
  static constexpr Count kStepsPerPoll = 1 << 15;
  Team* team_;
  Index index_, count_;
  Count steps_ = 0;
};

// For who has no other: threads made for one job.
class MadeThreads final : public Helpers {
 public:
  Index most() const override { return kNoIndex; }
  Index start(Index most, Job& job) override {
    threads_.reserve(most);
    try {
      for (Index k = 1; k <= most; ++k) threads_.emplace_back([&job, k] { job.run(k); });
    } catch (const std::exception&) {  // no more threads, or no memory for them
      // The threads that there are do the work of all.
    }
    return static_cast<Index>(threads_.size());
  }
  void finish(Job&) override {
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  std::vector<std::thread> threads_;
};

class Team {
 public:
  // Calls work(worker) once on each of `threads` threads (at least 1; fewer when there are no more helpers)
  // and waits for all. `work` returns early when go_on or meet says false; the reason is returned here.
  // What one of them throws (out of memory) stops all and is thrown here, when all have ended.
  template <class Work>
  static Result<void> run(Index threads, const Budget& budget, Work&& work) {
    Team team(budget);
    team.start(threads, [&](Worker worker) { work(worker); });
    if (team.thrown_) std::rethrow_exception(team.thrown_);
    if (team.error_) return std::move(*team.error_);
    return {};
  }

 private:
  friend class Worker;
  explicit Team(const Budget& budget) : budget_(budget) {}

  // The work as the helpers see it: how many share it is known only when they have been asked.
  template <class Work>
  class Parts final : public Helpers::Job {
   public:
    Parts(Team& team, Work& work) : team_(team), work_(work) {}
    void run(Index k) override {
      count_.wait(0);
      if (count_ != kAbandoned) team_.guarded(work_, Worker(team_, k, count_));
    }
    void begin(Index count) {
      count_ = count;
      count_.notify_all();
    }
    // Whoever has been started returns.
    void abandon() { begin(kAbandoned); }

   private:
    static constexpr Index kAbandoned = kNoIndex;
    Team& team_;
    Work& work_;
    std::atomic<Index> count_{0};
  };

  template <class Work>
  void start(Index threads, Work&& work) {
    Parts<std::remove_reference_t<Work>> parts(*this, work);
    MadeThreads made;
    Helpers& helpers = budget_.helpers != nullptr ? *budget_.helpers : static_cast<Helpers&>(made);
    const Index others = threads > 1 ? helpers.start(threads - 1, parts) : 0;
    try {
      barrier_.emplace(others + 1);  // which takes memory
    } catch (...) {
      parts.abandon();
      if (others > 0) helpers.finish(parts);
      throw;
    }
    parts.begin(others + 1);
    parts.run(0);
    if (others > 0) helpers.finish(parts);
  }

  template <class Work>
  void guarded(Work& work, Worker worker) {
    try {
      work(worker);
    } catch (const Stopped&) {
      barrier_->arrive_and_drop();  // the others stop, too
    } catch (...) {
      {
        const std::lock_guard lock(mutex_);
        if (!thrown_) thrown_ = std::current_exception();
      }
      stopped_.store(true, std::memory_order_relaxed);
      barrier_->arrive_and_drop();  // the others need not wait for this one any more
    }
  }

  void poll() {
    if (auto stop = budget_.poll()) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::move(stop);
      stopped_.store(true, std::memory_order_relaxed);
    }
  }

  const Budget& budget_;
  std::optional<std::barrier<>> barrier_;
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  std::optional<Error> error_;
  std::exception_ptr thrown_;
};

inline bool Worker::go_on(Count steps) {
  steps_ += steps;
  if (steps_ >= kStepsPerPoll) {
    steps_ = 0;
    team_->poll();
  }
  return !team_->stopped_.load(std::memory_order_relaxed);
}

inline bool Worker::meet() {
  // A worker that stopped comes here too: all leave together, or the others would wait for ever. Whether to
  // stop is read between two barriers, when nobody can change it.
  team_->barrier_->arrive_and_wait();
  const bool stopped = team_->stopped_.load(std::memory_order_relaxed);
  team_->barrier_->arrive_and_wait();
  return !stopped;
}

}  // namespace subdivd

#pragma once
// Bytes of memory that all requests share: what their bodies take while they are read and answered.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>

namespace subdivd::server {

class Quota {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Quota(std::uint64_t total) : total_(total), free_(total) {}
  Quota(const Quota&) = delete;
  Quota& operator=(const Quota&) = delete;

  // A share of the quota, given back on destruction. Not to be used from several threads at once.
  class Lease {
   public:
    explicit Lease(Quota& quota) : quota_(&quota) {}
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    ~Lease() { release(); }

    std::uint64_t bytes() const { return bytes_; }

    // Makes the share at least `bytes` large; false (and nothing changed) when so much is not free, or when
    // others have waited for longer.
    bool grow_to(std::uint64_t bytes) {
      return bytes <= bytes_ || adopt(bytes, quota_->take(bytes - bytes_));
    }
    // The same, but waits for others to give back, first come first served, until `deadline` or until
    // `cancelled` (may be null) turns true. Whoever waits must hold nothing that another one waits for: so
    // grow once, to all that will be needed.
    bool grow_to(std::uint64_t bytes, Clock::time_point deadline, const std::atomic<bool>* cancelled) {
      return bytes <= bytes_ || adopt(bytes, quota_->wait(bytes - bytes_, deadline, cancelled));
    }
    void shrink_to(std::uint64_t bytes) {
      if (bytes >= bytes_) return;
      const std::uint64_t returned = bytes_ - bytes;
      bytes_ = bytes;
      quota_->give_back(returned);
    }
    void release() { shrink_to(0); }

   private:
    bool adopt(std::uint64_t bytes, bool taken) {
      if (taken) bytes_ = bytes;
      return taken;
    }

    Quota* quota_;
    std::uint64_t bytes_ = 0;
  };

  std::uint64_t total() const { return total_; }
  std::uint64_t free() const {
    const std::lock_guard lock(mutex_);
    return free_;
  }

 private:
  static constexpr std::chrono::milliseconds kSlice{
      50};  // how soon a waiting one notices that it is cancelled

  bool take(std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    if (bytes > free_ || !waiting_.empty()) return false;
    free_ -= bytes;
    return true;
  }

  bool wait(std::uint64_t bytes, Clock::time_point deadline, const std::atomic<bool>* cancelled) {
    if (bytes > total_) return false;
    std::unique_lock lock(mutex_);
    const std::uint64_t number = next_number_++;
    waiting_.push_back(number);
    const auto my_turn = [&] { return waiting_.front() == number && bytes <= free_; };
    bool given_up = false;
    while (!given_up && !my_turn()) {
      changed_.wait_until(lock, std::min(deadline, Clock::now() + kSlice), my_turn);
      given_up = Clock::now() >= deadline || (cancelled != nullptr && *cancelled);
    }
    const bool taken = my_turn();
    if (taken) free_ -= bytes;
    waiting_.erase(std::find(waiting_.begin(), waiting_.end(), number));
    changed_.notify_all();  // the next in line may find enough
    return taken;
  }

  void give_back(std::uint64_t bytes) {
    {
      const std::lock_guard lock(mutex_);
      free_ += bytes;
    }
    changed_.notify_all();
  }

  const std::uint64_t total_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::uint64_t> waiting_;  // numbers drawn by those who wait, the longest waiting first
  std::uint64_t next_number_ = 0;
  std::uint64_t free_;
};

}  // namespace subdivd::server

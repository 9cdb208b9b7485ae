#pragma once
// Bytes of memory that all requests share: what their bodies take while they are read and answered.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>

#include "server/transport/waiting_line.h"

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
  bool take(std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    if (bytes > free_ || !line_.empty()) return false;
    free_ -= bytes;
    return true;
  }

  bool wait(std::uint64_t bytes, Clock::time_point deadline, const std::atomic<bool>* cancelled) {
    if (bytes > total_) return false;
    std::unique_lock lock(mutex_);
    const auto is_there = [&] { return bytes <= free_; };
    if (line_.wait(lock, deadline, cancelled, is_there) != WaitingLine::End::turn) return false;
    free_ -= bytes;
    return true;
  }

  void give_back(std::uint64_t bytes) {
    {
      const std::lock_guard lock(mutex_);
      free_ += bytes;
    }
    line_.changed();
  }

  const std::uint64_t total_;
  mutable std::mutex mutex_;
  WaitingLine line_;
  std::uint64_t free_;
};

}  // namespace subdivd::server

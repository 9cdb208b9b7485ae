#pragma once
// Bytes of memory that all requests share: for bodies, for the work, for answers that wait for slow readers.

#include <atomic>
#include <cstdint>
#include <utility>

namespace subdivd::server {

class Quota {
 public:
  explicit Quota(std::uint64_t total) : total_(total), free_(total) {}
  Quota(const Quota&) = delete;
  Quota& operator=(const Quota&) = delete;

  // A share of the quota, given back on destruction.
  class Lease {
   public:
    explicit Lease(Quota& quota) : quota_(&quota) {}
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    ~Lease() { release(); }

    // Makes the share at least `bytes` large; false (and nothing changed) when so much is not free.
    bool grow_to(std::uint64_t bytes) {
      if (bytes <= bytes_) return true;
      if (!quota_->take(bytes - bytes_)) return false;
      bytes_ = bytes;
      return true;
    }
    void shrink_to(std::uint64_t bytes) {
      if (bytes < bytes_) quota_->free_ += bytes_ - std::exchange(bytes_, bytes);
    }
    void release() { quota_->free_ += std::exchange(bytes_, 0); }

   private:
    Quota* quota_;
    std::uint64_t bytes_ = 0;
  };

  std::uint64_t total() const { return total_; }

 private:
  bool take(std::uint64_t bytes) {
    std::uint64_t now = free_.load();
    while (now >= bytes)
      if (free_.compare_exchange_weak(now, now - bytes)) return true;
    return false;
  }

  const std::uint64_t total_;
  std::atomic<std::uint64_t> free_;
};

}  // namespace subdivd::server

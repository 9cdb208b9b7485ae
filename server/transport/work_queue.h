#pragma once
// Accepted connections that wait for a thread. Bounded: what does not fit stays in the kernel's queue, which
// is bounded too, so a flood of connections costs neither memory nor descriptors without end.

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>

namespace subdivd::server {

class WorkQueue {
 public:
  explicit WorkQueue(std::size_t capacity) : capacity_(capacity) {}

  // Waits for room; false (and `fd` remains the caller's) after close().
  bool push(int fd) {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [this] { return closed_ || waiting_.size() < capacity_; });
    if (closed_) return false;
    waiting_.push_back(fd);
    ready_.notify_one();
    return true;
  }

  // Waits for a connection; empty after close(), when none is left.
  std::optional<int> pop() {
    std::unique_lock lock(mutex_);
    ready_.wait(lock, [this] { return closed_ || !waiting_.empty(); });
    if (waiting_.empty()) return std::nullopt;
    const int fd = waiting_.front();
    waiting_.pop_front();
    room_.notify_one();
    return fd;
  }

  bool empty() const {
    const std::lock_guard lock(mutex_);
    return waiting_.empty();
  }

  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    ready_.notify_all();
    room_.notify_all();
  }

 private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable ready_, room_;
  std::deque<int> waiting_;
  bool closed_ = false;
};

}  // namespace subdivd::server

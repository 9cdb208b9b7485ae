#pragma once
// How many connections there are, and how many requests are being read, answered or sent.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <utility>

namespace subdivd::server {

class Census {
 public:
  // One connection, or one request, counted as long as it lives.
  class Counted {
   public:
    Counted() = default;
    Counted(Counted&& other) noexcept : of_(std::exchange(other.of_, nullptr)), add_(other.add_) {}
    Counted& operator=(Counted&& other) noexcept {
      std::swap(of_, other.of_);
      std::swap(add_, other.add_);
      return *this;
    }
    ~Counted() {
      if (of_ != nullptr) (of_->*add_)(-1);
    }

   private:
    friend class Census;
    using Add = void (Census::*)(int);
    Counted(Census& of, Add add) : of_(&of), add_(add) { (of_->*add_)(1); }
    Census* of_ = nullptr;
    Add add_ = nullptr;
  };

  Counted connection() { return {*this, &Census::add_connection}; }
  Counted request() { return {*this, &Census::add_request}; }

  std::size_t connections() const { return static_cast<std::size_t>(connections_.load()); }
  std::size_t requests() const {
    const std::lock_guard lock(mutex_);
    return static_cast<std::size_t>(requests_);
  }
  // False when requests are still under way at the deadline.
  bool wait_until_no_request(std::chrono::steady_clock::time_point deadline) {
    std::unique_lock lock(mutex_);
    return none_.wait_until(lock, deadline, [this] { return requests_ == 0; });
  }

 private:
  void add_connection(int count) { connections_ += count; }
  void add_request(int count) {
    const std::lock_guard lock(mutex_);
    requests_ += count;
    if (requests_ == 0) none_.notify_all();
  }

  std::atomic<int> connections_ = 0;
  mutable std::mutex mutex_;
  std::condition_variable none_;
  int requests_ = 0;
};

}  // namespace subdivd::server

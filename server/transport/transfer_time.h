#pragma once
// How long a body or an answer may be on its way, when its client decides how fast it goes.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace subdivd::server {

using Clock = std::chrono::steady_clock;

// How many requests have waited for a thread so long that slow transfers should make room for them. One asks,
// many claim: no more transfers end than requests wait. The thread of one that ends takes a while to come free, and the
// request still waits when it is asked for again: those on their way count.
class ThreadDemand {
 public:
  // Of all requests that wait.
  void ask(std::size_t threads) {
    const std::size_t leaving = leaving_.load();
    wanted_.store(threads - std::min(threads, leaving));
  }
  // True: the transfer that asks is to end.
  bool claim() {
    ++leaving_;
    if (lower(wanted_)) return true;
    lower(leaving_);
    return false;
  }
  // A thread looks for its next request.
  void came_free() { lower(leaving_); }

 private:
  // False when it is 0.
  static bool lower(std::atomic<std::size_t>& number) {
    std::size_t now = number.load();
    while (now > 0)
      if (number.compare_exchange_weak(now, now - 1)) return true;
    return false;
  }

  std::atomic<std::size_t> wanted_ = 0, leaving_ = 0;
};

// A grace period, and one second more for every MiB that has moved. A client that drips a byte a second, to
// hold a thread and a buffer, is cut at the end of the grace period; an honest one on a slow line is not.
//
// While others wait for the thread, less is enough to be cut: a second, and one more for every 64 KiB, but
// never more than three from the last byte, for the kernel takes megabytes of an answer that nobody reads.
class TransferTime {
 public:
  static constexpr std::chrono::milliseconds kGraceWhenAsked{1000};
  static constexpr std::chrono::microseconds kPerByteWhenAsked{16};
  static constexpr std::chrono::milliseconds kMostWhenAsked{3000};

  // `demand` must outlive the transfer.
  TransferTime(std::chrono::milliseconds grace, ThreadDemand& demand)
      : demand_(&demand), deadline_(Clock::now() + grace), asked_deadline_(Clock::now() + kGraceWhenAsked) {}

  void moved(std::size_t bytes) {
    deadline_ += std::chrono::microseconds(bytes);
    asked_deadline_ = std::min(asked_deadline_ + kPerByteWhenAsked * static_cast<std::int64_t>(bytes),
                               Clock::now() + kMostWhenAsked);
  }
  // May the client be waited for any longer? Ask again at next_look(), at the latest.
  bool is_over() {
    const Clock::time_point now = Clock::now();
    gave_way_ = gave_way_ || (now >= asked_deadline_ && demand_->claim());
    return gave_way_ || now >= deadline_;
  }
  Clock::time_point next_look() const { return std::min(deadline_, Clock::now() + kSlice); }
  // It ended for the sake of others, and not because it took longer than any may.
  bool gave_way() const { return gave_way_; }

 private:
  static constexpr std::chrono::milliseconds kSlice{100};

  ThreadDemand* demand_;
  Clock::time_point deadline_, asked_deadline_;
  bool gave_way_ = false;
};

}  // namespace subdivd::server

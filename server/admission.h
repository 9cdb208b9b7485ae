#pragma once
// How many requests are computed at once: as many as there are processors; a few more wait, first come first
// served; the rest is turned away, because an answer that comes too late costs as much as one in time.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <utility>
#include <variant>

namespace subdivd::server {

class Admission {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Denied { full, too_late, cancelled };

  Admission(std::size_t max_concurrent, std::size_t max_waiting)
      : max_concurrent_(max_concurrent), max_waiting_(max_waiting) {}
  Admission(const Admission&) = delete;
  Admission& operator=(const Admission&) = delete;

  // The right to compute, until destruction.
  class Ticket {
   public:
    explicit Ticket(Admission& gate) : gate_(&gate) {}
    Ticket(Ticket&& other) noexcept : gate_(std::exchange(other.gate_, nullptr)) {}
    Ticket& operator=(Ticket&&) = delete;
    ~Ticket() {
      if (gate_ != nullptr) gate_->leave();
    }

   private:
    Admission* gate_;
  };

  // Waits for a ticket until `deadline`, or until `cancelled` (may be null) turns true.
  std::variant<Ticket, Denied> enter(Clock::time_point deadline, const std::atomic<bool>* cancelled);

 private:
  void leave();

  const std::size_t max_concurrent_, max_waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::uint64_t> waiting_;  // numbers drawn by those who wait, the longest waiting first
  std::uint64_t next_number_ = 0;
  std::size_t running_ = 0;
};

}  // namespace subdivd::server

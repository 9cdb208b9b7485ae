#pragma once
// Those who wait for something that all share: the first to come is the first to have it.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>

namespace subdivd::server {

// What is waited for is guarded by a mutex of its owner's, who holds it at every call but changed().
class WaitingLine {
 public:
  using Clock = std::chrono::steady_clock;
  enum class End { turn, too_late, cancelled };

  bool empty() const { return numbers_.empty(); }
  std::size_t size() const { return numbers_.size(); }

  // Waits until everyone who came before has gone and `is_there()`, but no longer than `deadline` or until
  // `cancelled` (may be null) turns true. `lock` is let go meanwhile. At `turn` take what is there before the
  // lock is let go again. Throws, before it waits, when memory is out.
  template <class IsThere>
  End wait(std::unique_lock<std::mutex>& lock, Clock::time_point deadline, const std::atomic<bool>* cancelled,
           IsThere&& is_there) {
    const std::uint64_t number = next_number_++;
    numbers_.push_back(number);
    const auto my_turn = [&] { return numbers_.front() == number && is_there(); };
    End end = End::turn;
    while (end == End::turn && !my_turn()) {
      changed_.wait_until(lock, std::min(deadline, Clock::now() + kSlice), my_turn);
      if (cancelled != nullptr && *cancelled)
        end = End::cancelled;
      else if (Clock::now() >= deadline && !my_turn())
        end = End::too_late;
    }
    numbers_.erase(std::find(numbers_.begin(), numbers_.end(), number));
    changed_.notify_all();  // the next in line may find enough
    return end;
  }
  // Something has been given back.
  void changed() { changed_.notify_all(); }

 private:
  // How soon one who waits notices that it is cancelled, or that the passing of time has brought something.
  static constexpr std::chrono::milliseconds kSlice{50};

  std::condition_variable changed_;
  std::deque<std::uint64_t> numbers_;  // the longest waiting first
  std::uint64_t next_number_ = 0;
};

}  // namespace subdivd::server

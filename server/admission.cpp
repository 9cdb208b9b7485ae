#include "server/admission.h"

#include <algorithm>
#include <optional>

namespace subdivd::server {
namespace {

constexpr std::chrono::milliseconds kSlice{50};  // how soon a waiting request notices that it is cancelled

}  // namespace

std::variant<Admission::Ticket, Admission::Denied> Admission::enter(Clock::time_point deadline,
                                                                    const std::atomic<bool>* cancelled) {
  std::unique_lock lock(mutex_);
  if (running_ < max_concurrent_ && waiting_.empty()) {
    ++running_;
    return Ticket(*this);
  }
  if (waiting_.size() >= max_waiting_) return Denied::full;
  const std::uint64_t number = next_number_++;
  waiting_.push_back(number);
  const auto my_turn = [&] { return running_ < max_concurrent_ && waiting_.front() == number; };
  std::optional<Denied> denied;
  while (!denied && !my_turn()) {
    changed_.wait_until(lock, std::min(deadline, Clock::now() + kSlice), my_turn);
    if (cancelled != nullptr && *cancelled)
      denied = Denied::cancelled;
    else if (Clock::now() >= deadline)
      denied = Denied::too_late;
  }
  waiting_.erase(std::find(waiting_.begin(), waiting_.end(), number));
  changed_.notify_all();
  if (denied) return *denied;
  ++running_;
  return Ticket(*this);
}

void Admission::leave() {
  {
    const std::lock_guard lock(mutex_);
    --running_;
  }
  changed_.notify_all();
}

}  // namespace subdivd::server

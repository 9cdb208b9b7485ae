#include "server/grants.h"

#include <algorithm>
#include <string>

namespace subdivd::server {
namespace {

// A small request that has run for longer does not keep the next one waiting any more: a few bytes can ask
// for seconds of work. So many may run at once in the end.
constexpr std::chrono::milliseconds kOverdue{200};
constexpr std::size_t kMostSmall = 16;

// The small lane has an eighth of the memory, but not more than it can use.
constexpr Count kSmallShare = 8, kMostSmallBytes = Count{16} << 20;

}  // namespace

Grants::Grants(const Shares& shares) : max_waiting_(shares.max_waiting) {
  small_.bytes = std::min(shares.bytes / kSmallShare, kMostSmall * kMostSmallBytes);
  large_.bytes = shares.bytes - small_.bytes;
  most_small_bytes_ = std::min(small_.bytes / std::max<Count>(shares.small_places, 1), kMostSmallBytes);
  small_.free_bytes = small_.bytes;
  large_.free_bytes = large_.bytes;
  small_.places = shares.small_places;
  large_.places = shares.places;
}

bool Grants::has_place(Lane lane, Clock::time_point now) const {
  if (lane == Lane::large) return large_.running.size() < large_.places;
  if (small_.running.size() >= std::max(kMostSmall, small_.places)) return false;
  const auto in_time = std::count_if(small_.running.begin(), small_.running.end(),
                                     [&](const Grant* grant) { return now - grant->began_ < kOverdue; });
  return static_cast<std::size_t>(in_time) < small_.places;
}

std::variant<std::shared_ptr<Grants::Grant>, Grants::Denied> Grants::enter(
    const Wish& wish, Clock::time_point deadline, const std::atomic<bool>* cancelled) {
  const Lane lane = wish.lane == Lane::small && wish.bytes <= most_small_bytes_ ? Lane::small : Lane::large;
  // Made before the lock and before anything is taken: its destructor locks, and gives back what it has.
  std::shared_ptr<Grant> grant(new Grant(*this, lane));
  std::unique_lock lock(mutex_);
  Pool& pool = this->pool(lane);
  if (wish.bytes > pool.bytes) return Denied::too_large;
  const auto fits = [&] { return wish.bytes <= pool.free_bytes && has_place(lane, Clock::now()); };
  if (!pool.waiting.empty() || !fits()) {
    // One that comes again has waited before, and has been computed in part.
    if (wish.bytes == 0 && pool.waiting.size() >= max_waiting_) return Denied::full;
    const WaitingLine::End end = pool.waiting.wait(lock, deadline, cancelled, fits);
    if (end == WaitingLine::End::cancelled) return Denied::cancelled;
    if (end == WaitingLine::End::too_late) return Denied::too_late;
  }
  pool.running.push_back(grant.get());
  grant->has_place_ = true;
  grant->began_ = Clock::now();
  grant->bytes_ = wish.bytes;
  pool.free_bytes -= wish.bytes;
  ++granted_;
  return grant;
}

void Grants::leave_place(Grant& grant) {
  if (!grant.has_place_) return;
  grant.has_place_ = false;
  std::deque<const Grant*>& running = pool(grant.lane_).running;
  running.erase(std::find(running.begin(), running.end(), &grant));
}

Grants::Grant::~Grant() { keep_only(0); }

void Grants::Grant::keep_only(Count bytes) {
  {
    const std::lock_guard lock(grants_.mutex_);
    grants_.leave_place(*this);
    if (bytes < bytes_) {
      grants_.pool(lane_).free_bytes += bytes_ - bytes;
      bytes_ = bytes;
    }
    // A reader's slowness must not keep those waiting who come with small requests.
    if (lane_ == Lane::small && bytes_ <= grants_.large_.free_bytes) {
      grants_.small_.free_bytes += bytes_;
      grants_.large_.free_bytes -= bytes_;
      lane_ = Lane::large;
    }
  }
  for (Pool* pool : {&grants_.small_, &grants_.large_}) pool->waiting.changed();
}

Result<void> Grants::Grant::take(Count bytes) {
  const std::lock_guard lock(grants_.mutex_);
  Pool& pool = grants_.pool(lane_);
  const Count most = grants_.large_.bytes;
  if (bytes > most - std::min(most, asked_))
    return Error{.code = ErrorCode::too_large,
                 .message = "the request would take " + std::to_string(asked_ + bytes) +
                            " bytes of memory; " + std::to_string(most) +
                            " are set aside: choose a lower level or a smaller input",
                 .predicted = asked_ + bytes,
                 .allowed = most};
  const Count asked = asked_ + bytes;
  wanted_ = asked;
  const Count missing = asked - std::min(asked, bytes_);
  const bool allowed = lane_ == Lane::large || asked <= grants_.most_small_bytes_;
  if (!allowed || missing > pool.free_bytes)
    return Error{ErrorCode::overloaded, "other requests take the memory that this one needs"};
  pool.free_bytes -= missing;
  bytes_ += missing;
  asked_ = asked;
  return {};
}

Grants::Wish Grants::Grant::wish() const {
  const std::lock_guard lock(grants_.mutex_);
  return {wanted_ > grants_.most_small_bytes_ ? Lane::large : lane_, wanted_};
}

std::size_t Grants::running() const {
  const std::lock_guard lock(mutex_);
  return small_.running.size() + large_.running.size();
}

Grants::State Grants::state() const {
  const std::lock_guard lock(mutex_);
  State state;
  state.granted = granted_;
  state.bytes = small_.bytes + large_.bytes;
  state.free_bytes = small_.free_bytes + large_.free_bytes;
  state.places = small_.places + large_.places;
  const std::size_t running = small_.running.size() + large_.running.size();
  state.free_places = state.places - std::min(state.places, running);
  state.waiting = small_.waiting.size() + large_.waiting.size();
  return state;
}

}  // namespace subdivd::server

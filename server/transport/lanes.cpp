#include "server/transport/lanes.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace subdivd::server {
namespace {

// With heads of their own free kilobyte each these take a megabyte; longer heads are paid for.
constexpr std::size_t kMostWaiting = 1024;
// Threads come free all the time: only after that nobody is expected to make room by himself.
constexpr std::chrono::milliseconds kOwnPatience{100};

void refuse(Connection& connection) {
  connection.refuse(overloaded("no thread was free for this request in time"));
}

}  // namespace

Lane Lanes::lane_of(Connection& connection) {
  const Turn& turn = connection.turn();
  if (turn.refusal) return Lane::health;
  if (turn.wants_body()) return Lane::general;
  try {
    return service_.lane(turn.request);
  } catch (...) {
    return Lane::general;
  }
}

void Lanes::push(Connections one) {
  Connection& connection = *one.front();
  Lane lane = lane_of(connection);
  connection.queued = Clock::now();
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  if (lane == Lane::general && queue(lane).waiting.size() >= kMostWaiting) {
    refuse(connection);
    lane = Lane::health;
  }
  Queue& taken = queue(lane);
  taken.waiting.splice(taken.waiting.end(), one);
  taken.ready.notify_one();
}

Connections Lanes::pop(Lane lane) {
  Connections one;
  demand_.came_free();
  std::unique_lock lock(mutex_);
  Queue& from = queue(lane);
  ++from.spare_threads;
  from.ready.wait(lock, [&] { return closed_ || !from.waiting.empty(); });
  --from.spare_threads;
  if (!from.waiting.empty()) one.splice(one.end(), from.waiting, from.waiting.begin());
  if (lane == Lane::general && from.waiting.empty()) demand_.ask(0);
  return one;
}

bool Lanes::look_after_waiting() {
  const Clock::time_point now = Clock::now();
  const std::lock_guard lock(mutex_);
  Connections& general = queue(Lane::general).waiting;
  Queue& health = queue(Lane::health);
  while (!general.empty() && general.front()->queued < now - patience_) {
    refuse(*general.front());
    health.waiting.splice(health.waiting.end(), general, general.begin());
    health.ready.notify_one();
  }
  const auto has_just_come = [&](const auto& one) { return one->queued > now - kOwnPatience; };
  demand_.ask(static_cast<std::size_t>(
      std::distance(general.begin(), std::find_if(general.begin(), general.end(), has_just_come))));
  return !general.empty();
}

bool Lanes::others_wait(Lane lane) const {
  const std::lock_guard lock(mutex_);
  return !queue(lane).waiting.empty();
}

bool Lanes::has_spare_thread(Lane lane) const {
  const std::lock_guard lock(mutex_);
  return queue(lane).spare_threads > queue(lane).waiting.size();
}

std::size_t Lanes::waiting() const {
  const std::lock_guard lock(mutex_);
  return queues_[0].waiting.size() + queues_[1].waiting.size();
}

void Lanes::close() {
  Connections dropped;  // ends outside the lock
  const std::lock_guard lock(mutex_);
  closed_ = true;
  for (Queue& each : queues_) {
    dropped.splice(dropped.end(), each.waiting);
    each.ready.notify_all();
  }
}

}  // namespace subdivd::server

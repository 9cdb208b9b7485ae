#include "server/transport/watcher.h"

#include <poll.h>
#include <sys/socket.h>

#include <chrono>
#include <vector>

namespace subdivd::server {
namespace {

constexpr std::chrono::milliseconds kInterval{50};

}  // namespace

Watcher::Watcher() : thread_([this] { run(); }) {}

Watcher::~Watcher() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

Watcher::Entry::Entry(Watcher& watcher, int fd) : watcher_(watcher), fd_(fd) {
  const std::lock_guard lock(watcher_.mutex_);
  place_ = watcher_.entries_.insert(watcher_.entries_.end(), this);
  if (watcher_.cut_) cut();
}

Watcher::Entry::~Entry() {
  watch(false);
  const std::lock_guard lock(watcher_.mutex_);
  watcher_.entries_.erase(place_);
}

void Watcher::Entry::watch(bool on) {
  {
    const std::lock_guard lock(watcher_.mutex_);
    if (watched_ == on) return;
    watched_ = on;
    watcher_.watched_count_ += on ? 1 : -1;
  }
  if (on) watcher_.changed_.notify_one();
}

void Watcher::Entry::cut() {
  cancelled_ = true;
  ::shutdown(fd_, SHUT_RDWR);
}

void Watcher::cut_all() {
  const std::lock_guard lock(mutex_);
  cut_ = true;
  for (Entry* entry : entries_) entry->cut();
}

void Watcher::run() {
  std::unique_lock lock(mutex_);
  while (!ended_) {
    if (watched_count_ == 0) {
      changed_.wait(lock);
    } else {
      look();
      changed_.wait_for(lock, kInterval, [this] { return ended_; });
    }
  }
}

// The mutex is held, so no descriptor in the list can be closed, and perhaps given to another connection,
// meanwhile.
void Watcher::look() {
  std::vector<pollfd> polled;
  std::vector<Entry*> asked;
  for (Entry* entry : entries_) {
    if (!entry->watched_) continue;
    polled.push_back({entry->fd_, POLLRDHUP, 0});
    asked.push_back(entry);
  }
  if (::poll(polled.data(), polled.size(), 0) <= 0) return;
  for (std::size_t i = 0; i < polled.size(); ++i)
    if (polled[i].revents != 0) asked[i]->cancelled_ = true;
}

}  // namespace subdivd::server

#include "server/transport/watcher.h"

#include <sys/socket.h>

#include <string_view>

namespace subdivd::server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kInterval{25};
// Most requests are answered before anyone has to ask whether their clients still wait.
constexpr std::chrono::milliseconds kProbeAfter{50}, kProbeAgain{1000};
constexpr std::string_view kProbe = "HTTP/1.1 100 Continue\r\n\r\n";

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

Watcher::Post::Post(Watcher& watcher) : watcher_(watcher) {
  const std::lock_guard lock(watcher_.mutex_);
  watcher_.polled_.reserve(watcher_.posts_.size() + 1);
  watcher_.asked_.reserve(watcher_.posts_.size() + 1);
  place_ = watcher_.posts_.insert(watcher_.posts_.end(), this);
}

Watcher::Post::~Post() {
  const std::lock_guard lock(watcher_.mutex_);
  watcher_.posts_.erase(place_);
}

void Watcher::Post::attach(int fd) {
  const std::lock_guard lock(watcher_.mutex_);
  fd_ = fd;
  cancelled_ = false;
  if (watcher_.cut_) cut();
}

void Watcher::Post::detach() {
  const std::lock_guard lock(watcher_.mutex_);
  fd_ = -1;
}

void Watcher::Post::watch(bool may_probe) {
  const std::lock_guard lock(watcher_.mutex_);
  watched_ = true;
  may_probe_ = may_probe;
  since_ = Clock::now();
  ++watcher_.watched_count_;
  if (!watcher_.asleep_) return;
  watcher_.asleep_ = false;
  watcher_.changed_.notify_one();
}

void Watcher::Post::unwatch() {
  const std::lock_guard lock(watcher_.mutex_);
  watched_ = false;
  --watcher_.watched_count_;
}

void Watcher::Post::cut() {
  cancelled_ = true;
  ::shutdown(fd_, SHUT_RDWR);
}

void Watcher::cut_all() {
  const std::lock_guard lock(mutex_);
  cut_ = true;
  for (Post* post : posts_)
    if (post->fd_ >= 0) post->cut();
}

void Watcher::run() {
  std::unique_lock lock(mutex_);
  while (!ended_) {
    if (watched_count_ == 0) {
      asleep_ = true;
      changed_.wait(lock, [this] { return ended_ || !asleep_; });
    }
    changed_.wait_for(lock, kInterval, [this] { return ended_; });
    look();
  }
}

// The mutex is held, so no descriptor in the list can be closed, and perhaps given to another connection,
// meanwhile.
void Watcher::look() {
  polled_.clear();
  asked_.clear();
  for (Post* post : posts_) {
    if (!post->watched_ || post->cancelled_) continue;
    polled_.push_back({post->fd_, POLLRDHUP, 0});
    asked_.push_back(post);
  }
  if (polled_.empty() || ::poll(polled_.data(), polled_.size(), 0) <= 0) return;
  for (std::size_t i = 0; i < polled_.size(); ++i) {
    if ((polled_[i].revents & (POLLERR | POLLHUP | POLLNVAL)) != 0)
      asked_[i]->cancelled_ = true;
    else if (polled_[i].revents != 0)
      probe(*asked_[i]);
  }
}

void Watcher::probe(Post& post) {
  if (!post.may_probe_ || Clock::now() - post.since_ < kProbeAfter) return;
  const ssize_t sent = ::send(post.fd_, kProbe.data(), kProbe.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  if (sent < 0) return;  // no room for it now, or a reset that the next look will see
  post.since_ = Clock::now() + kProbeAgain - kProbeAfter;  // one that has half-closed may still leave
  // A part of it would spoil the answer. That takes a client which has ended its side and leaves a full
  // buffer of earlier answers unread.
  if (static_cast<std::size_t>(sent) < kProbe.size()) post.cut();
}

}  // namespace subdivd::server

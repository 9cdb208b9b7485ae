#include "server/transport/reception.h"

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <new>
#include <utility>

namespace subdivd::server {
namespace {

constexpr std::array kPhases = {Connection::Phase::silent, Connection::Phase::head, Connection::Phase::idle,
                                Connection::Phase::lingering};
constexpr std::size_t kEvents = 256;
constexpr int kAcceptedAtOnce = 64;  // then those that are already here have their turn
constexpr std::chrono::milliseconds kLingerTime{1000};
// A head under way gives place to others only after this time: most need one packet.
constexpr std::chrono::milliseconds kHeadsOwnTime{1000};
constexpr std::chrono::milliseconds kFullRetry{10};
constexpr std::chrono::milliseconds kQueueTick{100};
// Workers queue requests, too, and those that have waited too long are refused from here.
constexpr std::chrono::milliseconds kLongestSleep{1000};
// Of a head that has begun when the daemon is to end.
constexpr std::chrono::milliseconds kDrainingHead{1000};

}  // namespace

Result<void> Reception::start(const std::string& host, int port, const Limits& limits) {
  auto listener = Listener::open(host, port);
  if (!listener) return std::move(listener).error();
  listener_ = std::move(listener).value();
  limits_ = limits;
  epoll_ = ::epoll_create1(EPOLL_CLOEXEC);
  wake_ = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  epoll_event for_wake{EPOLLIN, {.ptr = &wake_}}, for_listener{EPOLLIN, {.ptr = &listener_}};
  if (epoll_ < 0 || wake_ < 0 || ::epoll_ctl(epoll_, EPOLL_CTL_ADD, wake_, &for_wake) != 0 ||
      ::epoll_ctl(epoll_, EPOLL_CTL_ADD, listener_->fd(), &for_listener) != 0)
    return Error{ErrorCode::internal, "cannot wait for connections: " + std::string(std::strerror(errno))};
  listening_ = true;
  thread_ = std::thread([this] { run(); });
  return {};
}

void Reception::stop() {
  Connections closed;
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  if (thread_.joinable()) {
    wake();
    thread_.join();
  }
  for (const int fd : {std::exchange(epoll_, -1), std::exchange(wake_, -1)})
    if (fd >= 0) ::close(fd);
  listener_.reset();
  const std::lock_guard lock(mutex_);
  for (Connections& each : lists_) closed.splice(closed.end(), each);
}

void Reception::begin_drain() {
  draining_ = true;
  wake();
}

void Reception::wake() const {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(wake_, &one, sizeof one);
}

Reception::Counts Reception::counts() const {
  const std::lock_guard lock(mutex_);
  return {list(Phase::silent).size(), list(Phase::head).size(), list(Phase::idle).size(),
          list(Phase::lingering).size()};
}

std::chrono::milliseconds Reception::patience(Phase phase) const {
  switch (phase) {
    case Phase::silent:
      return limits_.silence;
    case Phase::head:
      return draining_ ? std::min(limits_.head, kDrainingHead) : limits_.head;
    case Phase::idle:
      return limits_.idle;
    default:
      return kLingerTime;
  }
}

// ---- the lists ----

void Reception::await_request(Connections one, bool head_begun) {
  if (!head_begun) one.front()->socket().trim_buffer();
  add(std::move(one), head_begun ? Phase::head : Phase::idle);
}

void Reception::await_end(Connections one) {
  one.front()->socket().end_sending();
  add(std::move(one), Phase::lingering);
}

void Reception::add(Connections one, Phase phase) {
  Connection& connection = *one.front();
  Connections closed;  // ends outside the lock
  const std::lock_guard lock(mutex_);
  if (stopped_) {
    closed.splice(closed.end(), one);
    return;
  }
  connection.place.phase = phase;
  connection.place.since = Clock::now();
  connection.place.at = one.begin();
  list(phase).splice(list(phase).end(), one);
  if (!arm(connection)) {
    closed.splice(closed.end(), list(phase), connection.place.at);
    return;
  }
  const bool leaves = draining_ && phase == Phase::idle;
  if (leaves || connection.place.since + patience(phase) < sleeps_until_) wake();
}

// One event, then the connection is nobody's but ours until it is armed again.
bool Reception::arm(Connection& connection) {
  epoll_event event{EPOLLIN | EPOLLRDHUP | EPOLLONESHOT, {.ptr = &connection}};
  const int what = connection.place.registered ? EPOLL_CTL_MOD : EPOLL_CTL_ADD;
  connection.place.registered = true;
  return ::epoll_ctl(epoll_, what, connection.socket().fd(), &event) == 0;
}

void Reception::move(Connection& connection, Phase phase) {
  const std::lock_guard lock(mutex_);
  list(phase).splice(list(phase).end(), list(connection.place.phase), connection.place.at);
  connection.place.phase = phase;
  connection.place.since = Clock::now();
}

// Of a connection that is armed: from here on no event comes.
void Reception::disarm(Connection& connection) {
  connection.place.registered = false;
  ::epoll_ctl(epoll_, EPOLL_CTL_DEL, connection.socket().fd(), nullptr);
}

Connections Reception::take(Connection& connection) {
  Connections one;
  const std::lock_guard lock(mutex_);
  one.splice(one.end(), list(connection.place.phase), connection.place.at);
  return one;
}

Connection* Reception::front(Phase phase) const {
  const std::lock_guard lock(mutex_);
  return list(phase).empty() ? nullptr : list(phase).front().get();
}

// ---- the thread ----

void Reception::run() {
  std::array<epoll_event, kEvents> events{};
  for (;;) {
    const int wait = milliseconds_to_wait();
    if (wait < 0) return;
    const int count = ::epoll_wait(epoll_, events.data(), kEvents, wait);
    // Whoever armed a connection has the lock, so all it did before is seen from here on.
    { const std::lock_guard lock(mutex_); }
    bool someone_knocks = !listening_;
    for (int i = 0; i < count; ++i) {
      void* const source = events[static_cast<std::size_t>(i)].data.ptr;
      if (source == &listener_) {
        someone_knocks = true;
      } else if (source == &wake_) {
        std::uint64_t times = 0;
        [[maybe_unused]] const ssize_t got = ::read(wake_, &times, sizeof times);
      } else {
        attend(*static_cast<Connection*>(source));
      }
    }
    // Only now may connections be closed that are not the event's own: none of the events is theirs any more.
    if (someone_knocks) accept_some();
    close_overdue();
    if (draining_) close_idle();
  }
}

// Until something is overdue; -1: stopped.
int Reception::milliseconds_to_wait() {
  const bool queued = lanes_.look_after_waiting();
  const Clock::time_point now = Clock::now();
  const std::lock_guard lock(mutex_);
  if (stopped_) return -1;
  sleeps_until_ = now + kLongestSleep;
  if (queued) sleeps_until_ = now + kQueueTick;
  if (!listening_) sleeps_until_ = std::min(sleeps_until_, now + kFullRetry);
  for (const Phase phase : kPhases)
    if (!list(phase).empty())
      sleeps_until_ = std::min(sleeps_until_, list(phase).front()->place.since + patience(phase));
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(sleeps_until_ - now).count();
  return static_cast<int>(std::max<long long>(left, 0));
}

// What the connection has sent; out of memory counts as the end of it.
Connection::Progress Reception::read_head(Connection& connection) {
  try {
    return connection.read_head();
  } catch (const std::bad_alloc&) {
    connection.socket().write_now(kBareOverloaded);
    return Connection::Progress::closed;
  }
}

void Reception::attend(Connection& connection) {
  if (connection.place.phase == Phase::lingering) {
    if (connection.socket().discard_now() == ClientSocket::Outcome::closed || !arm(connection))
      take(connection);
    return;
  }
  const Connection::Progress progress = read_head(connection);
  if (progress == Connection::Progress::complete) {
    lanes_.push(take(connection));
    return;
  }
  if (progress == Connection::Progress::begun && connection.place.phase != Phase::head)
    move(connection, Phase::head);
  if (progress == Connection::Progress::closed || !arm(connection)) take(connection);
}

// The last look at a connection that should go: a request that has come meanwhile is taken on. True when the
// connection was closed.
bool Reception::end_waiting(Connection& connection) {
  if (connection.place.phase == Phase::lingering) {
    take(connection);
    return true;
  }
  const Connection::Progress progress = read_head(connection);
  if (progress == Connection::Progress::complete) {
    disarm(connection);
    lanes_.push(take(connection));
    return false;
  }
  if (progress == Connection::Progress::begun && connection.place.phase != Phase::head) {
    move(connection, Phase::head);
    return false;
  }
  take(connection);
  return true;
}

void Reception::close_overdue() {
  const Clock::time_point now = Clock::now();
  for (const Phase phase : kPhases) {
    for (Connection* first = front(phase); first != nullptr && first->place.since + patience(phase) <= now;
         first = front(phase)) {
      if (phase != Phase::head) {
        end_waiting(*first);
        continue;
      }
      end_head(*first);
    }
  }
}

// A head that has not come in time is refused.
void Reception::end_head(Connection& connection) {
  const Connection::Progress progress = read_head(connection);
  disarm(connection);
  Connections one = take(connection);
  if (progress == Connection::Progress::closed) return;
  try {
    if (progress == Connection::Progress::begun)
      connection.refuse({408, "request_timeout", "the head of the request did not arrive in time"});
    lanes_.push(std::move(one));
  } catch (const std::bad_alloc&) {  // then it ends without a word
  }
}

void Reception::close_idle() {
  while (Connection* first = front(Phase::idle)) end_waiting(*first);
}

// ---- new connections ----

void Reception::listen(bool on) {
  if (listening_ == on) return;
  epoll_event event{on ? static_cast<std::uint32_t>(EPOLLIN) : 0u, {.ptr = &listener_}};
  if (::epoll_ctl(epoll_, EPOLL_CTL_MOD, listener_->fd(), &event) == 0) listening_ = on;
}

void Reception::accept_some() {
  for (int i = 0; i < kAcceptedAtOnce; ++i) {
    if (census_.connections() >= limits_.connections) {
      if (!listener_->someone_waits()) break;
      if (!make_room()) return listen(false);
    }
    const int fd = listener_->accept_now();
    if (fd == Listener::kNone) break;
    if (fd >= 0)
      admit(fd);
    else if (!make_room())
      return listen(false);
  }
  listen(true);
}

void Reception::admit(int fd) {
  Connections one;
  try {
    one.emplace_back();
    one.front() = std::make_unique<Connection>(fd, memory_, census_);
  } catch (const std::bad_alloc&) {
    ::close(fd);
    return;
  }
  Connection& connection = *one.front();
  {
    const std::lock_guard lock(mutex_);
    connection.place.since = Clock::now();
    connection.place.at = one.begin();
    list(Phase::silent).splice(list(Phase::silent).end(), one);
  }
  attend(connection);  // the request has often come along with the connection
}

// Closes one connection for the sake of a new one: the one that has waited longest, those first that lose
// nothing by it. False when nobody can go.
bool Reception::make_room() {
  for (const Phase phase : {Phase::lingering, Phase::silent, Phase::idle})
    while (Connection* first = front(phase))
      if (end_waiting(*first)) return true;
  Connection* first = front(Phase::head);
  if (first == nullptr || Clock::now() - first->place.since < kHeadsOwnTime) return false;
  first->socket().write_now(kBareOverloaded);
  take(*first);
  return true;
}

}  // namespace subdivd::server

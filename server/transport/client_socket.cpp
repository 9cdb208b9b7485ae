#include "server/transport/client_socket.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace subdivd::server {
namespace {

constexpr std::chrono::milliseconds kSlice{50};
constexpr std::chrono::milliseconds kLingerTime{1000};
constexpr std::size_t kReadBytes = 64 * 1024;

int milliseconds_until(Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
  return static_cast<int>(std::clamp<long long>(left, 0, 60'000));
}

}  // namespace

ClientSocket::~ClientSocket() { ::close(fd_); }

std::string ClientSocket::peer() const {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  std::array<char, NI_MAXHOST> host{};
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  if (::getpeername(fd_, generic, &length) != 0) return {};
  if (::getnameinfo(generic, length, host.data(), host.size(), nullptr, 0, NI_NUMERICHOST) != 0) return {};
  return host.data();
}

void ClientSocket::consume(std::size_t bytes) {
  consumed_ += bytes;
  if (consumed_ < buffer_.size()) return;
  buffer_.clear();
  consumed_ = 0;
}

ClientSocket::Outcome ClientSocket::wait_for(short event, Clock::time_point deadline) {
  for (;;) {
    pollfd entry{fd_, event, 0};
    const int ready = ::poll(&entry, 1, milliseconds_until(deadline));
    if (ready > 0) return Outcome::ready;  // an error or a hang-up shows in the call that follows
    if (ready < 0 && errno != EINTR) return Outcome::closed;
    if (Clock::now() >= deadline) return Outcome::timed_out;
  }
}

ClientSocket::Outcome ClientSocket::wait(Clock::time_point deadline, const std::function<bool()>& give_up) {
  while (buffered().empty()) {
    const Outcome outcome = wait_for(POLLIN, std::min(deadline, Clock::now() + kSlice));
    if (outcome == Outcome::ready) return fill(deadline);
    if (outcome == Outcome::closed) return outcome;
    if (give_up()) return Outcome::given_up;
    if (Clock::now() >= deadline) return Outcome::timed_out;
  }
  return Outcome::ready;
}

ClientSocket::Outcome ClientSocket::receive(char* to, std::size_t size, Clock::time_point deadline,
                                            std::size_t& received) {
  for (;;) {
    const ssize_t got = ::recv(fd_, to, size, 0);
    if (got > 0) {
      received = static_cast<std::size_t>(got);
      return Outcome::ready;
    }
    if (got == 0) return Outcome::closed;
    if (errno == EINTR) continue;
    if (errno != EAGAIN && errno != EWOULDBLOCK) return Outcome::closed;
    if (const Outcome outcome = wait_for(POLLIN, deadline); outcome != Outcome::ready) return outcome;
  }
}

ClientSocket::Outcome ClientSocket::fill(Clock::time_point deadline) {
  buffer_.erase(0, consumed_);
  consumed_ = 0;
  const std::size_t before = buffer_.size();
  buffer_.resize(before + kReadBytes);
  std::size_t received = 0;
  const Outcome outcome = receive(buffer_.data() + before, kReadBytes, deadline, received);
  buffer_.resize(before + received);
  return outcome;
}

std::size_t ClientSocket::read(char* to, std::size_t size, Clock::time_point deadline) {
  if (buffered().empty()) {
    std::size_t received = 0;
    if (size >= kReadBytes) return receive(to, size, deadline, received) == Outcome::ready ? received : 0;
    if (fill(deadline) != Outcome::ready) return 0;
  }
  const std::size_t count = std::min(size, buffered().size());
  buffered().copy(to, count);
  consume(count);
  return count;
}

bool ClientSocket::write(const char* data, std::size_t size, Pace& pace) {
  while (size > 0) {
    const ssize_t sent = ::send(fd_, data, size, MSG_NOSIGNAL);
    if (sent >= 0) {
      data += sent;
      size -= static_cast<std::size_t>(sent);
      pace.moved(static_cast<std::size_t>(sent));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (wait_for(POLLOUT, pace.deadline()) != Outcome::ready) return false;
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

void ClientSocket::linger() {
  ::shutdown(fd_, SHUT_WR);
  const Clock::time_point deadline = Clock::now() + kLingerTime;
  std::array<char, 16 * 1024> discarded{};
  std::size_t received = 0;
  while (Clock::now() < deadline &&
         receive(discarded.data(), discarded.size(), deadline, received) == Outcome::ready) {
  }
}

}  // namespace subdivd::server

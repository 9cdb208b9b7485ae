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

constexpr std::size_t kReadBytes = 32 * 1024;
constexpr std::size_t kDiscardBytes = 256 * 1024;

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

void ClientSocket::trim_buffer() {
  std::string(buffered()).swap(buffer_);
  consumed_ = 0;
}

ClientSocket::Outcome ClientSocket::wait_for(short event, Clock::time_point deadline) const {
  for (;;) {
    pollfd entry{fd_, event, 0};
    const int ready = ::poll(&entry, 1, milliseconds_until(deadline));
    if (ready > 0) return Outcome::ready;  // an error or a hang-up shows in the call that follows
    if (ready < 0 && errno != EINTR) return Outcome::closed;
    if (Clock::now() >= deadline) return Outcome::timed_out;
  }
}

ClientSocket::Outcome ClientSocket::wait_for(short event, TransferTime& time) const {
  while (!time.is_over())  // also where a byte comes now and then
    if (const Outcome outcome = wait_for(event, time.next_look()); outcome != Outcome::timed_out)
      return outcome;
  return Outcome::timed_out;
}

ClientSocket::Outcome ClientSocket::wait_readable(Clock::time_point deadline) const {
  return wait_for(POLLIN, deadline);
}

ClientSocket::Outcome ClientSocket::receive_now(char* to, std::size_t size, std::size_t& received) const {
  for (;;) {
    const ssize_t got = ::recv(fd_, to, size, 0);
    if (got > 0) {
      received = static_cast<std::size_t>(got);
      return Outcome::ready;
    }
    if (got == 0) return Outcome::closed;
    if (errno == EINTR) continue;
    return errno == EAGAIN || errno == EWOULDBLOCK ? Outcome::would_block : Outcome::closed;
  }
}

ClientSocket::Outcome ClientSocket::fill_now(std::size_t most) {
  char arrived[kReadBytes];  // so that the buffer is never larger than what came
  std::size_t received = 0;
  const Outcome outcome = receive_now(arrived, std::min(most, kReadBytes), received);
  if (outcome != Outcome::ready) return outcome;
  buffer_.erase(0, consumed_);
  consumed_ = 0;
  buffer_.append(arrived, received);
  return outcome;
}

ClientSocket::Outcome ClientSocket::fill(std::size_t most, TransferTime& time) {
  for (;;) {
    if (const Outcome outcome = fill_now(most); outcome != Outcome::would_block) return outcome;
    if (const Outcome outcome = wait_for(POLLIN, time); outcome != Outcome::ready) return outcome;
  }
}

std::size_t ClientSocket::read(char* to, std::size_t size, TransferTime& time) {
  if (!buffered().empty()) {
    const std::size_t count = buffered().copy(to, size);
    consume(count);
    return count;
  }
  for (;;) {
    std::size_t received = 0;
    const Outcome outcome = receive_now(to, size, received);
    if (outcome == Outcome::ready) return received;
    if (outcome != Outcome::would_block || wait_for(POLLIN, time) != Outcome::ready) return 0;
  }
}

bool ClientSocket::write(std::string_view data, TransferTime& time, bool more) {
  const int flags = MSG_NOSIGNAL | (more ? MSG_MORE : 0);
  while (!data.empty()) {
    const ssize_t sent = ::send(fd_, data.data(), data.size(), flags);
    if (sent >= 0) {
      data.remove_prefix(static_cast<std::size_t>(sent));
      time.moved(static_cast<std::size_t>(sent));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (wait_for(POLLOUT, time) != Outcome::ready) return false;
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

void ClientSocket::write_now(std::string_view data) const {
  [[maybe_unused]] const ssize_t sent = ::send(fd_, data.data(), data.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
}

bool ClientSocket::holds_unread() const {
  char byte = 0;
  return !buffered().empty() || ::recv(fd_, &byte, 1, MSG_PEEK | MSG_DONTWAIT) > 0;
}

void ClientSocket::end_sending() const { ::shutdown(fd_, SHUT_WR); }

ClientSocket::Outcome ClientSocket::discard_now() {
  std::string().swap(buffer_);
  consumed_ = 0;
  // With MSG_TRUNC the kernel drops the bytes instead of copying them.
  const ssize_t got = ::recv(fd_, nullptr, kDiscardBytes, MSG_TRUNC | MSG_DONTWAIT);
  if (got > 0) return Outcome::ready;
  return got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) ? Outcome::would_block
                                                                                : Outcome::closed;
}

}  // namespace subdivd::server

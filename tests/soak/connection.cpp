#include "tests/soak/connection.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <functional>
#include <thread>

namespace subdivd::soak {
namespace {

constexpr std::size_t kBeginning = 300;

std::string lowered(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

// The value of a field in a lower-cased head; empty when it is not there.
std::string_view field(std::string_view head, std::string_view name) {
  const std::string wanted = "\r\n" + std::string(name) + ": ";
  const std::size_t at = head.find(wanted);
  if (at == std::string_view::npos) return {};
  head.remove_prefix(at + wanted.size());
  return head.substr(0, head.find("\r\n"));
}

int status_of(std::string_view head) {
  const std::size_t blank = head.find(' ');
  return head.starts_with("http/1.1 ") ? std::atoi(std::string(head.substr(blank + 1, 3)).c_str()) : 0;
}

}  // namespace

Connection::Connection(int port, int receive_buffer) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<in_port_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (receive_buffer > 0) ::setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  const timeval patience{kPatience.count() / 1000, 0};
  ::setsockopt(fd_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  const int on = 1;
  ::setsockopt(fd_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  if (::connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) close();
}

void Connection::close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

void Connection::reset() {
  if (fd_ < 0) return;
  const linger hard{1, 0};
  ::setsockopt(fd_, SOL_SOCKET, SO_LINGER, &hard, sizeof hard);
  close();
}

void Connection::end_sending() {
  if (fd_ >= 0) ::shutdown(fd_, SHUT_WR);
}

bool Connection::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

bool Connection::send_slowly(std::string_view bytes, std::size_t piece, milliseconds pause) {
  while (!bytes.empty()) {
    if (!send(bytes.substr(0, piece))) return false;
    bytes.remove_prefix(std::min(piece, bytes.size()));
    std::this_thread::sleep_for(pause);
  }
  return true;
}

bool Connection::more(const ReadingPace& pace, Clock::time_point deadline) {
  const auto left = std::chrono::duration_cast<milliseconds>(deadline - Clock::now());
  if (fd_ < 0 || left.count() <= 0) return false;
  std::this_thread::sleep_for(pace.pause);
  pollfd entry{fd_, POLLIN, 0};
  if (::poll(&entry, 1, static_cast<int>(left.count())) <= 0) return false;
  const std::size_t had = buffer_.size();
  buffer_.resize(had + pace.piece);
  const ssize_t got = ::recv(fd_, buffer_.data() + had, pace.piece, 0);
  buffer_.resize(had + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  return got > 0;
}

Answer Connection::broken() {
  Answer answer;
  answer.beginning = buffer_.substr(0, kBeginning);
  close();
  return answer;
}

Answer Connection::receive(ReadingPace pace, milliseconds patience) {
  const Clock::time_point deadline = Clock::now() + patience;
  for (;;) {
    std::size_t end = 0;
    while ((end = buffer_.find("\r\n\r\n")) == std::string::npos)
      if (!more(pace, deadline)) return broken();
    const std::string head = lowered(std::string_view(buffer_).substr(0, end + 2));
    const std::size_t length = std::strtoull(std::string(field(head, "content-length")).c_str(), nullptr, 10);
    const std::size_t whole = end + 4 + length;
    while (buffer_.size() < whole)
      if (!more(pace, deadline)) return broken();
    const std::string_view body = std::string_view(buffer_).substr(end + 4, length);
    Answer answer;
    answer.status = status_of(head);
    answer.closes = field(head, "connection") == "close";
    answer.retry_after = !field(head, "retry-after").empty();
    answer.size = length;
    answer.digest = std::hash<std::string_view>{}(body);
    answer.beginning = body.substr(0, kBeginning);
    buffer_.erase(0, whole);
    if (answer.status / 100 != 1) return answer;
  }
}

}  // namespace subdivd::soak

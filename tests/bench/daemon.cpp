#include "tests/bench/daemon.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace subdivd::bench {
namespace {

constexpr int kPatienceMs = 30'000;
constexpr std::size_t kHeadRoom = 16384;  // for an answer's head

std::string first_line(int fd) {
  std::string line;
  char c = 0;
  pollfd entry{fd, POLLIN, 0};
  while (::poll(&entry, 1, kPatienceMs) > 0 && ::read(fd, &c, 1) == 1 && c != '\n') line += c;
  return line;
}

// The number after `field` in an answer's head; 0 when it is not there.
std::size_t number_after(std::string_view head, std::string_view field) {
  const auto found = std::ranges::search(head, field, [](char a, char b) { return (a | 32) == (b | 32); });
  return found.empty() ? 0 : std::strtoull(&*found.end(), nullptr, 10);
}

}  // namespace

Daemon::Daemon(const std::vector<std::string>& flags) {
  std::vector<const char*> words = {"subdivd", "--port", "0", "--log-level", "error"};
  for (const std::string& flag : flags) words.push_back(flag.c_str());
  words.push_back(nullptr);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return;
  pid_ = ::fork();
  if (pid_ == 0) {
    ::dup2(ends[1], STDOUT_FILENO);
    ::execv(SUBDIVD_BINARY_DIR "/subdivd", const_cast<char* const*>(words.data()));
    ::_exit(127);
  }
  ::close(ends[1]);
  out_ = ends[0];
  const std::string line = first_line(out_);
  port_ = std::atoi(line.c_str() + line.rfind(':') + 1);
}

Daemon::~Daemon() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  if (out_ >= 0) ::close(out_);
}

namespace {

bool send_all(int fd, const char* from, std::size_t size) {
  constexpr std::size_t kPiece = 1 << 20;
  while (size > 0) {
    const ssize_t sent = ::send(fd, from, std::min(size, kPiece), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    from += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool receive_all(int fd, char* to, std::size_t size) {
  while (size > 0) {
    const ssize_t got = ::recv(fd, to, size, 0);
    if (got <= 0) return false;
    to += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

bool drop_all(int fd, std::size_t size) {
  while (size > 0) {
    const ssize_t got = ::recv(fd, nullptr, size, MSG_TRUNC);
    if (got <= 0) return false;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace

Echo::Echo(std::size_t in, std::size_t out, Client::Body body)
    : in_(in), out_(out), body_(body), buffer_(std::max(in, out), 1) {
  const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ::bind(listener, reinterpret_cast<sockaddr*>(&address), sizeof address);
  ::listen(listener, 1);
  ::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
  pid_ = ::fork();
  if (pid_ == 0) {
    std::fill(buffer_.begin(), buffer_.end(), 2);  // pages of its own
    const int fd = ::accept(listener, nullptr, nullptr);
    while (receive_all(fd, buffer_.data(), in_) && send_all(fd, buffer_.data(), out_)) {
    }
    ::_exit(0);
  }
  fd_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  ::connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address);
  ::close(listener);
}

Echo::~Echo() {
  ::close(fd_);
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
}

bool Echo::exchange() {
  if (!send_all(fd_, buffer_.data(), in_)) return false;
  return body_ == Client::Body::dropped ? drop_all(fd_, out_) : receive_all(fd_, buffer_.data(), out_);
}

Client::Client(int port, Body body)
    : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)), body_(body), answer_(kHeadRoom) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<in_port_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const timeval patience{kPatienceMs / 1000, 0};
  ::setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  ::setsockopt(fd_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  if (::connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    ::close(fd_);
    fd_ = -1;
  }
}

Client::~Client() {
  if (fd_ >= 0) ::close(fd_);
}

std::size_t Client::receive(std::size_t at) {
  const ssize_t got = ::recv(fd_, answer_.data() + at, answer_.size() - at, 0);
  return got > 0 ? static_cast<std::size_t>(got) : 0;
}

std::size_t Client::exchange(std::string_view request) {
  while (!request.empty()) {
    const ssize_t sent = ::send(fd_, request.data(), request.size(), MSG_NOSIGNAL);
    if (sent <= 0) return 0;
    request.remove_prefix(static_cast<std::size_t>(sent));
  }
  std::size_t have = 0, body = std::string_view::npos;
  while (body == std::string_view::npos) {
    const std::size_t got = receive(have);
    if (got == 0) return 0;
    have += got;
    const std::size_t end = std::string_view(answer_.data(), have).find("\r\n\r\n");
    if (end != std::string_view::npos) body = end + 4;
  }
  const std::string head(answer_.data(), body);
  const std::size_t length = number_after(head, "content-length: ");
  if (!head.starts_with("HTTP/1.1 200") || length == 0) return 0;
  if (body_ == Body::dropped)
    return have <= body + length && drop_all(fd_, body + length - have) ? length : 0;
  if (answer_.size() < body + length) answer_.resize(body + length);
  while (have < body + length) {
    const std::size_t got = receive(have);
    if (got == 0) return 0;
    have += got;
  }
  return length;
}

}  // namespace subdivd::bench

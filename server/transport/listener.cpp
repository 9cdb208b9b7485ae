#include "server/transport/listener.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace subdivd::server {
namespace {

constexpr int kBacklog = 1024;
// The sender waits once so much is in the kernel that has not left. Enough for any line, as what has left
// does not count; the kernel's own limit of 4 MiB would push an answer's bytes out of the processor's cache
// before the reader fetches them: over loopback the sender would take 1.2 times as long.
constexpr int kUnsentBytes = 1 << 20;

Error failure(const std::string& host, int port, const std::string& reason) {
  return {ErrorCode::internal, "cannot listen on " + host + " port " + std::to_string(port) + ": " + reason};
}

int port_of(int fd) {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  if (::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &length) != 0) return 0;
  if (address.ss_family == AF_INET6) return ntohs(reinterpret_cast<sockaddr_in6*>(&address)->sin6_port);
  return ntohs(reinterpret_cast<sockaddr_in*>(&address)->sin_port);
}

// A bound and listening descriptor, or -1 and errno.
int listen_at(const addrinfo& candidate) {
  const int fd = ::socket(candidate.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0) return -1;
  const int on = 1;
  ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (::bind(fd, candidate.ai_addr, candidate.ai_addrlen) == 0 && ::listen(fd, kBacklog) == 0) return fd;
  const int reason = errno;
  ::close(fd);
  errno = reason;
  return -1;
}

}  // namespace

Result<std::unique_ptr<Listener>> Listener::open(const std::string& host, int port) {
  std::unique_ptr<Listener> listener(new Listener);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int fault = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (fault != 0) return failure(host, port, ::gai_strerror(fault));
  int reason = 0;
  for (const addrinfo* candidate = found; candidate != nullptr; candidate = candidate->ai_next) {
    listener->fd_ = listen_at(*candidate);
    if (listener->fd_ >= 0) break;
    reason = errno;
  }
  ::freeaddrinfo(found);
  if (listener->fd_ < 0) return failure(host, port, std::strerror(reason));
  listener->port_ = port_of(listener->fd_);
  return listener;
}

Listener::~Listener() {
  if (fd_ >= 0) ::close(fd_);
}

int Listener::accept_now() {
  for (;;) {
    const int fd = ::accept4(fd_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (fd >= 0) {
      // Without it a response of two segments waits for the client's delayed acknowledgement: 40 ms.
      const int on = 1;
      ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      ::setsockopt(fd, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &kUnsentBytes, sizeof kUnsentBytes);
      return fd;
    }
    if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) return kNoResources;
    // A connection that died in the queue concerns nobody; other errors of its network neither.
    if (errno != EINTR && errno != ECONNABORTED) return kNone;
  }
}

bool Listener::someone_waits() const {
  pollfd entry{fd_, POLLIN, 0};
  return ::poll(&entry, 1, 0) > 0;
}

}  // namespace subdivd::server

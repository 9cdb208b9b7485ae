#pragma once
// The listening socket.

#include <memory>
#include <string>

#include "core/base/result.h"

namespace subdivd::server {

class Listener {
 public:
  // `port` 0 takes a free one. Only SO_REUSEADDR is set: with SO_REUSEPORT, cpp-httplib's habit, a second
  // daemon could take half of this one's connections.
  static Result<std::unique_ptr<Listener>> open(const std::string& host, int port);
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  int port() const { return port_; }
  int fd() const { return fd_; }

  static constexpr int kNone = -1, kNoResources = -2;
  // The non-blocking descriptor of a connection that waits; or kNone; or kNoResources, when descriptors or
  // memory are out (the connection goes on waiting).
  int accept_now();
  bool someone_waits() const;

 private:
  Listener() = default;
  int fd_ = -1;
  int port_ = 0;
};

}  // namespace subdivd::server

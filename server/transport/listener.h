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
  // Waits for a connection and returns its non-blocking descriptor; -1 after stop().
  int accept();
  void stop();

 private:
  Listener() = default;
  int fd_ = -1;
  int wake_[2] = {-1, -1};  // a pipe: writing to it ends accept()
  int port_ = 0;
};

}  // namespace subdivd::server

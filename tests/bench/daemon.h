#pragma once
// The daemon in a process of its own, and a client that costs as little as a client can.

#include <sys/types.h>

#include <string>
#include <string_view>
#include <vector>

namespace subdivd::bench {

class Daemon {
 public:
  // `flags`: beside those that choose its port and keep its log quiet. port() is 0 when it does not start.
  explicit Daemon(const std::vector<std::string>& flags = {});
  ~Daemon();
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;
  int port() const { return port_; }

 private:
  pid_t pid_ = -1;
  int out_ = -1;
  int port_ = 0;
};

// One connection, kept open.
class Client {
 public:
  // What becomes of an answer's body: it is copied into a buffer that stays, or the kernel drops it, so that
  // what is measured is the daemon and not how fast two processes on one machine share its memory.
  enum class Body { kept, dropped };
  explicit Client(int port, Body body = Body::kept);
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  // Sends the request and reads the whole answer. The body's length; 0 unless the answer is 200 and complete.
  std::size_t exchange(std::string_view request);

 private:
  std::size_t receive(std::size_t at);
  int fd_;
  Body body_;
  std::vector<char> answer_;
};

// A process that knows no HTTP: it reads a request of `in` bytes and sends `out` bytes that it has, again and
// again. What the same bytes take on loopback without any work.
class Echo {
 public:
  Echo(std::size_t in, std::size_t out, Client::Body body);
  ~Echo();
  Echo(const Echo&) = delete;
  Echo& operator=(const Echo&) = delete;
  // Sends and receives as Client does; false when the other side has gone.
  bool exchange();

 private:
  std::size_t in_, out_;
  Client::Body body_;
  std::vector<char> buffer_;
  pid_t pid_ = -1;
  int fd_ = -1;
};

}  // namespace subdivd::bench

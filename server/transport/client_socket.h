#pragma once
// One accepted connection: buffered reads, whole writes, every wait with an end.

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace subdivd::server {

using Clock = std::chrono::steady_clock;

// How long a transfer may take: a grace period, and one second more for every MiB that has moved. A client
// that drips a byte a second, to hold a thread and a buffer, is cut at the end of the grace period; an honest
// one on a slow line is not.
class Pace {
 public:
  explicit Pace(std::chrono::milliseconds grace) : deadline_(Clock::now() + grace) {}
  void moved(std::size_t bytes) { deadline_ += std::chrono::microseconds(bytes); }
  Clock::time_point deadline() const { return deadline_; }

 private:
  Clock::time_point deadline_;
};

class ClientSocket {
 public:
  enum class Outcome { ready, closed, timed_out, given_up };

  // Takes ownership of a non-blocking socket.
  explicit ClientSocket(int fd) : fd_(fd) {}
  ~ClientSocket();
  ClientSocket(const ClientSocket&) = delete;
  ClientSocket& operator=(const ClientSocket&) = delete;

  int fd() const { return fd_; }
  std::string peer() const;  // numeric address, "" when unknown

  // What has arrived and was not consumed yet.
  std::string_view buffered() const { return std::string_view(buffer_).substr(consumed_); }
  void consume(std::size_t bytes);

  // Waits until something is buffered; asks `give_up` every 50 ms.
  Outcome wait(Clock::time_point deadline, const std::function<bool()>& give_up);
  // Adds to the buffer what the wire holds, at least a byte.
  Outcome fill(Clock::time_point deadline);
  // Moves up to `size` bytes (size > 0) from the buffer, or else the wire; 0: closed or out of time.
  std::size_t read(char* to, std::size_t size, Clock::time_point deadline);
  // Sends everything; false when the client is gone or too slow.
  bool write(const char* data, std::size_t size, Pace& pace);

  // Ends the connection after a response that left input unread: closing at once would make the kernel send
  // a reset, which can destroy the response before the client has read it.
  void linger();

 private:
  Outcome wait_for(short event, Clock::time_point deadline);
  Outcome receive(char* to, std::size_t size, Clock::time_point deadline, std::size_t& received);

  int fd_;
  std::string buffer_;
  std::size_t consumed_ = 0;
};

}  // namespace subdivd::server

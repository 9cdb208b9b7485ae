#pragma once
// One accepted connection: buffered reads, whole writes, every wait with an end.

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

#include "server/transport/transfer_time.h"

namespace subdivd::server {

class ClientSocket {
 public:
  enum class Outcome { ready, would_block, closed, timed_out };

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
  std::size_t buffer_bytes() const { return buffer_.capacity(); }
  // Gives the memory back that no buffered byte needs.
  void trim_buffer();

  // Adds to the buffer what has arrived, up to `most` bytes (and 32 KiB), without waiting. `ready`: at least
  // a byte; all of it unless the buffer grew by `most`.
  Outcome fill_now(std::size_t most);
  // As fill_now, but waits for a byte.
  Outcome fill(std::size_t most, TransferTime& time);
  // Waits for a byte (or the end) without reading it.
  Outcome wait_readable(Clock::time_point deadline) const;
  // Moves up to `size` bytes (size > 0) from the buffer, or else the wire; 0: closed or out of time.
  std::size_t read(char* to, std::size_t size, TransferTime& time);

  // Sends everything; false when the client is gone or too slow. `more` follows at once: it may travel along.
  bool write(std::string_view data, TransferTime& time, bool more = false);
  // Sends what the kernel takes at once.
  void write_now(std::string_view data) const;

  // Has the client sent something that nobody has read?
  bool holds_unread() const;
  // Ends our side. Closing at once while input is unread would make the kernel send a reset, which can
  // destroy the response before the client has read it.
  void end_sending() const;
  // Throws away what has arrived; closed: the client has ended its side, too.
  Outcome discard_now();

 private:
  Outcome wait_for(short event, Clock::time_point deadline) const;
  Outcome wait_for(short event, TransferTime& time) const;
  Outcome receive_now(char* to, std::size_t size, std::size_t& received) const;

  int fd_;
  std::string buffer_;
  std::size_t consumed_ = 0;
};

}  // namespace subdivd::server

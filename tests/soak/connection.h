#pragma once
// A client's end of one connection: it sends what it is told to, as badly as it is told to, and keeps of an
// answer what the soak wants to know.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace subdivd::soak {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

inline constexpr milliseconds kPatience{20'000};  // for one answer

struct Answer {
  int status = 0;      // 0: the connection ended, or patience did, before a whole answer had come
  bool closes = true;  // Connection: close, or closed already
  bool retry_after = false;
  std::size_t size = 0;  // of the body
  std::uint64_t digest = 0;
  std::string beginning;  // of the body; of what came at all when the status is 0
};

// How a slow reader reads; the default reads at once.
struct ReadingPace {
  std::size_t piece = 1 << 18;
  milliseconds pause{0};
};

class Connection {
 public:
  explicit Connection(int port, int receive_buffer = 0);  // 0: the system's size
  ~Connection() { close(); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  bool open() const { return fd_ >= 0; }
  bool send(std::string_view bytes);  // false once the daemon has closed
  bool send_slowly(std::string_view bytes, std::size_t piece, milliseconds pause);
  // The next answer; interim ones (100) are skipped.
  Answer receive(ReadingPace pace = {}, milliseconds patience = kPatience);
  void end_sending();  // FIN, and goes on reading
  void close();        // FIN; a RST when unread bytes are left
  void reset();        // RST

 private:
  bool more(const ReadingPace& pace, Clock::time_point deadline);
  Answer broken();

  int fd_;
  std::string buffer_;
};

}  // namespace subdivd::soak

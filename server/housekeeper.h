#pragma once
// Gives memory back to the system that requests have freed. The allocator and core/base/large_blocks keep it
// for the next request, which saves page faults (up to half of the time of a request with a large answer),
// but would keep the peak of the busiest minute for ever.

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

namespace subdivd::server {

class Housekeeper {
 public:
  struct Slack {
    std::uint64_t own = 0;   // what the process takes when it does nothing
    std::uint64_t busy = 0;  // that may stay freed but resident while requests come
    std::uint64_t idle = 0;  // and when none is being answered
  };
  struct Use {
    std::uint64_t bytes = 0;     // that requests use now
    std::uint64_t requests = 0;  // how many there have ever been
  };

  // Twice a second: trims when more is resident than the process's own, what `use` tells, and the slack.
  // Idle is who has had no request for two seconds. `use` is called from a thread of its own.
  Housekeeper(std::function<Use()> use, const Slack& slack);
  ~Housekeeper();
  Housekeeper(const Housekeeper&) = delete;
  Housekeeper& operator=(const Housekeeper&) = delete;

 private:
  void run();

  const std::function<Use()> use_;
  const Slack slack_;
  std::mutex mutex_;
  std::condition_variable ended_changed_;
  bool ended_ = false;
  std::thread thread_;
};

// Makes the allocator keep freed memory, in few places, where other threads find it again: of large blocks
// `kept` bytes at most, and together with those in use no more than `ceiling`; of others a quarter of that.
// Call before any thread starts.
void tune_allocator(std::uint64_t kept, std::uint64_t ceiling);

// Bytes of physical memory that this process takes; 0 when the system does not tell.
std::uint64_t resident_bytes();

}  // namespace subdivd::server

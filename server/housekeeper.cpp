#include "server/housekeeper.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <utility>

#include "core/base/large_blocks.h"

namespace subdivd::server {
namespace {

constexpr std::chrono::milliseconds kInterval{500};
constexpr int kIdleIntervals = 4;

// By default glibc gives every thread that it sees waiting an arena of its own, up to eight per processor,
// and no thread reuses what another one's arena holds free. Measured with 400 mixed requests from 4 clients:
// 2 arenas take as long as 16; mimalloc 2.0.9 faults every page of every request in again: 10 times the
// faults, 40 % more time.
constexpr int kArenas = 2;

// Left to itself, glibc gives the end of an arena back as soon as it is twice as long as the largest block
// that it has seen: a scan of 120,000 triangles faults 2,300 pages in again with every request, and takes
// 20 ms instead of 14. 32 MiB is the most that it allows.
constexpr std::uint64_t kMostMmapThreshold = std::uint64_t{32} << 20;
// Below glibc's own values every other block would be a mapping of its own, however little memory there is.
constexpr std::uint64_t kLeastThreshold = std::uint64_t{128} << 10;

}  // namespace

void tune_allocator(std::uint64_t kept, [[maybe_unused]] std::uint64_t ceiling) {
  const auto option = [](int name, std::uint64_t bytes) {
    ::mallopt(name, static_cast<int>(std::min<std::uint64_t>(bytes, std::numeric_limits<int>::max())));
  };
  ::mallopt(M_ARENA_MAX, kArenas);
  option(M_MMAP_THRESHOLD, std::clamp(kept / 8, kLeastThreshold, kMostMmapThreshold));
  option(M_TRIM_THRESHOLD, std::max(kept / 4, kLeastThreshold));
#ifndef __SANITIZE_ADDRESS__  // it would not see who uses what was freed
  large_blocks::keep({kept, ceiling});
#endif
}

std::uint64_t resident_bytes() {
  std::FILE* file = std::fopen("/proc/self/statm", "re");
  if (file == nullptr) return 0;
  unsigned long long size = 0, resident = 0;
  const int read = std::fscanf(file, "%llu %llu", &size, &resident);
  std::fclose(file);
  return read == 2 ? resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

Housekeeper::Housekeeper(std::function<Use()> use, const Slack& slack)
    : use_(std::move(use)), slack_(slack), thread_([this] { run(); }) {}

Housekeeper::~Housekeeper() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  ended_changed_.notify_all();
  thread_.join();
}

void Housekeeper::run() {
  const auto unused = [this](const Use& use) {
    const std::uint64_t resident = resident_bytes();
    return resident - std::min(resident, slack_.own + use.bytes);
  };
  // After a trim: what stayed resident, torn pages that no trim frees, and how many requests there had been.
  // Trimming again before anything has come would cost time and gain nothing.
  std::uint64_t stuck = 0, trimmed_after = 0;
  std::uint64_t requests = 0;  // when last looked at
  int quiet = 0;               // for how many intervals there have been no more
  std::unique_lock lock(mutex_);
  while (!ended_changed_.wait_for(lock, kInterval, [this] { return ended_; })) {
    const Use use = use_();
    const bool is_quiet = use.bytes == 0 && use.requests == requests;
    quiet = is_quiet ? quiet + 1 : 0;
    requests = use.requests;
    const std::uint64_t now = unused(use);
    stuck = std::min(stuck, now);
    const bool worth_it = quiet >= kIdleIntervals ? now > slack_.idle && (use.requests != trimmed_after ||
                                                                          now > stuck + slack_.idle)
                                                  : now > stuck + slack_.busy;
    if (!worth_it) continue;
    large_blocks::trim();
    ::malloc_trim(0);
    const Use then = use_();
    stuck = unused(then);
    // With a request under way, its memory is still to come.
    trimmed_after = use.bytes == 0 && then.bytes == 0 ? then.requests : 0;
  }
}

}  // namespace subdivd::server

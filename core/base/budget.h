#pragma once
// What a piece of work may use: bytes, time, and the patience of whoever asked. Every loop that can run
// long polls the budget; sizes are predicted and checked against it before anything is allocated.

#include <atomic>
#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "core/base/index.h"
#include "core/base/result.h"

namespace subdivd {

class Budget {
 public:
  using Clock = std::chrono::steady_clock;

  Budget() = default;  // unlimited

  Count max_bytes = std::numeric_limits<Count>::max();  // of all output arrays of one answer together
  Clock::time_point deadline = Clock::time_point::max();
  // Set by another thread when nobody waits for the answer any more; may be null. Must outlive the work.
  const std::atomic<bool>* cancelled = nullptr;

  // Call every few thousand elementary steps (a relaxed load and a clock read: about 30 ns).
  // Empty: go on. Otherwise the reason to stop, to be returned as it is.
  std::optional<Error> poll() const {
    if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed))
      return Error{ErrorCode::cancelled, "the caller went away", {}, 0, 0};
    if (deadline != Clock::time_point::max() && Clock::now() >= deadline)
      return Error{ErrorCode::deadline_exceeded, "the time allowed for this request ran out", {}, 0, 0};
    return std::nullopt;
  }

  // Refuses `bytes` of output when they exceed max_bytes.
  Result<void> check_bytes(Count bytes) const {
    if (bytes <= max_bytes) return {};
    return Error{ErrorCode::too_large,
                 "the answer would hold " + std::to_string(bytes) + " bytes; " + std::to_string(max_bytes) +
                     " are allowed: choose a lower level or a smaller mesh",
                 {},
                 bytes,
                 max_bytes};
  }
};

}  // namespace subdivd

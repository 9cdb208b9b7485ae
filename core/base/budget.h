#pragma once
// What a piece of work may use: bytes, time, threads, and the patience of whoever asked. Every loop that can
// run long polls the budget; sizes are predicted and checked against it before anything is allocated.

#include <atomic>
#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "core/base/helpers.h"
#include "core/base/index.h"
#include "core/base/result.h"

namespace subdivd {

// Memory set aside for one piece of work. Whoever shares memory out between pieces of work implements it.
class MemoryGrant {
 public:
  MemoryGrant() = default;
  MemoryGrant(const MemoryGrant&) = delete;
  MemoryGrant& operator=(const MemoryGrant&) = delete;
  virtual ~MemoryGrant() = default;

  // Sets `bytes` more aside, or says why not: too_large (never), overloaded (not now). May be called from any
  // thread.
  virtual Result<void> take(Count bytes) = 0;
};

class Budget {
 public:
  using Clock = std::chrono::steady_clock;

  Budget() = default;  // unlimited

  Count max_bytes = std::numeric_limits<Count>::max();  // of all output arrays of one answer together
  Clock::time_point deadline = Clock::time_point::max();
  // Set by another thread when nobody waits for the answer any more; may be null. Must outlive the work.
  const std::atomic<bool>* cancelled = nullptr;
  // Threads that may work on it as well, where it says how many it can use; null: they are made for it. Must
  // outlive the work.
  Helpers* helpers = nullptr;
  // Threads that may work on one thing together: the caller's and all that help.
  Index threads() const { return helpers == nullptr ? 1 : 1 + helpers->most(); }
  // Where memory is taken from; null: there is enough. Must outlive the work.
  MemoryGrant* memory = nullptr;

  // Call every few thousand elementary steps (a relaxed load and a clock read: about 30 ns).
  // Empty: go on. Otherwise the reason to stop, to be returned as it is.
  std::optional<Error> poll() const {
    if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed))
      return Error{ErrorCode::cancelled, "the caller went away"};
    if (deadline != Clock::time_point::max() && Clock::now() >= deadline)
      return Error{ErrorCode::deadline_exceeded, "the time allowed for this request ran out"};
    return std::nullopt;
  }

  // To be called before `bytes` are allocated whose size the caller of this work could not know: what
  // decoding makes of a body, what a declared length asks for. The error is to be returned as it is.
  Result<void> take_memory(Count bytes) const {
    if (memory == nullptr) return {};
    return memory->take(bytes);
  }

  // Refuses `bytes` of output when they exceed max_bytes.
  Result<void> check_bytes(Count bytes) const {
    if (bytes <= max_bytes) return {};
    return Error{.code = ErrorCode::too_large,
                 .message = "the answer would hold " + std::to_string(bytes) + " bytes; " +
                            std::to_string(max_bytes) +
                            " are allowed: choose a lower level or a smaller mesh",
                 .predicted = bytes,
                 .allowed = max_bytes};
  }
};

}  // namespace subdivd

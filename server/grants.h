#pragma once
// What requests share while they are computed: processors and memory. A request holds a Grant of both from
// before its body is decoded until its answer has been sent; the Grant is the only thing that gives back.
//
// There are two lanes, so that nothing large keeps small requests waiting. A request begins in the small lane
// when its body is small, and has to leave it when it turns out to need much memory. In either lane the first
// to come is the first to be served, and whoever waits holds nothing: a request that finds itself short of
// memory halfway drops what it has made, and comes again for all that it will need (Grant::wish).

#include <atomic>
#include <chrono>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <variant>

#include "core/base/budget.h"
#include "server/transport/waiting_line.h"

namespace subdivd::server {

class Grants {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Lane { small, large };

  // How much there is to share.
  struct Shares {
    std::size_t places = 1;        // large requests computed at once, a thread each
    std::size_t small_places = 2;  // small ones beside them
    std::size_t max_waiting = 32;  // in each lane
    Count bytes = 0;               // of memory
  };

  // What a request needs to begin with.
  struct Wish {
    Lane lane = Lane::small;
    Count bytes = 0;
  };

  enum class Denied { full, too_large, too_late, cancelled };

  // A place and memory, given back on destruction.
  class Grant final : public MemoryGrant {
   public:
    ~Grant() override;

    // Sets `bytes` more aside; those that it was entered with are used up first. overloaded: others have
    // them, or they are too many for the small lane; wish() then says what to come again for.
    Result<void> take(Count bytes) override;
    Wish wish() const;
    // The computing is over: gives the place back, and all memory but `bytes`.
    void keep_only(Count bytes);

   private:
    friend class Grants;
    Grant(Grants& grants, Lane lane) : grants_(grants), lane_(lane) {}

    Grants& grants_;
    // Guarded by Grants::mutex_.
    Lane lane_;
    Count bytes_ = 0;   // taken from the pool
    Count asked_ = 0;   // by take(), in all
    Count wanted_ = 0;  // that, and what was refused last
    bool has_place_ = false;
    Clock::time_point began_{};
  };

  explicit Grants(const Shares& shares);
  Grants(const Grants&) = delete;
  Grants& operator=(const Grants&) = delete;

  // Waits for a place and memory until `deadline`, or until `cancelled` (may be null) turns true.
  std::variant<std::shared_ptr<Grant>, Denied> enter(const Wish& wish, Clock::time_point deadline,
                                                     const std::atomic<bool>* cancelled);

  // The most that one request can ever have.
  Count most_bytes() const { return large_.bytes; }
  // The most that it can have in the small lane.
  Count most_small_bytes() const { return most_small_bytes_; }

  struct State {
    Count bytes = 0, free_bytes = 0;
    std::size_t places = 0, free_places = 0, waiting = 0;
    Count granted = 0;  // ever
  };
  State state() const;
  // How many requests are being computed.
  std::size_t running() const;

 private:
  struct Pool {
    Count bytes = 0, free_bytes = 0;
    std::size_t places = 0;
    std::deque<const Grant*> running;  // that have a place, the longest running first
    WaitingLine waiting;
  };

  Pool& pool(Lane lane) { return lane == Lane::small ? small_ : large_; }
  bool has_place(Lane lane, Clock::time_point now) const;
  void leave_place(Grant& grant);

  const std::size_t max_waiting_;
  mutable std::mutex mutex_;
  Pool small_, large_;
  Count most_small_bytes_ = 0, granted_ = 0;
};

}  // namespace subdivd::server

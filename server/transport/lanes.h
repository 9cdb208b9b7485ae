#pragma once
// Where complete requests wait for a thread: the general lane, with many threads, and the health lane, whose
// one thread also words refusals, so that both are answered at once however long the general lane is.

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>

#include "server/transport/connection.h"
#include "server/transport/service.h"
#include "server/transport/transfer_time.h"

namespace subdivd::server {

class Lanes {
 public:
  // Who waits longer for a thread than `patience`, and who comes when the general lane is full, is refused.
  Lanes(Service& service, std::chrono::milliseconds patience) : service_(service), patience_(patience) {}

  // Takes a connection whose request is complete. After close() it is dropped.
  void push(Connections one);
  // Waits for one; empty after close().
  Connections pop(Lane lane);
  // To be called every 100 ms, as long as somebody waits in the general lane (then it returns true): refuses
  // those who have waited for too long, asks slow transfers to make room for the others.
  bool look_after_waiting();

  // What slow transfers are asked for by those who wait.
  ThreadDemand& demand() { return demand_; }

  bool others_wait(Lane lane) const;
  bool has_spare_thread(Lane lane) const;
  std::size_t waiting() const;
  void close();

 private:
  struct Queue {
    std::condition_variable ready;
    Connections waiting;
    std::size_t spare_threads = 0;
  };

  Lane lane_of(Connection& connection);
  Queue& queue(Lane lane) { return queues_[static_cast<std::size_t>(lane)]; }
  const Queue& queue(Lane lane) const { return queues_[static_cast<std::size_t>(lane)]; }

  Service& service_;
  const std::chrono::milliseconds patience_;
  mutable std::mutex mutex_;
  std::array<Queue, 2> queues_;
  ThreadDemand demand_;
  bool closed_ = false;
};

}  // namespace subdivd::server

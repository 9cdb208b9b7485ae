#pragma once
// Threads that help with one piece of work and are there before it: making one takes as long as refining some
// ten thousand points.

#include "core/base/index.h"

namespace subdivd {

// Lends threads. All functions may be called from any thread.
class Helpers {
 public:
  // What several threads do together.
  class Job {
   public:
    virtual void run(Index k) = 0;  // throws nothing

   protected:
    ~Job() = default;
  };

  Helpers() = default;
  Helpers(const Helpers&) = delete;
  Helpers& operator=(const Helpers&) = delete;
  virtual ~Helpers() = default;

  // How many there are at most, for one job.
  virtual Index most() const = 0;
  // Has job.run(k) called for k = 1..n, each on a thread of its own, and returns n at once: `most` or fewer,
  // none when all have other work.
  virtual Index start(Index most, Job& job) = 0;
  // Returns when the job that was started has been run n times. Not to be left out: the job must live on.
  virtual void finish(Job& job) = 0;
};

}  // namespace subdivd

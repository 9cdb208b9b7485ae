#pragma once
// Whether everything that was taken has been given back, and how the run is told.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/soak/daemon.h"

namespace subdivd::soak {

struct Sample {
  double seconds = 0;
  Footprint footprint;
  std::optional<Counters> counters;
};

// At rest: before the traffic and after it.
struct Rest {
  Footprint footprint;
  std::optional<Counters> counters;
};

class Verdict {
 public:
  void check(const std::string& what, bool holds, const std::string& detail);
  bool good() const { return good_; }
  void print() const;

 private:
  struct Line {
    std::string what, detail;
    bool holds;
  };
  std::vector<Line> lines_;
  bool good_ = true;
};

// Waits, up to half a minute, for what must come back to come back, and returns the last state.
Rest settle(Daemon& daemon, const Rest* start);

void judge_counters(Verdict& verdict, const Rest& start, const Rest& end);
void judge_kernel(Verdict& verdict, const Rest& start, const Rest& end);
// Memory that only grows is a leak, however slowly it does.
void judge_memory(Verdict& verdict, const std::vector<Sample>& samples, const Rest& start, const Rest& end);
// No mix of requests takes more than was set aside.
void judge_peak(Verdict& verdict, std::uint64_t limit, const Rest& start, const Rest& end);

void print_samples(const std::vector<Sample>& samples);

}  // namespace subdivd::soak

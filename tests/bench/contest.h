#pragma once
// Several ways to do the same work, timed in turn, so that whatever the machine does besides hits all alike.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/results.h"

namespace subdivd::bench {

// When enough is enough: at least `least` rounds, then until `seconds` have passed or `most` are done.
struct Pace {
  double seconds;
  int least, most;
};
inline constexpr Pace kThorough{5, 5, 101}, kQuick{1, 3, 21};

// What one run measured: quantity and value.
using Laps = std::vector<std::pair<std::string, double>>;

class Contest {
 public:
  // `every`: takes part in every so-manieth round only, for those that take much longer than the rest.
  void enter(std::string who, std::function<Laps()> run, int every = 1);
  // Runs all in turn, round after round. Before a run that is known to be short the same is run untimed: it
  // then finds its data in the caches, as in a loop of its own. Returns the first contestant's median of
  // `quantity`.
  double hold(const Pace& pace, const std::string& cell, const std::string& quantity, Results& results);

 private:
  struct Contestant {
    std::string who;
    std::function<Laps()> run;
    int every;
    double last_ms = 0;
  };
  static Laps timed(Contestant& contestant);

  std::vector<Contestant> contestants_;
};

}  // namespace subdivd::bench

#include "tests/bench/contest.h"

#include "tests/bench/stopwatch.h"

namespace subdivd::bench {
namespace {

constexpr double kShortMs = 20;

}  // namespace

void Contest::enter(std::string who, std::function<Laps()> run, int every) {
  contestants_.push_back({std::move(who), std::move(run), every});
}

Laps Contest::timed(Contestant& contestant) {
  if (contestant.last_ms < kShortMs) contestant.run();
  Stopwatch stopwatch;
  Laps laps = contestant.run();
  contestant.last_ms = stopwatch.lap();
  return laps;
}

double Contest::hold(const Pace& pace, const std::string& cell, const std::string& quantity,
                     Results& results) {
  Stopwatch stopwatch;
  double elapsed = 0;
  for (int round = 0; round < pace.most && (round < pace.least || elapsed < pace.seconds * 1000); ++round) {
    for (Contestant& contestant : contestants_)
      if (round % contestant.every == 0)
        for (const auto& [measured, value] : timed(contestant))
          results.add(cell, measured, contestant.who, value);
    elapsed += stopwatch.lap();
  }
  return results.median(cell, quantity, contestants_.front().who).value_or(0);
}

}  // namespace subdivd::bench

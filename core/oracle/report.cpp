#include "core/oracle/report.h"

#include <algorithm>

namespace subdivd::oracle {
namespace {

// Of all parts and `begin` together.
template <class Parts, class VerdictOf>
Verdict all(const Parts& parts, Verdict begin, VerdictOf&& of) {
  for (const auto& part : parts) begin = both(begin, of(part));
  return begin;
}

}  // namespace

Verdict both(Verdict a, Verdict b) {
  for (const Verdict winner : {Verdict::failed, Verdict::nothing_compared})
    if (a == winner || b == winner) return winner;
  return Verdict::passed;
}

Verdict LevelReport::verdict() const {
  if (!connectivity_identical) return Verdict::failed;
  if (deviations.empty()) return Verdict::nothing_compared;
  return all(deviations, Verdict::passed, [](const Deviation& deviation) { return deviation.verdict; });
}

Verdict verdict_of(const std::vector<LevelReport>& levels) {
  if (levels.empty()) return Verdict::nothing_compared;
  const bool failed = std::any_of(levels.begin(), levels.end(), [](const LevelReport& level) {
    return level.verdict() == Verdict::failed;
  });
  return failed ? Verdict::failed : levels.back().verdict();
}

Verdict Report::verdict() const {
  if (meshes.empty() && curves.empty() && surfaces.empty()) return Verdict::nothing_compared;
  const auto of = [](const auto& part) { return part.verdict; };
  return all(surfaces, all(curves, all(meshes, Verdict::passed, of), of), of);
}

}  // namespace subdivd::oracle

#include "tests/differential/agreement.h"

#include <algorithm>
#include <sstream>

namespace subdivd::differential {
namespace {

std::string describe(Index level, const oracle::Deviation& deviation) {
  std::ostringstream text;
  text << "level " << level << ": " << deviation.quantity << " off by " << deviation.max_relative
       << " (tolerance " << deviation.tolerance << ", rms " << deviation.rms_relative << ") at vertex "
       << deviation.worst_vertex << ", face " << deviation.worst_face << " (" << deviation.worst_u << ", "
       << deviation.worst_v << "); " << deviation.compared << " compared, " << deviation.excepted
       << " left out " << deviation.exception << "\n";
  return text.str();
}

void add(Coverage& coverage, const oracle::Deviation& deviation) {
  coverage.compared += deviation.compared;
  coverage.excepted += deviation.excepted;
}

}  // namespace

template <class Real>
Agreement agreement(const ControlMesh& mesh, CreaseMethod method, Index level) {
  RefineOptions options;
  options.level = level;
  options.crease_method = method;
  options.limit = options.normals = true;
  Agreement result;
  if (const auto fine = mesh.check(); !fine) {
    result.disagreements = "check: " + fine.error().message + "\n";
    return result;
  }
  const auto report = oracle::verify<Real>(mesh, options, Budget{});
  if (!report) {
    result.disagreements = "verify: " + report.error().message + "\n";
    return result;
  }
  for (const oracle::LevelReport& at : report->levels) {
    if (!at.connectivity_identical)
      result.disagreements += "level " + std::to_string(at.level) + ": connectivity differs\n";
    for (const oracle::Deviation& deviation : at.deviations) {
      if (deviation.verdict == oracle::Verdict::failed) result.disagreements += describe(at.level, deviation);
      const bool limit = deviation.quantity == "limitPoints" || deviation.quantity.ends_with("/limit");
      add(deviation.quantity == "normals" ? result.normals
          : limit                         ? result.limits
                                          : result.values,
          deviation);
    }
  }
  if (result.disagreements.empty() == (report->verdict == oracle::Verdict::failed))
    result.disagreements += "the verdict contradicts the numbers\n";
  return result;
}

template Agreement agreement<float>(const ControlMesh&, CreaseMethod, Index);
template Agreement agreement<double>(const ControlMesh&, CreaseMethod, Index);

bool has_semi_sharp_creases(const ControlMesh& mesh) {
  return std::any_of(mesh.crease_sharpnesses.begin(), mesh.crease_sharpnesses.end(),
                     [](float s) { return s > 0 && s < kInfiniteSharpness; });
}

}  // namespace subdivd::differential

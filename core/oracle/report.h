#pragma once
// The verdict of the comparison between our core and OpenSubdiv: plain data, no OpenSubdiv in sight, nothing
// to link with.

#include <optional>
#include <string>
#include <vector>

#include "core/base/index.h"

namespace subdivd::oracle {

// What a comparison came to. No bool, and not convertible to one: where nothing was compared, nothing has
// passed, and no caller may take it for that.
enum class Verdict {
  passed,            // everything that was asked for was compared, and agrees
  failed,            // something disagrees, whatever else was or was not compared
  nothing_compared,  // nothing disagrees, but of something that was asked for no single value was compared
};

// Of two parts together: failed wins over nothing_compared, that over passed.
inline Verdict both(Verdict a, Verdict b) {
  for (const Verdict winner : {Verdict::failed, Verdict::nothing_compared})
    if (a == winner || b == winner) return winner;
  return Verdict::passed;
}

// Deviations of one quantity at one level. `relative` divides by the diagonal of the control points' bounding
// box (positions, limits) or by the largest magnitude among the channel's control values (primvars, 1 when
// all are 0); normals are angles in degrees, absolute and relative being the same.
struct Deviation {
  std::string quantity;  // "points", "limitPoints", "normals", "primvars/<name>", "primvars/<name>/limit"
  double max_absolute = 0, rms_absolute = 0;
  double max_relative = 0, rms_relative = 0;
  double tolerance = 0;   // of max_relative
  Count compared = 0;     // number of values compared
  Count excepted = 0;     // values left out for a documented reason, named in `exception`
  std::string exception;  // e.g. "corners of several faces have no common tangent plane"; empty when none
  Verdict verdict = Verdict::nothing_compared;  // max_relative against the tolerance
  // Where the worst value is; kNoIndex when nothing was compared. Face, corner, u and v as in provenance.h.
  Index worst_vertex = kNoIndex, worst_face = kNoIndex, worst_corner = 0;
  double worst_u = 0, worst_v = 0;
};

struct LevelReport {
  Index level = 0;
  bool connectivity_identical = false;
  Count vertices = 0, faces = 0;  // curves have no faces
  std::vector<Deviation> deviations;

  // failed, too, when the connectivity differs; nothing_compared without deviations.
  Verdict verdict() const {
    if (!connectivity_identical) return Verdict::failed;
    if (deviations.empty()) return Verdict::nothing_compared;
    Verdict all = Verdict::passed;
    for (const Deviation& deviation : deviations) all = both(all, deviation.verdict);
    return all;
  }
};

// Of consecutive levels, the last of which is the one that was asked for: failed when any of them has failed,
// otherwise the last one's. What could not be compared on the way there (limits while semi-sharpness lasts)
// is no loss when it could be in the end. nothing_compared without levels.
inline Verdict verdict_of(const std::vector<LevelReport>& levels) {
  for (const LevelReport& level : levels)
    if (level.verdict() == Verdict::failed) return Verdict::failed;
  return levels.empty() ? Verdict::nothing_compared : levels.back().verdict();
}

struct MeshReport {
  std::string name;
  std::string precision;                        // "single" or "double"
  std::vector<LevelReport> levels;              // 1..level
  Verdict verdict = Verdict::nothing_compared;  // of the levels
  std::vector<std::string> remarks;             // what could not be compared and why
};

struct CurveReport {
  std::string name, precision;
  std::vector<LevelReport> levels;  // quantity "points" and "limitPoints"
  Verdict verdict = Verdict::nothing_compared;
  std::vector<std::string> remarks;  // e.g. "periodic curves: compared as a closed border"
};

struct SurfaceReport {
  std::string name, precision;
  std::vector<LevelReport> levels;  // quantity "points", "limitPoints" and "normals"
  Verdict verdict = Verdict::nothing_compared;
  std::vector<std::string> remarks;  // e.g. "u is periodic: compared on a grid that closes in that direction"
};

struct Report {
  std::string oracle;  // "OpenSubdiv 3.5.0 Far"
  std::vector<MeshReport> meshes;
  std::vector<CurveReport> curves;
  std::vector<SurfaceReport> surfaces;

  // Of all meshes, curves and surfaces; nothing_compared without any.
  Verdict verdict() const {
    if (meshes.empty() && curves.empty() && surfaces.empty()) return Verdict::nothing_compared;
    Verdict all = Verdict::passed;
    for (const MeshReport& part : meshes) all = both(all, part.verdict);
    for (const CurveReport& part : curves) all = both(all, part.verdict);
    for (const SurfaceReport& part : surfaces) all = both(all, part.verdict);
    return all;
  }
};

}  // namespace subdivd::oracle

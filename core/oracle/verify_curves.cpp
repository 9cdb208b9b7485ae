// A cubic curve in Far, which knows surfaces only:
//
//     B0 --- B1 --- B2 --- B3        The border A0 A1 A2 … of a strip of triangles follows the curve's rules
//     | \    | \    | \    |         whatever the row B is. Ends of open curves are made sharp corners. The
//     |   \  |   \  |   \  |         points ride along as a primvar of any width. A ring of triangles
//     A0 --- A1 --- A2 --- A3        closes a periodic curve.

#include <algorithm>
#include <cmath>

#include "core/oracle/compare.h"
#include "core/oracle/far.h"
#include "core/oracle/scale.h"
#include "core/oracle/tally.h"
#include "core/oracle/verify.h"
#include "core/refine/split.h"

namespace subdivd::oracle {
namespace {

// Several curves' points, all open and pinned or all closed.
struct Borders {
  bool closed = false;
  Index width = 3;
  std::vector<Index> counts;   // points per curve
  std::vector<double> points;  // every float is a double: nothing is lost on the way into the next level

  Index segments_of(std::size_t curve) const { return counts[curve] - (closed ? 0 : 1); }
};

void append_strip(const Borders& borders, std::size_t curve, Index first_point, ControlMesh& mesh) {
  const Index n = borders.counts[curve];
  const Index a = 2 * first_point, b = a + n;
  for (Index s = 0; s < borders.segments_of(curve); ++s) {
    const Index t = (s + 1) % n;
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(),
                                    {a + s, a + t, b + s, b + s, a + t, b + t});
  }
  if (!borders.closed) {
    mesh.corner_indices.insert(mesh.corner_indices.end(), {a, a + n - 1});
    mesh.corner_sharpnesses.insert(mesh.corner_sharpnesses.end(), 2, kInfiniteSharpness);
  }
  Primvar& carried = mesh.primvars[0];
  const auto begin = borders.points.begin() + std::ptrdiff_t{first_point} * borders.width;
  for (int row = 0; row < 2; ++row)
    carried.values.insert(carried.values.end(), begin, begin + std::ptrdiff_t{n} * borders.width);
}

ControlMesh strips(const Borders& borders) {
  ControlMesh mesh;
  mesh.points.resize(borders.points.size() / borders.width * 2 * 3);
  mesh.primvars.resize(1);
  mesh.primvars[0].name = "curve";
  mesh.primvars[0].interpolation = Interpolation::vertex;
  mesh.primvars[0].element_size = borders.width;
  Index first = 0;
  for (std::size_t c = 0; c < borders.counts.size(); ++c) {
    append_strip(borders, c, first, mesh);
    first += borders.counts[c];
  }
  return mesh;
}

// Far's borders after `level` (0 or 1) more levels.
struct RefinedBorders {
  Borders borders;
  std::vector<double> limits;  // per point, on request
};

template <class Real>
Result<RefinedBorders> refine_borders(const Borders& from, Index level, bool limit, const Budget& budget) {
  RefineOptions options;
  options.level = level;
  options.limit = limit;
  const auto far = far_refine<Real>(strips(from), options, budget);
  if (!far) return far.error();

  RefinedBorders to{from, {}};
  const Index n = static_cast<Index>(segments(level));
  // Per base face: the curve's first refined point, its refined points, and the segment's first one.
  struct Segment {
    Count first, count, begin;
  };
  std::vector<Segment> of_face;
  Count first = 0;
  for (std::size_t c = 0; c < from.counts.size(); ++c) {
    const Index segments_here = from.segments_of(c);
    const Index count = segments_here * n + (from.closed ? 0 : 1);
    to.borders.counts[c] = count;
    for (Index s = 0; s < segments_here; ++s) of_face.insert(of_face.end(), 2, {first, count, Count{s} * n});
    first += count;
  }
  const std::size_t width = from.width;
  to.borders.points.assign(first * width, 0);
  if (limit) to.limits.assign(first * width, 0);
  for (std::size_t corner = 0; corner < far->faces.size(); ++corner) {
    const Index face = far->base_faces[corner / 3];
    const GridPoint place = far->corners[corner];
    if (face % 2 != 0 || place.j != 0) continue;  // A_s A_{s+1} is edge 0 of every even face
    const Segment& segment = of_face[face];
    const Count point = segment.first + (segment.begin + place.i) % segment.count;
    for (std::size_t k = 0; k < width; ++k) {
      const std::size_t source = std::size_t{far->faces[corner]} * width + k;
      to.borders.points[point * width + k] = double{far->primvars[0].values[source]};
      if (limit) to.limits[point * width + k] = double{far->primvars[0].limit_values[source]};
    }
  }
  return to;
}

// Compares one quantity of all curves. A nonperiodic curve is the part of the pinned one that starts at its
// point 2^level - 1; `trimmed` leaves the first and last point of every curve out.
template <class Real>
Deviation compare_curves(const char* quantity, const RefinedCurves<Real>& ours,
                         const std::vector<Real>& values, const Borders& far,
                         const std::vector<double>& far_values, const PointScale& scale, bool trimmed) {
  const Count n = segments(ours.level);
  const Count skipped = ours.wrap == CurveWrap::nonperiodic ? n - 1 : 0;
  Tally tally(quantity, scale.diagonal, value_tolerance<Real>() * scale.remoteness, 1);
  Count our_first = 0, far_first = 0;
  for (Index c = 0; c < ours.vertex_counts.size(); ++c) {
    const Index count = ours.vertex_counts[c];
    for (Index i = 0; i < count; ++i) {
      if (trimmed && (i == 0 || i + 1 == count)) {
        tally.except("the first and last point of a nonperiodic curve begin no segment");
        continue;
      }
      double square = 0;
      for (Index k = 0; k < ours.width; ++k) {
        const double mine = double{values[(our_first + i) * ours.width + k]};
        const double other = far_values[(far_first + skipped + i) * ours.width + k];
        const double difference = mine / scale.diagonal - other / scale.diagonal;
        square += difference * difference;
      }
      Site site{static_cast<Index>(our_first + i), {}};
      tally.add(std::sqrt(square), site);
    }
    our_first += count;
    far_first += far.counts[c];
  }
  return tally.finish();
}

bool same_counts(CurveWrap wrap, Index level, const std::vector<Index>& ours, const Borders& far) {
  if (ours.size() != far.counts.size()) return false;
  for (std::size_t c = 0; c < ours.size(); ++c) {
    const Count shorter = wrap == CurveWrap::nonperiodic ? 2 * (segments(level) - 1) : 0;
    if (ours[c] + shorter != far.counts[c]) return false;
  }
  return true;
}

// The curve and the parameter of the worst point.
template <class Real>
void locate(const RefinedCurves<Real>& ours, Deviation& deviation) {
  if (deviation.worst_vertex == kNoIndex) return;
  Index first = 0, curve = 0;
  while (deviation.worst_vertex - first >= ours.vertex_counts[curve]) first += ours.vertex_counts[curve++];
  const double n = static_cast<double>(segments(ours.level));
  const double start = ours.wrap == CurveWrap::nonperiodic ? (n - 1) / n : 0;
  deviation.worst_face = curve;
  deviation.worst_u = start + (deviation.worst_vertex - first) / n;
}

template <class Real>
LevelReport compare_level(const RefinedCurves<Real>& ours, const RefinedBorders& far,
                          const PointScale& scale) {
  LevelReport report;
  report.level = ours.level;
  report.vertices = ours.points.size() / ours.width;
  report.connectivity_identical = same_counts(ours.wrap, ours.level, ours.vertex_counts, far.borders);
  if (!report.connectivity_identical) return report;
  const bool nonperiodic = ours.wrap == CurveWrap::nonperiodic;
  report.deviations.push_back(
      compare_curves("points", ours, ours.points, far.borders, far.borders.points, scale, false));
  if (!ours.limit_points.empty())
    report.deviations.push_back(
        compare_curves("limitPoints", ours, ours.limit_points, far.borders, far.limits, scale, nonperiodic));
  for (Deviation& deviation : report.deviations) locate(ours, deviation);
  return report;
}

std::string remark(CurveWrap wrap) {
  switch (wrap) {
    case CurveWrap::periodic:
      return "periodic curves: compared as the border of a ring of triangles";
    case CurveWrap::nonperiodic:
      return "nonperiodic curves: compared as the inner part of a border";
    case CurveWrap::pinned:
      break;
  }
  return "pinned curves: compared as the border of a strip of triangles with sharp corners";
}

}  // namespace

template <class Real>
Result<CurveReport> verify(const ControlCurves& curves, const CurveOptions& options, const Budget& budget) {
  CurveReport report;
  report.name = curves.name;
  report.precision = sizeof(Real) == sizeof(float) ? "single" : "double";
  report.remarks.push_back(remark(curves.wrap));
  report.passed = true;
  const PointScale scale = point_scale(curves.points, curves.width);

  RefinedBorders far;
  far.borders.closed = curves.wrap == CurveWrap::periodic;
  far.borders.width = curves.width;
  far.borders.points = curves.points;
  for (Count c = 0; c < curves.curve_count(); ++c)
    far.borders.counts.push_back(static_cast<Index>(curves.points_of_curve(c)));
  for (Index level = std::min<Index>(1, options.level); level <= options.level; ++level) {
    CurveOptions step = options;
    step.level = level;
    step.tangents = false;
    const auto ours = refine<Real>(curves, step, budget);
    if (!ours) return ours.error();
    auto next = refine_borders<Real>(far.borders, std::min<Index>(1, level), options.limit, budget);
    if (!next) return next.error();
    far = std::move(*next);
    report.levels.push_back(compare_level(*ours, far, scale));
    report.passed = report.passed && passed(report.levels.back());
  }
  return report;
}

template Result<CurveReport> verify<float>(const ControlCurves&, const CurveOptions&, const Budget&);
template Result<CurveReport> verify<double>(const ControlCurves&, const CurveOptions&, const Budget&);

}  // namespace subdivd::oracle

#include <cmath>

#include "core/lattice/split.h"
#include "core/oracle/compare.h"
#include "core/oracle/deviation_meter.h"

namespace subdivd::oracle {
namespace {

// Compares one quantity of all curves. A nonperiodic curve is the part of the pinned one that starts at its
// point 2^level - 1; `trimmed` leaves the first and last point of every curve out.
template <class Real>
Deviation compare_curves(const char* quantity, const RefinedCurves<Real>& ours, const Buffer<Real>& values,
                         const FarCurves& far, const Buffer<double>& far_values, const PointScale& scale,
                         bool trimmed, const Pace& pace) {
  const Count n = segments(ours.level);
  const Count skipped = ours.wrap == CurveWrap::nonperiodic ? n - 1 : 0;
  DeviationMeter meter(quantity, scale.diagonal, value_tolerance<Real>() * scale.remoteness, 1);
  Count our_first = 0, far_first = 0;
  for (Index c = 0; c < ours.vertex_counts.size(); ++c) {
    const Index count = ours.vertex_counts[c];
    for (Index i = 0; i < count; ++i) {
      pace.spend(8 + ours.width);
      if (trimmed && (i == 0 || i + 1 == count)) {
        meter.except("the first and last point of a nonperiodic curve begin no segment");
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
      meter.add(std::sqrt(square), site);
    }
    our_first += count;
    far_first += far.counts[c];
  }
  return meter.finish();
}

template <class Real>
bool same_counts(const RefinedCurves<Real>& ours, const FarCurves& far, const Pace& pace) {
  if (ours.vertex_counts.size() != far.counts.size() || ours.width != far.width) return false;
  const Count shorter = ours.wrap == CurveWrap::nonperiodic ? 2 * (segments(ours.level) - 1) : 0;
  Count points = 0;
  for (std::size_t c = 0; c < far.counts.size(); ++c) {
    pace.spend(1);
    if (ours.vertex_counts[c] + shorter != far.counts[c]) return false;
    points += ours.vertex_counts[c];
  }
  return ours.points.size() == points * ours.width &&
         (ours.limit_points.empty() || ours.limit_points.size() == ours.points.size());
}

// The curve and the parameter of the worst point.
template <class Real>
void locate(const RefinedCurves<Real>& ours, Deviation& deviation, const Pace& pace) {
  if (deviation.worst_vertex == kNoIndex) return;
  Index first = 0, curve = 0;
  while (deviation.worst_vertex - first >= ours.vertex_counts[curve]) {
    pace.spend(1);
    first += ours.vertex_counts[curve++];
  }
  const double n = static_cast<double>(segments(ours.level));
  const double start = ours.wrap == CurveWrap::nonperiodic ? (n - 1) / n : 0;
  deviation.worst_face = curve;
  deviation.worst_u = start + (deviation.worst_vertex - first) / n;
}

}  // namespace

template <class Real>
LevelReport compare(const RefinedCurves<Real>& ours, const FarCurves& far, const PointScale& scale,
                    const Pace& pace) {
  LevelReport report;
  report.level = ours.level;
  report.vertices = ours.points.size() / ours.width;
  report.connectivity_identical = same_counts(ours, far, pace);
  if (!report.connectivity_identical) return report;
  const bool nonperiodic = ours.wrap == CurveWrap::nonperiodic;
  report.deviations.push_back(
      compare_curves("points", ours, ours.points, far, far.points, scale, false, pace));
  if (!ours.limit_points.empty())
    report.deviations.push_back(
        compare_curves("limitPoints", ours, ours.limit_points, far, far.limits, scale, nonperiodic, pace));
  for (Deviation& deviation : report.deviations) locate(ours, deviation, pace);
  return report;
}

template LevelReport compare(const RefinedCurves<float>&, const FarCurves&, const PointScale&, const Pace&);
template LevelReport compare(const RefinedCurves<double>&, const FarCurves&, const PointScale&, const Pace&);

}  // namespace subdivd::oracle

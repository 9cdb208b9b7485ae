#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "core/lattice/split.h"
#include "core/oracle/compare.h"
#include "core/oracle/deviation_meter.h"
#include "core/oracle/vectors.h"

namespace subdivd::oracle {
namespace {

constexpr const char* kBeyond = "a nonperiodic direction's first and last points lie beyond the surface";
constexpr const char* kNoNormal = "degenerate surface without a normal";
constexpr const char* kOverflow = "Far's tangents leave the range of the numbers";

// Everything that one level's comparisons share.
template <class Real>
struct Sides {
  const ControlPatch& patch;
  const RefinedPatch<Real>& ours;
  const FarSurface& far;
  // A nonperiodic direction is the part of the pinned one that starts at its point 2^level - 1.
  Count skipped_u = 0, skipped_v = 0;
  PointScale scale;
  const Pace& pace;

  DeviationMeter meter(const char* quantity, double unit_size, double tolerance) const {
    return {quantity, unit_size, tolerance, 1};
  }
  Count points() const { return Count{ours.u_count} * ours.v_count; }
  bool beyond_surface(Count i, Count j) const {
    return (patch.u_wrap == CurveWrap::nonperiodic && (i == 0 || i + 1 == ours.u_count)) ||
           (patch.v_wrap == CurveWrap::nonperiodic && (j == 0 || j + 1 == ours.v_count));
  }
  // Calls visit(our point, Far's point, whether it lies beyond the surface) for every point of ours.
  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    for (Count j = 0; j < ours.v_count; ++j)
      for (Count i = 0; i < ours.u_count; ++i) {
        pace.spend(8 + ours.width);
        visit(j * ours.u_count + i, (j + skipped_v) * far.u.points + i + skipped_u, beyond_surface(i, j));
      }
  }
};

Count skipped(CurveWrap wrap, Index level) {
  return wrap == CurveWrap::nonperiodic ? segments(level) - 1 : 0;
}

bool same_direction(CurveWrap wrap, CurveWrap our_wrap, Count our_points, FarDirection far, Count skip) {
  return wrap == our_wrap && far.closed == (wrap == CurveWrap::periodic) &&
         our_points + 2 * skip == far.points;
}

// Every number that is compared exists.
template <class Real>
bool same_sizes(const Sides<Real>& sides) {
  const RefinedPatch<Real>& ours = sides.ours;
  const FarSurface& far = sides.far;
  if (!same_direction(sides.patch.u_wrap, ours.u_wrap, ours.u_count, far.u, sides.skipped_u) ||
      !same_direction(sides.patch.v_wrap, ours.v_wrap, ours.v_count, far.v, sides.skipped_v) ||
      ours.width != sides.patch.width || ours.width != far.width)
    return false;
  const Count size = sides.points() * ours.width, far_size = far.u.points * far.v.points * far.width;
  if (ours.points.size() != size || far.points.size() != far_size) return false;
  if (!ours.limit_points.empty() && (ours.limit_points.size() != size || far.limits.size() != far_size))
    return false;
  return ours.normals.empty() || (ours.width == 3 && ours.normals.size() == size &&
                                  far.u_tangents.size() == far_size && far.v_tangents.size() == far_size);
}

using Quad = std::array<Index, 4>;

// The same quad beginning with its smallest corner: the order around it stays.
Quad canonical(Quad quad) {
  std::rotate(quad.begin(), std::min_element(quad.begin(), quad.end()), quad.end());
  return quad;
}

// Far's point by our number; kNoIndex where we have none.
template <class Real>
Index our_number(const Sides<Real>& sides, Index far_point) {
  const Count i = far_point % sides.far.u.points, j = far_point / sides.far.u.points;
  if (i < sides.skipped_u || j < sides.skipped_v) return kNoIndex;
  const Count u = i - sides.skipped_u, v = j - sides.skipped_v;
  if (u >= sides.ours.u_count || v >= sides.ours.v_count) return kNoIndex;
  return static_cast<Index>(v * sides.ours.u_count + u);
}

// In ascending order: by their first corners, of which each is that of a few, then by all. Linear, and
// polled.
Buffer<Quad> sorted(const Buffer<Quad>& quads, Count points, const Pace& pace) {
  std::vector<Index> ends(points, 0);  // of every first corner's quads
  for (const Quad& quad : quads) {
    pace.spend(1);
    ++ends[quad[0]];
  }
  Index end = 0;
  for (Index& count : ends) {
    pace.spend(1);
    end += std::exchange(count, end);
  }
  Buffer<Quad> result(quads.size());
  for (const Quad& quad : quads) {
    pace.spend(2);
    result[ends[quad[0]]++] = quad;
  }
  auto begin = result.begin();
  for (const Index last : ends) {
    const auto next = result.begin() + std::ptrdiff_t{last};
    pace.spend(1 + static_cast<Count>(next - begin));
    std::sort(begin, next);
    begin = next;
  }
  return result;
}

// The same quads, in whatever order and from whatever corner on, the same way round.
template <class Real>
bool same_quads(const Sides<Real>& sides) {
  const RefinedPatch<Real>& ours = sides.ours;
  if (ours.corners_per_face != 4 || ours.faces.size() % 4 != 0) return false;
  Buffer<Quad> mine, theirs;
  mine.reserve(ours.faces.size() / 4);
  for (std::size_t k = 0; k < ours.faces.size(); k += 4) {
    sides.pace.spend(4);
    mine.push_back(canonical({ours.faces[k], ours.faces[k + 1], ours.faces[k + 2], ours.faces[k + 3]}));
    if (mine.back()[0] >= sides.points()) return false;
  }
  theirs.reserve(mine.size());
  for (std::size_t k = 0; k + 3 < sides.far.quads.size(); k += 4) {
    Quad quad;
    sides.pace.spend(8);
    for (std::size_t c = 0; c < 4; ++c) quad[c] = our_number(sides, sides.far.quads[k + c]);
    if (std::find(quad.begin(), quad.end(), kNoIndex) == quad.end()) theirs.push_back(canonical(quad));
  }
  if (mine.size() != theirs.size()) return false;
  return sorted(mine, sides.points(), sides.pace) == sorted(theirs, sides.points(), sides.pace);
}

// Distances of points or limit points.
template <class Real>
Deviation compare_points(const Sides<Real>& sides, const char* quantity, const Buffer<Real>& ours,
                         const Buffer<double>& far, bool limit) {
  const double diagonal = sides.scale.diagonal;
  DeviationMeter meter = sides.meter(quantity, diagonal, value_tolerance<Real>() * sides.scale.remoteness);
  const std::size_t width = sides.ours.width;
  sides.for_each_pair([&](Count v, Count f, bool beyond) {
    if (limit && beyond) return meter.except(kBeyond);
    double square = 0;
    for (std::size_t k = 0; k < width; ++k) {
      const double difference = double{ours[v * width + k]} / diagonal - far[f * width + k] / diagonal;
      square += difference * difference;
    }
    meter.add(std::sqrt(square), Site{static_cast<Index>(v), {}});
  });
  return meter.finish();
}

// How long |u x v| / (|u| + |v|) must be at least for a normal that is worth comparing. Tangents are
// differences of coordinates, which have been rounded several times by epsilon times their size; that turns
// the normal by about rounding (|u| + |v|) / |u x v|. Here the sum of both sides' roundings stays below the
// tolerance, and our own normal, which is 0 where the product might be of rounding's making (below 480
// epsilon, tensor_rules.h), must exist.
template <class Real>
double least_height(const PointScale& scale) {
  const double rounding = double{std::numeric_limits<Real>::epsilon()} * scale.diagonal * scale.remoteness +
                          double{std::numeric_limits<Real>::denorm_min()};
  return rounding * std::max(8 / (normal_tolerance<Real>() * std::numbers::pi / 180), 480.0);
}

template <class Real>
Deviation compare_normals(const Sides<Real>& sides) {
  DeviationMeter meter = sides.meter("normals", 1, normal_tolerance<Real>());
  const double least = least_height<Real>(sides.scale);
  sides.for_each_pair([&](Count at, Count f, bool beyond) {
    if (beyond) return meter.except(kBeyond);
    const Vector u = vector_at<double>(sides.far.u_tangents, f);
    const Vector v = vector_at<double>(sides.far.v_tangents, f);
    if (!std::isfinite(length(u)) || !std::isfinite(length(v))) return meter.except(kOverflow);
    const Vector theirs = cross(unit(u), unit(v));
    // |u x v| / (|u| + |v|) in a form that neither over- nor underflows.
    const double height = length(theirs) / (1 / length(u) + 1 / length(v));
    if (!(height > least)) return meter.except(kNoNormal);
    const Vector ours = vector_at<Real>(sides.ours.normals, at);
    // Where the surface has a normal, none at all is as wrong as can be. 1e-3: far more than rounding takes.
    const bool is_unit = std::abs(length(ours) - 1) < 1e-3;
    meter.add(is_unit ? degrees_between(ours, unit(theirs)) : 180, Site{static_cast<Index>(at), {}});
  });
  return meter.finish();
}

// The quad of the control grid along one direction.
Count cell(CurveWrap wrap, Index count, double parameter) {
  const Count last = wrap == CurveWrap::periodic ? count - 1 : count - 2;
  return std::min(static_cast<Count>(std::max(parameter, 0.0)), last);
}

// The parameters and the base quad of the worst point.
template <class Real>
void locate(const Sides<Real>& sides, Deviation& deviation) {
  if (deviation.worst_vertex == kNoIndex) return;
  const ControlPatch& patch = sides.patch;
  const Index level = sides.ours.level, i = deviation.worst_vertex % sides.ours.u_count,
              j = deviation.worst_vertex / sides.ours.u_count;
  deviation.worst_u = patch_parameter(patch.u_wrap, patch.u_degree, patch.u_count, level, i);
  deviation.worst_v = patch_parameter(patch.v_wrap, patch.v_degree, patch.v_count, level, j);
  const Count row = patch.u_wrap == CurveWrap::periodic ? patch.u_count : patch.u_count - 1;
  deviation.worst_face = static_cast<Index>(cell(patch.v_wrap, patch.v_count, deviation.worst_v) * row +
                                            cell(patch.u_wrap, patch.u_count, deviation.worst_u));
}

}  // namespace

template <class Real>
LevelReport compare(const ControlPatch& patch, const RefinedPatch<Real>& ours, const FarSurface& far,
                    const Pace& pace) {
  const Sides<Real> sides{patch,
                          ours,
                          far,
                          skipped(patch.u_wrap, ours.level),
                          skipped(patch.v_wrap, ours.level),
                          point_scale(patch.points, patch.width, pace),
                          pace};
  LevelReport report;
  report.level = ours.level;
  report.vertices = sides.points();
  report.faces = ours.faces.size() / 4;
  report.connectivity_identical = same_sizes(sides) && same_quads(sides);
  if (!report.connectivity_identical) return report;
  report.deviations.push_back(compare_points(sides, "points", ours.points, far.points, false));
  if (!ours.limit_points.empty())
    report.deviations.push_back(compare_points(sides, "limitPoints", ours.limit_points, far.limits, true));
  if (!ours.normals.empty()) report.deviations.push_back(compare_normals(sides));
  for (Deviation& deviation : report.deviations) locate(sides, deviation);
  return report;
}

template LevelReport compare(const ControlPatch&, const RefinedPatch<float>&, const FarSurface&, const Pace&);
template LevelReport compare(const ControlPatch&, const RefinedPatch<double>&, const FarSurface&,
                             const Pace&);

}  // namespace subdivd::oracle

#include "core/curves/cubic.h"

#include <cmath>

#include "core/curves/precision.h"

namespace subdivd {
namespace {

constexpr Count kPollInterval = 4096;  // scalars between two looks at the budget

// Counts work and polls the budget now and then.
class Pacer {
 public:
  explicit Pacer(const Budget& budget) : budget_(budget) {}

  std::optional<Error> spend(Count scalars) {
    spent_ += scalars;
    if (spent_ < kPollInterval) return std::nullopt;
    spent_ = 0;
    return budget_.poll();
  }

 private:
  const Budget& budget_;
  Count spent_ = kPollInterval;  // the first call polls: a dead caller costs nothing
};

// Three consecutive points around point i of a curve: the ends of `before` and `after` close a periodic
// curve.
struct Neighbours {
  Count before, after;
};
Neighbours neighbours_in_ring(Count points, Count i) {
  return {i == 0 ? points - 1 : i - 1, i + 1 == points ? 0 : i + 1};
}

// --- Subdivision ------------------------------------------------------------------------------------------

// c'_2i = (c_{i-1} + 6 c_i + c_{i+1}) / 8   [LaneRiesenfeld80; DeRose98, crease vertex (1/8, 3/4, 1/8)]
// Weights before sums: the intermediate values stay within the control points' range.
template <class Real>
Real vertex_point(Real before, Real self, Real after) {
  return (before * Real(0.125) + after * Real(0.125)) + self * Real(0.75);
}

// c'_2i+1 = (c_i + c_{i+1}) / 2   [LaneRiesenfeld80]
template <class Real>
Real edge_point(Real a, Real b) {
  return a * Real(0.5) + b * Real(0.5);
}

// One step of one curve. `from` holds whole points, `to` exactly refined_point_count(wrap, points, 1) of
// them.
//
//   pinned, periodic   to[2i] = vertex point i       to[2i+1] = edge point (i, i+1)
//   nonperiodic        to[2i-1] = vertex point i     to[2i]   = edge point (i, i+1): the outermost vertex
//                                                               points would need points that do not exist
template <class Real>
std::optional<Error> subdivide(CurveWrap wrap, Index width, std::span<const Real> from, std::span<Real> to,
                               Pacer& pacer) {
  const Count points = from.size() / width;
  const Count shift = wrap == CurveWrap::nonperiodic ? 1 : 0;
  for (Count i = 0; i < points; ++i) {
    if (auto stop = pacer.spend(width)) return stop;
    const bool last = i + 1 == points;
    const bool end = i == 0 || last;
    const Neighbours near = neighbours_in_ring(points, i);
    const Real* self = &from[i * width];
    const Real* before = &from[near.before * width];
    const Real* after = &from[near.after * width];
    if (!end || wrap != CurveWrap::nonperiodic) {
      Real* vertex = &to[(2 * i - shift) * width];
      const bool kept = end && wrap == CurveWrap::pinned;
      for (Index k = 0; k < width; ++k)
        vertex[k] = kept ? self[k] : vertex_point(before[k], self[k], after[k]);
    }
    if (!last || wrap == CurveWrap::periodic) {
      Real* edge = &to[(2 * i + 1 - shift) * width];
      for (Index k = 0; k < width; ++k) edge[k] = edge_point(self[k], after[k]);
    }
  }
  return std::nullopt;
}

// --- Limits -----------------------------------------------------------------------------------------------

// Calls visit(i, before, self, after) for every point of a refined curve; before or after is null where the
// curve ends.
template <class Real, class Visit>
std::optional<Error> for_each_point(CurveWrap wrap, Index width, std::span<const Real> points, Pacer& pacer,
                                    Visit&& visit) {
  const Count count = points.size() / width;
  const bool closed = wrap == CurveWrap::periodic;
  for (Count i = 0; i < count; ++i) {
    if (auto stop = pacer.spend(width)) return stop;
    const Neighbours near = neighbours_in_ring(count, i);
    visit(i, i > 0 || closed ? &points[near.before * width] : nullptr, &points[i * width],
          i + 1 < count || closed ? &points[near.after * width] : nullptr);
  }
  return std::nullopt;
}

// limit = (c_{i-1} + 4 c_i + c_{i+1}) / 6; the ends of open curves are their own limit (of a pinned curve
// because the phantom point makes it so).   [deBoor78]
template <class Real>
std::optional<Error> append_limits(CurveWrap wrap, Index width, std::span<const Real> points,
                                   std::vector<Real>& limits, Pacer& pacer) {
  return for_each_point<Real>(
      wrap, width, points, pacer, [&](Count, const Real* before, const Real* self, const Real* after) {
        constexpr Real kSide = Real(1.0 / 6), kSelf = Real(4.0 / 6);
        const bool inner = before != nullptr && after != nullptr;
        for (Index k = 0; k < width; ++k)
          limits.push_back(inner ? (before[k] * kSide + after[k] * kSide) + self[k] * kSelf : self[k]);
      });
}

// tangent = (c_{i+1} - c_{i-1}) / 2 per unit of the refined parameter, 2^level of which make one of the
// control parameter; at an end of an open curve the one-sided difference, which for a pinned curve is the
// same thing with the phantom point put in.
template <class Real>
std::optional<Error> append_tangents(CurveWrap wrap, Index width, Index level, std::span<const Real> points,
                                     std::vector<Real>& tangents, Pacer& pacer) {
  const Real scale = static_cast<Real>(Count{1} << level);
  return for_each_point<Real>(wrap, width, points, pacer,
                              [&](Count, const Real* before, const Real* self, const Real* after) {
                                const Real step = before != nullptr && after != nullptr ? scale / 2 : scale;
                                const Real* from = before != nullptr ? before : self;
                                const Real* to = after != nullptr ? after : self;
                                for (Index k = 0; k < width; ++k)
                                  tangents.push_back((to[k] - from[k]) * step);
                              });
}

// One curve through all its levels; false in `fits` when a control point is too large for Real.
template <class Real>
Result<std::vector<Real>> refine_one(const ControlCurves& curves, std::span<const double> control,
                                     Index level, Pacer& pacer) {
  std::vector<Real> current(control.size());
  for (Count k = 0; k < control.size(); ++k) {
    if (std::abs(control[k]) > static_cast<double>(std::numeric_limits<Real>::max())) return does_not_fit();
    current[k] = static_cast<Real>(control[k]);
  }
  std::vector<Real> next;
  for (Index l = 0; l < level; ++l) {
    const Count points = refined_point_count(curves.wrap, current.size() / curves.width, 1);
    next.resize(points * curves.width);
    if (auto stop = subdivide<Real>(curves.wrap, curves.width, current, next, pacer)) return *stop;
    current.swap(next);
  }
  return current;
}

template <class Real>
bool all_finite(const std::vector<Real>& values) {
  for (const Real value : values)
    if (!std::isfinite(value)) return false;
  return true;
}

Result<Count> total_points(const ControlCurves& curves, Index level) {
  if (level > kMaxCurveLevel)
    return Error{ErrorCode::out_of_range,
                 "level " + std::to_string(level) + " is over the maximum of " +
                     std::to_string(kMaxCurveLevel) + " for curves",
                 {},
                 level,
                 kMaxCurveLevel};
  Count total = 0;
  for (Count c = 0; c < curves.curve_count(); ++c) {
    total += refined_point_count(curves.wrap, curves.points_of_curve(c), level);
    if (total > kMaxIndexCount)
      return Error{ErrorCode::too_large,
                   "the refined curves would have more points than 32-bit indices can number: choose a "
                   "lower level",
                   {},
                   total,
                   kMaxIndexCount};
  }
  return total;
}

}  // namespace

Count refined_point_count(CurveWrap wrap, Count points, Index level) {
  const Count n = Count{1} << level;
  switch (wrap) {
    case CurveWrap::nonperiodic:
      return (points - 3) * n + 3;
    case CurveWrap::periodic:
      return points * n;
    case CurveWrap::pinned:
      break;
  }
  return (points - 1) * n + 1;
}

template <class Real>
Result<Count> predict_bytes(const ControlCurves& curves, const CurveOptions& options) {
  const Result<Count> points = total_points(curves, options.level);
  if (!points) return points;
  const Count arrays = 1 + (options.limit ? 1 : 0) + (options.tangents ? 1 : 0);
  // At most 2^32 points of 2^12 scalars in three arrays: 2^49 bytes, no overflow.
  return *points * curves.width * sizeof(Real) * arrays + curves.curve_count() * sizeof(Index);
}

template <class Real>
Result<RefinedCurves<Real>> refine(const ControlCurves& curves, const CurveOptions& options,
                                   const Budget& budget) {
  const Result<Count> bytes = predict_bytes<Real>(curves, options);
  if (!bytes) return bytes.error();
  if (auto allowed = budget.check_bytes(*bytes); !allowed) return allowed.error();

  RefinedCurves<Real> refined;
  refined.name = curves.name;
  refined.level = options.level;
  refined.width = curves.width;
  refined.wrap = curves.wrap;
  const Count scalars = *total_points(curves, options.level) * curves.width;
  refined.points.reserve(scalars);
  if (options.limit) refined.limit_points.reserve(scalars);
  if (options.tangents) refined.tangents.reserve(scalars);

  Pacer pacer(budget);
  const std::span<const double> control(curves.points);
  Count begin = 0;
  for (Count c = 0; c < curves.curve_count(); ++c) {
    const Count size = curves.points_of_curve(c) * curves.width;
    const auto points = refine_one<Real>(curves, control.subspan(begin, size), options.level, pacer);
    if (!points) return points.error();
    begin += size;
    refined.vertex_counts.push_back(static_cast<Index>(points->size() / curves.width));
    refined.points.insert(refined.points.end(), points->begin(), points->end());
    if (options.limit) {
      if (auto stop = append_limits<Real>(curves.wrap, curves.width, *points, refined.limit_points, pacer))
        return *stop;
    }
    if (options.tangents) {
      if (auto stop = append_tangents<Real>(curves.wrap, curves.width, options.level, *points,
                                            refined.tangents, pacer))
        return *stop;
    }
  }
  if (!all_finite(refined.points) || !all_finite(refined.limit_points) || !all_finite(refined.tangents))
    return does_not_fit();
  return refined;
}

template Result<Count> predict_bytes<float>(const ControlCurves&, const CurveOptions&);
template Result<Count> predict_bytes<double>(const ControlCurves&, const CurveOptions&);
template Result<RefinedCurves<float>> refine<float>(const ControlCurves&, const CurveOptions&, const Budget&);
template Result<RefinedCurves<double>> refine<double>(const ControlCurves&, const CurveOptions&,
                                                      const Budget&);
}  // namespace subdivd

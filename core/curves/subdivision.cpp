#include "core/curves/subdivision.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "core/base/all_finite.h"
#include "core/base/pace.h"
#include "core/base/precision.h"
#include "core/curves/block_refiner.h"
#include "core/curves/limit_pass.h"
#include "core/curves/piecewise.h"

namespace subdivd {
namespace {

// Whether all of them fit into Real.
template <class Real>
bool fits(std::span<const double> control, const Pace& pace) {
  if constexpr (sizeof(Real) == sizeof(double)) return true;
  const double largest = static_cast<double>(std::numeric_limits<Real>::max());
  bool all = true;
  pace.in_blocks(control.size(), [&](Count begin, Count end) {
    all = all && all_up_to(control.subspan(begin, end - begin), largest);
  });
  return all;
}

template <class Real>
bool finite(std::span<const Real> values, const Pace& pace) {
  bool all = true;
  pace.in_blocks(values.size(), [&](Count begin, Count end) {
    all = all && all_finite(values.subspan(begin, end - begin));
  });
  return all;
}

// The three arrays of one refined curve within the answer; null where they are not asked for.
template <class Real>
struct Target {
  Real *points, *limits, *tangents;
};

template <class Real>
Result<void> refine_one(const ControlCurves& curves, std::span<const double> control, const LimitMasks& masks,
                        Index level, const Budget& budget, const Pace& pace, Target<Real> to) {
  const Index width = curves.width;
  const Curve<Real> curve = curve_of<Real>(curves, control);
  const Count outer = curve.has_outer_ends() ? width : 0;
  BlockRefiner<Real> refiner(curve, core_of(curve, control), level);
  const Place n = refiner.count();
  const Count core_size = static_cast<Count>(n) * width, last = outer + core_size;
  if (auto done = refiner.run(budget, to.points + outer); !done) return done;
  LimitPass<Real> pass(curve, masks, level, to.points + outer, n);
  for (Real* ends_kept : {to.points, to.limits}) {
    if (ends_kept == nullptr || outer == 0) continue;
    std::copy_n(curve.ends.data(), width, ends_kept);
    std::copy_n(curve.ends.data() + width, width, ends_kept + last);
  }
  if (to.limits != nullptr) {
    if (auto done = pass.limits(budget, to.limits + outer); !done) return done;
    if (!finite(std::span<const Real>(to.limits, last + outer), pace)) return does_not_fit();
  }
  if (to.tangents != nullptr) {
    if (auto done = pass.tangents(budget, to.tangents + outer); !done) return done;
    if (outer != 0) pass.end_tangent(false, to.tangents), pass.end_tangent(true, to.tangents + last);
    if (!finite(std::span<const Real>(to.tangents, last + outer), pace)) return does_not_fit();
  }
  return {};
}

Result<Count> total_points(const ControlCurves& curves, Index level, const Pace& pace) {
  if (level > kMaxCurveLevel)
    return Error{.code = ErrorCode::out_of_range,
                 .message = "level " + std::to_string(level) + " is over the maximum of " +
                            std::to_string(kMaxCurveLevel) + " for curves",
                 .predicted = level,
                 .allowed = kMaxCurveLevel};
  // No overflow: at most 2^32 points, 2^24 times as many each.
  const Count total = total_point_count(curves, level, pace);
  if (total <= kMaxIndexCount) return total;
  return Error{
      .code = ErrorCode::too_large,
      .message =
          "the refined curves would have more points than 32-bit indices can number: choose a lower level",
      .predicted = total,
      .allowed = kMaxIndexCount};
}

}  // namespace

Count total_point_count(const ControlCurves& curves, Index level, const Pace& pace) {
  if (!is_subdivided(curves.basis)) return refined_piecewise_count(curves, level, pace);
  Count total = 0;
  pace.for_each(curves.curve_count(),
                [&](Count c) { total += refined_point_count(curves, curves.points_of_curve(c), level); });
  return total;
}

Count refined_point_count(const ControlCurves& curves, Count points, Index level) {
  const CurveSplit split = split_of(curves);
  const Count n = Count{1} << level;
  switch (curves.wrap) {
    case CurveWrap::nonperiodic:
      return (points - split.lost) * n + split.lost;
    case CurveWrap::periodic:
      return points * n;
    case CurveWrap::pinned:
      break;
  }
  const Count ends = split.dual ? 2 : 1;
  return (points - ends) * n + ends;
}

Count refined_point_count(CurveWrap wrap, Count points, Index level) {
  ControlCurves cubic;
  cubic.wrap = wrap;
  return refined_point_count(cubic, points, level);
}

double point_parameter(const ControlCurves& curves, Count points, Index level, Count point) {
  const CurveSplit split = split_of(curves);
  const double h = std::ldexp(1.0, -static_cast<int>(level)), j = static_cast<double>(point);
  if (curves.wrap == CurveWrap::nonperiodic) return j * h + (split.lost - 1.0) / 2 * (1 - h);
  if (!split.dual) return j * h;
  if (curves.wrap == CurveWrap::periodic) return (j + 0.5) * h - 0.5;
  if (point == 0) return 0;
  if (point + 1 == refined_point_count(curves, points, level)) return static_cast<double>(points - 2);
  return (j - 0.5) * h;
}

template <class Real>
Result<Count> predict_bytes(const ControlCurves& curves, const CurveOptions& options, const Budget& budget) {
  const Result<Count> points =
      stoppable(budget, [&](const Pace& pace) { return total_points(curves, options.level, pace); });
  if (!points) return points;
  const Count arrays = 1 + (options.limit ? 1 : 0) + (options.tangents ? 1 : 0);
  // At most 2^32 points of 2^12 scalars in three arrays: 2^49 bytes, no overflow.
  Count bytes = *points * curves.width * sizeof(Real) * arrays + curves.curve_count() * sizeof(Index);
  // Knots and weights, the curve in doubles before it is converted, and its pieces.
  if (!is_subdivided(curves.basis)) bytes += *points * (curves.width * (arrays + 2) + 12) * sizeof(double);
  return bytes;
}

namespace {

template <class Real, class To>
bool convert(const std::vector<double>& from, To& to, const Pace& pace) {
  to.reserve(from.size());
  bool fine = true;
  pace.for_each(from.size(), [&](Count k) {
    to.push_back(static_cast<Real>(from[k]));
    fine &= std::isfinite(to[k]);
  });
  return fine;
}

template <class Real>
Result<RefinedCurves<Real>> refine_by_pieces(const ControlCurves& curves, const CurveOptions& options,
                                             const Budget& budget, const Pace& pace) {
  auto pieces = refine_piecewise(curves, options, budget);
  if (!pieces) return std::move(pieces).error();
  RefinedCurves<Real> refined;
  refined.name = curves.name;
  refined.level = options.level;
  refined.width = curves.width;
  refined.wrap = CurveWrap::nonperiodic;
  refined.basis = std::move(pieces->basis);
  refined.vertex_counts = std::move(pieces->vertex_counts);
  if (!convert<Real>(pieces->points, refined.points, pace) ||
      !convert<Real>(pieces->limit_points, refined.limit_points, pace) ||
      !convert<Real>(pieces->tangents, refined.tangents, pace))
    return does_not_fit();
  return refined;
}

template <class Real>
Result<RefinedCurves<Real>> refine_by_steps(const ControlCurves& curves, const CurveOptions& options,
                                            const Budget& budget, const Pace& pace) {
  const std::span<const double> control(curves.points);
  if (!fits<Real>(control, pace)) return does_not_fit();

  RefinedCurves<Real> refined;
  refined.name = curves.name;
  refined.level = options.level;
  refined.width = curves.width;
  refined.wrap = curves.wrap;
  refined.basis = curves.basis;
  const Count scalars = total_point_count(curves, options.level, pace) * curves.width;
  refined.points.resize(scalars);
  if (options.limit) refined.limit_points.resize(scalars);
  if (options.tangents) refined.tangents.resize(scalars);
  refined.vertex_counts.reserve(curves.curve_count());

  const LimitMasks masks = masks_of(curves);
  Count begin = 0, out = 0;
  for (Count c = 0; c < curves.curve_count(); ++c) {
    const Count points = curves.points_of_curve(c), size = points * curves.width;
    const Target<Real> to{refined.points.data() + out,
                          options.limit ? refined.limit_points.data() + out : nullptr,
                          options.tangents ? refined.tangents.data() + out : nullptr};
    const auto done =
        refine_one<Real>(curves, control.subspan(begin, size), masks, options.level, budget, pace, to);
    if (!done) return done.error();
    const Count count = refined_point_count(curves, points, options.level);
    refined.vertex_counts.push_back(static_cast<Index>(count));
    begin += size;
    out += count * curves.width;
  }
  return refined;
}

}  // namespace

template <class Real>
Result<RefinedCurves<Real>> refine(const ControlCurves& curves, const CurveOptions& options,
                                   const Budget& budget) {
  const Result<Count> bytes = predict_bytes<Real>(curves, options, budget);
  if (!bytes) return bytes.error();
  if (auto allowed = budget.check_bytes(*bytes); !allowed) return allowed.error();
  return stoppable(budget, [&](const Pace& pace) {
    pace.spend(Pace::kBlock);  // a dead caller costs nothing
    return is_subdivided(curves.basis) ? refine_by_steps<Real>(curves, options, budget, pace)
                                       : refine_by_pieces<Real>(curves, options, budget, pace);
  });
}

template Result<Count> predict_bytes<float>(const ControlCurves&, const CurveOptions&, const Budget&);
template Result<Count> predict_bytes<double>(const ControlCurves&, const CurveOptions&, const Budget&);
template Result<RefinedCurves<float>> refine<float>(const ControlCurves&, const CurveOptions&, const Budget&);
template Result<RefinedCurves<double>> refine<double>(const ControlCurves&, const CurveOptions&,
                                                      const Budget&);
}  // namespace subdivd

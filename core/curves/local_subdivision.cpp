#include "core/curves/local_subdivision.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/base/all_finite.h"
#include "core/base/overloaded.h"
#include "core/base/precision.h"
#include "core/curves/curve_window.h"
#include "core/splines/measurement.h"

namespace subdivd {
namespace {

// --- Where ------------------------------------------------------------------------------------------------

// 0 <= share <= 1 as the halves that lead to it, `length` of them: bit 0 of `turns` is the last one, 1 the
// right half; those that 64 bits do not hold are left ones. After them the share is 0, or 1 where it was.
struct Path {
  std::uint64_t turns = 0;
  int length = 0;
  bool at_end = false;
};

Path path_to(double share) {
  if (share == 0 || share == 1) return {0, 0, share == 1};
  int exponent = 0;
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::frexp(share, &exponent), 53));
  const int unused = std::countr_zero(mantissa);
  return {mantissa >> unused, 53 - unused - exponent, false};
}

// The points first, first + 1, ... that t depends on, and t's way within their cell. Shares of a dual curve
// that is not pinned are t + 1/2, which a double may not hold: their first half is kept apart.
struct Cell {
  Place first = 0;
  Path path;
  std::optional<Index> first_turn;  // 0 left, 1 right, before those of `path`
};

Cell cell_of(const SubdividedCurve& curve, double t) {
  const bool four_point = std::holds_alternative<FourPoint>(curve.scheme);
  // The domain's end is the end of the cell before, and so is its derivative. Where nothing has a
  // kink the begin of the one behind serves as well: it gives points that do not exist the weight 0.
  const bool at_end = t == curve.end();
  const double whole = std::floor(t), share = t - whole;
  const Place at = static_cast<Place>(whole);
  if (four_point || curve.rule->wrap == CurveWrap::pinned) {
    const Place before = four_point ? 2 : 1;
    return at_end ? Cell{at - 1 - before, path_to(1), {}} : Cell{at - before, path_to(share), {}};
  }
  if (share < 0.5) return {at - 1, path_to(2 * share), 1u};
  return {at, path_to(2 * share - 1), 0u};
}

// --- What weights -----------------------------------------------------------------------------------------

// Of one cell: weights of its points and, for the derivative, of the differences of neighbours times 2 per
// level. A scheme tells those at either end of a cell and how a half's weights become those of the whole. A
// point's weight is divided among its parents so that the parts add up to it but for one rounding each: 1 - r
// or 1/2 + w, rounded once for all, would push the sum the same way at every step.
template <Index kPoints>
struct Weights {
  static constexpr Index kCount = kPoints;
  std::array<double, kPoints> points{};
  std::array<double, kPoints - 1> slopes{};
};

struct FourPointCell {
  double w;

  using Weights = subdivd::Weights<6>;
  static constexpr Index kBegin = 2;  // which of the points the cell begins at

  // tangent = ((1 - 2w) (q_{-1} + q_0) - 2w (q_{-2} + q_1)) / (2 (1 - 4w)) of differences q_k = c_{k+1} -
  // c_k: FourPoint::limit_masks()
  Weights at(bool end) const {
    Weights weights;
    const Index here = kBegin + (end ? 1 : 0);
    weights.points[here] = 1;
    if (w == 0) {
      weights.slopes[kBegin] = 1;
      return weights;
    }
    const double a = 1 / (2 * (1 - 4 * w));
    weights.slopes[here - 2] = weights.slopes[here + 1] = -2 * w * a;
    weights.slopes[here - 1] = weights.slopes[here] = (1 - 2 * w) * a;
    return weights;
  }

  // Child 2i is c_i, child 2i + 1 is (1/2 + w) (c_i + c_{i+1}) - w (c_{i-1} + c_{i+2}), and of differences
  //   q_2i = q_i + 2w (q_{i-1} - q_{i+1}),   q_{2i+1} = q_i - 2w (q_{i-1} - q_{i+1})
  Weights of_whole(const Weights& half, Index right) const {
    Weights whole;
    for (Index k = 0; k < 6; ++k) {
      const Index child = right + k, parent = 1 + child / 2;  // child kBegin is that of point kBegin
      if (child % 2 == 0) {
        whole.points[parent] += half.points[k];
        continue;
      }
      const double outer = w * half.points[k], inner = 0.5 * half.points[k] + outer;
      whole.points[parent] += inner;
      whole.points[parent + 1] += inner;
      whole.points[parent - 1] -= outer;
      whole.points[parent + 2] -= outer;
    }
    for (Index k = 0; k < 5; ++k) {
      const Index child = right + k, parent = 1 + child / 2;
      const double across = (child % 2 == 0 ? 2 : -2) * w * half.slopes[k];
      whole.slopes[parent] += half.slopes[k];
      whole.slopes[parent - 1] += across;
      whole.slopes[parent + 1] -= across;
    }
    return whole;
  }
};

struct CornerCuttingCell {
  double r;

  using Weights = subdivd::Weights<3>;

  Weights at(bool end) const {
    Weights weights;
    const Index edge = end ? 1 : 0;
    weights.points[edge] = weights.points[edge + 1] = 0.5;
    weights.slopes[edge] = 1;
    return weights;
  }

  // Children 2m - 1, ..., 2m + 2 of c_{m-1}, c_m, c_{m+1}, of which either half takes three:
  //   (1-r) c_{m-1} + r c_m,   r c_{m-1} + (1-r) c_m,   (1-r) c_m + r c_{m+1},   r c_m + (1-r) c_{m+1}
  // and their differences, times 2:  2 (1-2r) q_0,  2r (q_0 + q_1),  2 (1-2r) q_1
  Weights of_whole(const Weights& half, Index right) const {
    Weights whole;
    for (Index k = 0; k < 3; ++k) {
      const Index child = right + k, edge = child / 2;
      const double far = r * half.points[k], near = half.points[k] - far;
      whole.points[edge] += child % 2 == 0 ? near : far;
      whole.points[edge + 1] += child % 2 == 0 ? far : near;
    }
    const double corner = 2 * r * half.slopes[1 - right];
    whole.slopes[right] = 2 * (1 - 2 * r) * half.slopes[right];
    whole.slopes[0] += corner;
    whole.slopes[1] += corner;
    return whole;
  }
};

// From the last half outwards: one row of weights, however wide the points are.
template <class Scheme>
typename Scheme::Weights weights_at(const Scheme& scheme, const Cell& cell) {
  typename Scheme::Weights weights = scheme.at(cell.path.at_end);
  std::uint64_t turns = cell.path.turns;
  for (int step = 0; step < cell.path.length; ++step, turns >>= 1)
    weights = scheme.of_whole(weights, static_cast<Index>(turns & 1));
  return cell.first_turn ? scheme.of_whole(weights, *cell.first_turn) : weights;
}

// --- Points -----------------------------------------------------------------------------------------------

// Weighted are the differences from the point with the largest weight: what is equal stays equal. `unit` 1,
// or 1/2 where differences outgrow a double.
template <class Weights>
void combine(const Weights& weights, const double* points, Index width, double unit, bool with_slopes,
             std::span<double> rows) {
  const auto nearest = std::ranges::max_element(weights.points) - weights.points.begin();
  const double* base = points + nearest * static_cast<std::ptrdiff_t>(width);
  for (Index x = 0; x < width; ++x) {
    double moved = 0, slope = 0;
    for (Index k = 0; k < Weights::kCount; ++k)
      moved += weights.points[k] * (points[k * width + x] * unit - base[x] * unit);
    rows[x] = (base[x] * unit + moved) / unit;
    if (!with_slopes) continue;
    for (Index k = 0; k + 1 < Weights::kCount; ++k)
      slope += weights.slopes[k] * (points[(k + 1) * width + x] * unit - points[k * width + x] * unit);
    rows[width + x] = slope / unit;
  }
}

template <class Scheme>
Result<void> evaluate(const Scheme& scheme, const SubdividedCurve& curve, double t, Index order,
                      std::span<double> rows) {
  const Cell cell = cell_of(curve, t);
  const auto weights = weights_at(scheme, cell);
  const Curve<double> whole = curve_of<double>(*curve.rule, curve.points);
  const std::span<const double> core = core_of(whole, curve.points);
  Window<double> window;
  const Place count = Scheme::Weights::kCount;
  load(whole, core.data(), static_cast<Place>(core.size() / whole.width), {cell.first, cell.first + count},
       window);
  for (const double unit : {1.0, 0.5}) {
    combine(weights, window.at(cell.first, whole.width), whole.width, unit, order > 0, rows);
    if (all_finite(std::span<const double>(rows))) return {};
  }
  return does_not_fit();
}

Result<void> check_order(const LocalScheme& scheme, Index order) {
  if (order > 1)
    return refusal(ErrorCode::unsupported,
                   "four-point and corner-cutting curves have no derivatives of order " +
                       std::to_string(order) + "; ask for the first at most",
                   {"order"});
  const CornerCutting* cutting = std::get_if<CornerCutting>(&scheme);
  if (order == 1 && cutting != nullptr && !cutting->is_quadratic_bspline())
    return refusal(
        ErrorCode::unsupported,
        "a corner-cutting curve has a derivative by its parameter for the ratio 1/4 only: for others "
        "it would be 0 or infinite; ask for points alone",
        {"order"});
  return {};
}

}  // namespace

double SubdividedCurve::begin() const {
  const CurveSplit split = split_of(*rule);
  if (rule->wrap == CurveWrap::nonperiodic) return (split.lost - 1.0) / 2;
  return rule->wrap == CurveWrap::periodic && split.dual ? -0.5 : 0;
}

double SubdividedCurve::end() const {
  const auto count = static_cast<double>(point_count());
  if (rule->wrap == CurveWrap::nonperiodic) return count - 1 - begin();
  if (rule->wrap == CurveWrap::periodic) return count + begin();
  return count - (split_of(*rule).dual ? 2 : 1);
}

Result<SubdividedCurve> subdivided_curve(const ControlCurves& curves, Count curve, CurvePlace place) {
  const Count width = curves.width;
  const auto points =
      std::span(curves.points).subspan(place.points * width, curves.points_of_curve(curve) * width);
  const auto with = [&](const LocalScheme& scheme) -> Result<SubdividedCurve> {
    return SubdividedCurve{.rule = &curves, .scheme = scheme, .points = points};
  };
  const auto refuse = [] {
    return Result<SubdividedCurve>(
        refusal(ErrorCode::unsupported,
                "only four-point and corner-cutting curves are evaluated by subdivision; others are splines",
                {"basis"}));
  };
  return std::visit(
      Overloaded{[&](const FourPoint& kind) { return with(kind); },
                 [&](const CornerCutting& kind) { return with(kind); },
                 [&](const UniformBSpline&) { return refuse(); },
                 [&](const PiecewiseKind auto&) { return refuse(); }, [&](const Nurbs&) { return refuse(); }},
      curves.basis);
}

Result<void> derivatives(const SubdividedCurve& curve, double t, Index order, std::span<double> rows) {
  if (auto checked = check_order(curve.scheme, order); !checked) return checked;
  assert(rows.size() == (Count{order} + 1) * curve.dimension());
  // A line over the same domain takes the same parameters.
  const double begin = curve.begin(), end = curve.end();
  const bool periodic = curve.rule->wrap == CurveWrap::periodic;
  const Result<double> parameter =
      check_parameter(Spline{1, 1, false, periodic, {begin, begin, end, end}, {0, 0}}, t);
  if (!parameter) {
    Error error = parameter.error();
    error.where = {"t"};
    return error;
  }
  return std::visit(Overloaded{[&](const FourPoint& kind) {
                                 return evaluate(FourPointCell{kind.tension}, curve, *parameter, order, rows);
                               },
                               [&](const CornerCutting& kind) {
                                 return evaluate(CornerCuttingCell{kind.ratio}, curve, *parameter, order,
                                                 rows);
                               }},
                    curve.scheme);
}

}  // namespace subdivd

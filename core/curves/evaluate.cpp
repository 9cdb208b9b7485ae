// Localized evaluation: a uniform cubic curve at any parameter from at most four control points.

#include <algorithm>
#include <array>
#include <cmath>

#include "core/curves/precision.h"
#include "core/curves/subdivision.h"

namespace subdivd {
namespace {

// --- The basis --------------------------------------------------------------------------------------------

struct Basis {
  std::array<double, 4> value, slope;  // of c_{i-1}, c_i, c_{i+1}, c_{i+2}
};

// The four uniform cubic B-splines on a span, 0 <= u <= 1 from c_i to c_{i+1}:
//   ( (1-u)^3, 3u^3 - 6u^2 + 4, -3u^3 + 3u^2 + 3u + 1, u^3 ) / 6     [deBoor78, chapter IX]
Basis basis_inside(double u) {
  const double w = 1 - u;
  return {{w * w * w / 6, ((3 * u - 6) * u * u + 4) / 6, ((3 * w - 6) * w * w + 4) / 6, u * u * u / 6},
          {-w * w / 2, (3 * u - 4) * u / 2, -(3 * w - 4) * w / 2, u * u / 2}};
}

// The first span of a pinned curve: c_{-1} = 2 c_0 - c_1 folded into the weights of c_0 and c_1, which makes
// the curve begin exactly at c_0:  (0, u^3 - 6u + 6, 6u - 2u^3, u^3) / 6.
Basis basis_at_begin(double u) {
  const double cube = u * u * u, square = u * u;
  return {{0, 1 - u + cube / 6, u - cube / 3, cube / 6}, {0, square / 2 - 1, 1 - square, square / 2}};
}

Basis reversed(const Basis& b) {
  return {{b.value[3], b.value[2], b.value[1], b.value[0]},
          {-b.slope[3], -b.slope[2], -b.slope[1], -b.slope[0]}};
}

// A pinned curve of two points has a phantom point on either side and is the straight line.
Basis basis_of_line(double u) { return {{0, 1 - u, u, 0}, {0, -1, 1, 0}}; }

// Where a parameter falls: span i from c_i to c_{i+1}, 0 <= u <= 1.
struct Place {
  Count span;
  double u;
};

Place place_in(double t, Count last_span) {
  const Count span = std::min(static_cast<Count>(t), last_span);
  return {span, t - static_cast<double>(span)};
}

// t by the period `points`; exact for every finite t, and below `points` even when t is a hair under 0.
double wrapped(double t, Count points) {
  const double period = static_cast<double>(points);
  double rest = std::fmod(t, period);
  if (rest < 0) rest += period;
  return rest < period ? rest : 0;
}

Result<double> check_parameter(CurveWrap wrap, Count points, double t) {
  if (!std::isfinite(t)) return Error{ErrorCode::not_finite, "the parameter is not a finite number", {}};
  if (wrap == CurveWrap::periodic) return wrapped(t, points);
  const double low = wrap == CurveWrap::pinned ? 0 : 1;
  const double high = static_cast<double>(points) - (wrap == CurveWrap::pinned ? 1 : 2);
  if (t >= low && t <= high) return t;
  return Error{ErrorCode::out_of_range,
               "the parameter " + std::to_string(t) + " lies outside the curve's domain, " +
                   std::to_string(static_cast<Count>(low)) + " to " +
                   std::to_string(static_cast<Count>(high)),
               {}};
}

Basis basis_at(CurveWrap wrap, Count points, Place place) {
  if (wrap != CurveWrap::pinned) return basis_inside(place.u);
  const bool first = place.span == 0, last = place.span + 2 == points;
  if (first && last) return basis_of_line(place.u);
  if (first) return basis_at_begin(place.u);
  if (last) return reversed(basis_at_begin(1 - place.u));
  return basis_inside(place.u);
}

// The points that the four weights belong to. A neighbour that does not exist (its weight is 0) is replaced
// by one that does.
std::array<Count, 4> supports(CurveWrap wrap, Count points, Count span) {
  if (wrap == CurveWrap::periodic)
    return {(span + points - 1) % points, span, (span + 1) % points, (span + 2) % points};
  return {span == 0 ? 0 : span - 1, span, span + 1, std::min(span + 2, points - 1)};
}

}  // namespace

template <class Real>
Result<void> evaluate(const ControlCurves& curves, Index curve, double t, std::span<Real> point,
                      std::span<Real> derivative) {
  assert(point.size() == curves.width && (derivative.empty() || derivative.size() == curves.width));
  if (curve >= curves.curve_count())
    return Error{
        ErrorCode::out_of_range,
        "there is no curve " + std::to_string(curve) + "; there are " + std::to_string(curves.curve_count()),
        {}};
  Count first = 0;
  for (Index c = 0; c < curve; ++c) first += curves.vertex_counts[c];
  const Count points = curves.points_of_curve(curve);
  const Result<double> parameter = check_parameter(curves.wrap, points, t);
  if (!parameter) return parameter.error();

  const bool open = curves.wrap != CurveWrap::periodic;
  const Count last_span = open ? points - (curves.wrap == CurveWrap::pinned ? 2 : 3) : points - 1;
  const Place place = place_in(*parameter, last_span);
  const Basis basis = basis_at(curves.wrap, points, place);
  const std::array<Count, 4> support = supports(curves.wrap, points, place.span);
  for (Index k = 0; k < curves.width; ++k) {
    double value = 0, slope = 0;
    for (std::size_t b = 0; b < 4; ++b) {
      const double c = curves.points[(first + support[b]) * curves.width + k];
      value += basis.value[b] * c;
      slope += basis.slope[b] * c;
    }
    point[k] = static_cast<Real>(value);
    if (!derivative.empty()) derivative[k] = static_cast<Real>(slope);
    if (!std::isfinite(point[k]) || (!derivative.empty() && !std::isfinite(derivative[k])))
      return does_not_fit();
  }
  return {};
}

template Result<void> evaluate<float>(const ControlCurves&, Index, double, std::span<float>,
                                      std::span<float>);
template Result<void> evaluate<double>(const ControlCurves&, Index, double, std::span<double>,
                                       std::span<double>);

}  // namespace subdivd

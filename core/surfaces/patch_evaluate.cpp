#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/precision.h"
#include "core/base/text_of.h"
#include "core/surfaces/patch.h"
#include "core/surfaces/patch_rules.h"

namespace subdivd {
namespace {

// Weights of up to four consecutive points, of their first and second derivatives, and where the points are.
struct Basis {
  std::array<double, 4> value, slope, bend;
  std::array<Count, 4> at;
};

Basis reverse(Basis b) {
  std::reverse(b.value.begin(), b.value.end());
  std::reverse(b.slope.begin(), b.slope.end());
  std::reverse(b.bend.begin(), b.bend.end());
  for (double& slope : b.slope) slope = -slope;
  return b;
}

// Cubic, 0 <= s <= 1 from c_i to c_{i+1}:  ( (1-s)^3, 3s^3 - 6s^2 + 4, -3s^3 + 3s^2 + 3s + 1, s^3 ) / 6
// and on the first span of a pinned direction, c_{-1} = 2 c_0 - c_1 put in,
//                                          ( 0, s^3 - 6s + 6, 6s - 2s^3, s^3 ) / 6     [deBoor78]
Basis cubic_inside(double s) {
  const double w = 1 - s;
  return {{w * w * w / 6, ((3 * s - 6) * s * s + 4) / 6, ((3 * w - 6) * w * w + 4) / 6, s * s * s / 6},
          {-w * w / 2, (3 * s - 4) * s / 2, -(3 * w - 4) * w / 2, s * s / 2},
          {w, 3 * s - 2, 3 * w - 2, s},
          {}};
}
Basis cubic_at_begin(double s) {
  const double cube = s * s * s, square = s * s;
  return {{0, 1 - s + cube / 6, s - cube / 3, cube / 6},
          {0, square / 2 - 1, 1 - square, square / 2},
          {0, s, -2 * s, s},
          {}};
}
Basis line(double s) { return {{0, 1 - s, s, 0}, {0, -1, 1, 0}, {0, 0, 0, 0}, {}}; }

// Quadratic, 0 <= s <= 1 from half a unit before c_i to half a unit behind it:
//   ( (1-s)^2, 1 + 2s - 2s^2, s^2 ) / 2                  for c_{i-1}, c_i, c_{i+1}
//   ( 2 (1-s)^2, 4s - 3s^2, s^2 ) / 2                    beside a pinned border: 2 c_0 - c_1 put in
//   ( (1-s)^2, 2 s (1-s), s^2 )                          between two of them, which is Bezier's
// The fourth weight is 0.
Basis quadratic_inside(double s) {
  const double w = 1 - s;
  return {{w * w / 2, 0.5 + s * w, s * s / 2, 0}, {-w, w - s, s, 0}, {1, -2, 1, 0}, {}};
}
Basis quadratic_at_begin(double s) {
  const double w = 1 - s;
  return {{w * w, (2 - 1.5 * s) * s, s * s / 2, 0}, {-2 * w, 2 - 3 * s, s, 0}, {2, -3, 1, 0}, {}};
}
Basis quadratic_at_end(double s) {
  Basis b = reverse(quadratic_at_begin(1 - s));  // its weight of 0 came to the front
  for (std::array<double, 4>* row : {&b.value, &b.slope, &b.bend})
    std::rotate(row->begin(), row->begin() + 1, row->end());
  return b;
}
Basis quadratic_between(double s) {
  const double w = 1 - s;
  return {{w * w, 2 * s * w, s * s, 0}, {-2 * w, 2 - 4 * s, 2 * s, 0}, {2, -4, 2, 0}, {}};
}

// t by the period n; exact for every finite t, and below n even when t is a hair under 0.
double wrapped(double t, Count n) {
  const double period = static_cast<double>(n);
  double rest = std::fmod(t, period);
  if (rest < 0) rest += period;
  return rest < period ? rest : 0;
}

Result<double> parameter_of(const Direction& d, double t, const char* name) {
  if (!std::isfinite(t))
    return Error{
        ErrorCode::not_finite, std::string("the parameter ") + name + " is not a finite number", {name}};
  if (!d.open()) return wrapped(t, d.n);
  const double low = d.wrap == CurveWrap::pinned ? 0 : d.degree == 2 ? 0.5 : 1;
  const double high = static_cast<double>(d.n) - (d.pinned_quadratic() ? 2 : 1 + low);
  if (t >= low && t <= high) return t;
  return Error{ErrorCode::out_of_range,
               std::string("the parameter ") + name + " = " + text_of(t) +
                   " lies outside the surface's domain, " + text_of(low) + " to " + text_of(high),
               {name}};
}

Basis cubic_basis(const Direction& d, double t) {
  const Count last_span = d.open() ? d.n - (d.wrap == CurveWrap::pinned ? 2 : 3) : d.n - 1;
  const Count span = std::min(static_cast<Count>(t), last_span);
  const double s = t - static_cast<double>(span);
  const bool pinned = d.wrap == CurveWrap::pinned;
  const bool first = pinned && span == 0, last = pinned && span == last_span;
  Basis b = first && last ? line(s)
            : first       ? cubic_at_begin(s)
            : last        ? reverse(cubic_at_begin(1 - s))
                          : cubic_inside(s);
  // A neighbour that an open direction lacks has weight 0: any other stands for it.
  b.at = {d.before(span), span, d.after(span), d.after(d.after(span))};
  return b;
}

Basis quadratic_basis(const Direction& d, double t) {
  const double x = d.wrap == CurveWrap::pinned ? t + 1 : t + 0.5;  // span i begins at x = i
  Count i = static_cast<Count>(x);
  if (d.open()) i = std::min(i, d.n - 2);
  const double s = x - static_cast<double>(i);
  if (i == d.n) i = 0;
  const bool first = d.wrap == CurveWrap::pinned && i == 1,
             last = d.wrap == CurveWrap::pinned && i + 2 == d.n;
  Basis b = first && last ? quadratic_between(s)
            : first       ? quadratic_at_begin(s)
            : last        ? quadratic_at_end(s)
                          : quadratic_inside(s);
  b.at = {d.before(i), i, d.after(i), i};
  return b;
}

Basis basis_at(const Direction& d, double t) {
  return d.degree == 2 ? quadratic_basis(d, t) : cubic_basis(d, t);
}

// Component k of the point and of the five derivatives, in the order of PatchSample.
std::array<double, 6> component(const ControlPatch& patch, const Basis& u, const Basis& v, Index k) {
  std::array<double, 6> sum{};
  for (std::size_t b = 0; b < 4; ++b) {
    double value = 0, slope = 0, bend = 0;
    for (std::size_t a = 0; a < 4; ++a) {
      const double c = patch.points[(v.at[b] * patch.u_count + u.at[a]) * patch.width + k];
      value += u.value[a] * c, slope += u.slope[a] * c, bend += u.bend[a] * c;
    }
    sum[0] += v.value[b] * value, sum[1] += v.value[b] * slope, sum[2] += v.slope[b] * value;
    sum[3] += v.value[b] * bend, sum[4] += v.slope[b] * slope, sum[5] += v.bend[b] * value;
  }
  return sum;
}

}  // namespace

template <class Real>
Result<PatchSample<Real>> evaluate(const ControlPatch& patch, double u, double v) {
  const Direction across = u_of(patch), along = v_of(patch);
  const Result<double> s = parameter_of(across, u, "u"), t = parameter_of(along, v, "v");
  if (!s) return s.error();
  if (!t) return t.error();
  const Basis u_basis = basis_at(across, *s), v_basis = basis_at(along, *t);
  PatchSample<Real> sample;
  const std::array<std::vector<Real>*, 6> rows = {&sample.point, &sample.du,  &sample.dv,
                                                  &sample.duu,   &sample.duv, &sample.dvv};
  for (auto* row : rows) row->resize(patch.width);
  for (Index k = 0; k < patch.width; ++k) {
    const std::array<double, 6> sums = component(patch, u_basis, v_basis, k);
    for (std::size_t r = 0; r < 6; ++r) {
      // The sum is looked at before it is made narrower: a double too large for Real must not be converted.
      if (!(std::abs(sums[r]) <= static_cast<double>(std::numeric_limits<Real>::max())))
        return does_not_fit();
      (*rows[r])[k] = static_cast<Real>(sums[r]);
    }
  }
  if (patch.width == 3)
    sample.normal = normal_of<Real>(sample.point.data(), sample.du.data(), sample.dv.data(), 0);
  return sample;
}

template Result<PatchSample<float>> evaluate<float>(const ControlPatch&, double, double);
template Result<PatchSample<double>> evaluate<double>(const ControlPatch&, double, double);

}  // namespace subdivd

#include "core/surfaces/patch_rules.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace subdivd {
namespace {

Taps keep(Count i) { return {{i, i, i}, {0, 0, 1}}; }

}  // namespace

// Point i of the next level: the rules of the header. Numbering:
//
//   cubic, pinned or periodic   [2j] = vertex point j      [2j+1] = edge point (j, j+1)
//   cubic, nonperiodic          [2j-1] = vertex point j    [2j]   = edge point (j, j+1)
//   quadratic, periodic         [2j], [2j+1] = a quarter of the way from point j to the one before, behind it
//   quadratic, open             the same less the first and the last one: [2j-1], [2j]
//
// Pinned quadratic: beside the border the phantom point 2 c_0 - c_1 makes (c_0 + c_1) / 2 of what would stand
// a quarter of the way from c_1 to it, and c_0 stays in the place of the point that has no part in the
// surface.
Taps step_taps(const Direction& d, Count i) {
  if (d.degree == 3) {
    const Count k = i + (d.wrap == CurveWrap::nonperiodic ? 1 : 0), j = k / 2;
    if (k % 2 == 1) return {{j, d.after(j), j}, {1.0 / 2, 1.0 / 2, 0}};
    if (d.ends_at(j)) return keep(j);
    return {{d.before(j), d.after(j), j}, {1.0 / 8, 1.0 / 8, 3.0 / 4}};
  }
  const Count k = i + (d.open() ? 1 : 0), near = k / 2;
  const Count far = k % 2 == 0 ? d.before(near) : d.after(near);
  if (d.wrap == CurveWrap::pinned) {
    if (d.ends_at(near)) return keep(near);
    if (d.ends_at(far)) return {{near, far, near}, {1.0 / 2, 1.0 / 2, 0}};
  }
  return {{near, far, near}, {3.0 / 4, 1.0 / 4, 0}};
}

// Limit of point i. At the ends of an open direction the point itself: of pinned ones the phantom point makes
// it so.   cubic (1, 4, 1) / 6   quadratic (1, 6, 1) / 8, and with the phantom point put in for d_{-1}, which
// is 2 c_0 - d_0, (2, 5, 1) / 8 beside a pinned border   [deBoor78]
Taps limit_taps(const Direction& d, Count i) {
  if (d.ends_at(i)) return keep(i);
  const Count before = d.before(i), after = d.after(i);
  if (d.degree == 3) return {{before, after, i}, {1.0 / 6, 1.0 / 6, 4.0 / 6}};
  const double b = d.pinned_quadratic() && d.ends_at(before) ? 2.0 / 8 : 1.0 / 8;
  const double a = d.pinned_quadratic() && d.ends_at(after) ? 2.0 / 8 : 1.0 / 8;
  return {{before, after, i}, {b, a, 1 - (b + a)}};
}

// Tangent at point i per unit of this level's parameter: (c_{i+1} - c_{i-1}) / 2; at the ends of an open
// direction the one-sided difference, over half a unit where a pinned quadratic border is no more away.
// Beside such a border (d_1 - (2 c_0 - d_0)) / 2.
Taps tangent_taps(const Direction& d, Count i) {
  if (d.ends_at(i)) {
    const Count inner = i == 0 ? 1 : i - 1;
    const double weight = (i == 0 ? 1 : -1) * (d.pinned_quadratic() ? 2.0 : 1.0);
    return {{inner, i, i}, {weight, -weight, 0}};
  }
  const Count before = d.before(i), after = d.after(i);
  const double b = d.pinned_quadratic() && d.ends_at(before) ? -1.0 : -1.0 / 2;
  const double a = d.pinned_quadratic() && d.ends_at(after) ? 1.0 : 1.0 / 2;
  return {{before, after, i}, {b, a, -(b + a)}};
}

namespace {

double largest(const std::array<double, 3>& a) {
  return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

// The power of two that takes x > 0 to between 1 and 4, or as near as a double gets. Multiplying with it
// rounds nothing.
double to_one(double x) {
  constexpr std::uint64_t kMantissa = 52, kTwiceBias = 2046;
  const std::uint64_t exponent = std::bit_cast<std::uint64_t>(x) >> kMantissa;
  return std::bit_cast<double>(std::max<std::uint64_t>(kTwiceBias - exponent, 1) << kMantissa);
}

}  // namespace

std::array<double, 3> normal_of(const std::array<double, 3>& at, const std::array<double, 3>& du,
                                const std::array<double, 3>& dv, double scale, double epsilon) {
  const double u_size = largest(du), v_size = largest(dv);
  if (u_size == 0 || v_size == 0) return {0, 0, 0};
  const double u_factor = to_one(u_size), v_factor = to_one(v_size);
  std::array<double, 3> u, v, u_error, v_error, n;
  for (std::size_t k = 0; k < 3; ++k) {  // both of about size 1: products neither overflow nor vanish
    u[k] = du[k] * u_factor, v[k] = dv[k] * v_factor;
    u_error[k] =
        16 * epsilon * (std::abs(at[k]) * u_factor * scale + std::abs(u[k]) + std::abs(dv[k]) * u_factor);
    v_error[k] =
        16 * epsilon * (std::abs(at[k]) * v_factor * scale + std::abs(v[k]) + std::abs(du[k]) * v_factor);
  }
  bool sound = false;
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    n[k] = u[a] * v[b] - u[b] * v[a];
    square += n[k] * n[k];
    const double error = std::abs(u[a]) * v_error[b] + u_error[a] * std::abs(v[b]) +
                         std::abs(u[b]) * v_error[a] + u_error[b] * std::abs(v[a]);
    sound |= std::abs(n[k]) > error;
  }
  if (!sound) return {0, 0, 0};
  const double length = std::sqrt(square);
  return {n[0] / length, n[1] / length, n[2] / length};
}

}  // namespace subdivd

#pragma once
// Far's answers as vectors in space, for tests that show what is odd about them.

#include <array>
#include <cmath>
#include <span>

#include "core/oracle/far.h"

namespace subdivd::oracle::testing {

using Vector = std::array<double, 3>;

inline Vector at(std::span<const double> values, std::size_t v) {
  return {values[3 * v], values[3 * v + 1], values[3 * v + 2]};
}

inline double distance(const Vector& a, const Vector& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

inline Vector normal_of(const FarLevel<double>& far, std::size_t v) {
  const Vector a = at(far.tangents_u, v), b = at(far.tangents_v, v);
  Vector n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const double length = std::hypot(n[0], n[1], n[2]);
  for (double& x : n) x /= length;
  return n;
}

}  // namespace subdivd::oracle::testing

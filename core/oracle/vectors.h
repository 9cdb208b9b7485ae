#pragma once
// Vectors in space, for the comparison of normals.

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "core/base/index.h"

namespace subdivd::oracle {

using Vector = std::array<double, 3>;

// The v-th of values that are 3 each.
template <class Real>
Vector vector_at(std::span<const Real> values, Count v) {
  const std::size_t at = std::size_t{3} * v;
  return {double{values[at]}, double{values[at + 1]}, double{values[at + 2]}};
}

inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline double length(const Vector& a) { return std::hypot(a[0], a[1], a[2]); }  // no overflow on the way

// Length 1; the zero vector stays.
inline Vector unit(Vector a) {
  const double size = length(a);
  if (!(size > 0)) return a;
  for (double& x : a) x /= size;
  return a;
}

// atan2 keeps small angles exact where acos loses half the digits.
inline double degrees_between(const Vector& a, const Vector& b) {
  const Vector normal = cross(a, b);
  return std::atan2(std::sqrt(dot(normal, normal)), dot(a, b)) * 180 / std::numbers::pi;
}

}  // namespace subdivd::oracle

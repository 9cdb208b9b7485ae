#include "core/schemes/sqrt3.h"

#include <cmath>
#include <numbers>

namespace subdivd {

double Sqrt3::alpha(Index n) {
  if (n == 6) return 1.0 / 3;  // what the formula gives, without its rounding
  return (4 - 2 * std::cos(2 * std::numbers::pi / n)) / 9;
}

VertexMask Sqrt3::vertex_mask(Index n) const { return {1 - alpha(n), alpha(n) / n}; }

// The ring's mean m and the vertex v become v' = (1 - a) v + a m and m' = v / 3 + 2 m / 3: v + 3 a m is kept.
VertexMask Sqrt3::limit_mask(Index n) const {
  const double a = alpha(n);
  return {1 / (1 + 3 * a), 3 * a / (1 + 3 * a) / n};
}

}  // namespace subdivd

#include "core/schemes/butterfly.h"

#include <cmath>
#include <numbers>

namespace subdivd {

WaveMask Butterfly::ring_mask(Index n) const {
  switch (n) {
    case 1:
      return {1.0 / 2, {1.0 / 2, 0, 0}};
    case 2:
      return {1.0 / 2, {1.0 / 2, 1.0 / 2, 0}};
    case 3:
      return {3.0 / 4, {1.0 / 4, 1, 0}};
    case 4:
      return {3.0 / 4, {1.0 / 4, 1, 1.0 / 4}};
    default:
      return {3.0 / 4, {1.0 / 4, 1, 1.0 / 2}};
  }
}

SectorMask Butterfly::sector_mask(Index k, Index i) const {
  if (k <= 2) return {1.0 / 2, 0, 0, {k == 2 ? 1.0 / 2 : 0, 0}};  // what the formula gives at k = 2
  const double theta = std::numbers::pi / k, one = std::sin(i * theta), two = std::sin(2 * i * theta);
  const double end =
      std::cos(i * theta) / 4 - std::sin(2 * theta) * two / (4 * k * (std::cos(theta) - std::cos(2 * theta)));
  return {1 - std::sin(theta) * one / (k * (1 - std::cos(theta))), end, -end, {one / k, two / (2 * k)}};
}

}  // namespace subdivd

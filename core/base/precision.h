#pragma once
// Control values are doubles, answers may be single precision, and differences double a value's size: the one
// answer to numbers that outgrow their type.

#include <limits>

#include "core/base/result.h"

namespace subdivd {

// The largest magnitude that a mesh may hold to be refined in Real: beyond it a mask's sums could overflow
// before the weights bring them back.
template <class Real>
inline constexpr double kLargestValue = std::numeric_limits<Real>::max() / 1e6;

inline Error does_not_fit() {
  return Error{ErrorCode::out_of_range,
               "a coordinate, or a difference of coordinates, is too large for the precision asked for",
               {"points"}};
}

}  // namespace subdivd

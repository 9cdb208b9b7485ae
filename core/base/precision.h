#pragma once
// Control values are doubles, answers may be single precision, and differences double a value's size: the one
// answer to numbers that outgrow their type.

#include "core/base/result.h"

namespace subdivd {

inline Error does_not_fit() {
  return Error{ErrorCode::out_of_range,
               "a coordinate, or a difference of coordinates, is too large for the precision asked for",
               {"points"},
               0,
               0};
}

}  // namespace subdivd

#pragma once
// A parameter of a kind of curve that is out of its range.

#include <cmath>
#include <string>

#include "core/base/result.h"

namespace subdivd {

inline Error parameter_fault(const char* name, double value, const char* range) {
  return Error{std::isfinite(value) ? ErrorCode::out_of_range : ErrorCode::not_finite,
               "the " + std::string(name) + " is " + std::to_string(value) + "; it must be " + range,
               {std::string(name)}};
}

}  // namespace subdivd

#pragma once
// How measurements of a curve word their refusals.

#include <cstdio>
#include <string>
#include <utility>

#include "core/base/result.h"

namespace subdivd {

inline Error refusal(ErrorCode code, std::string message, Path where) {
  return Error{code, std::move(message), std::move(where)};
}

// A number as messages show it: two digits, such as 1.3e-12.
inline std::string brief(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", value);
  return text;
}

}  // namespace subdivd

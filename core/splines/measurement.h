#pragma once
// What the measurements of a curve share: how they refuse, and how often they look at the budget.

#include <cstdio>
#include <string>
#include <utility>

#include "core/base/index.h"
#include "core/base/result.h"

namespace subdivd {

inline constexpr Count kPiecesPerPoll = 64;  // pieces between two looks at the budget

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

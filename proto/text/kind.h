#pragma once
// Whether a body whose type nobody told is OBJ or OFF.

#include <string_view>

#include "core/base/budget.h"
#include "core/base/result.h"

namespace subdivd::proto::text {

enum class TextKind {
  none,  // neither: JSON, or nothing that is known
  obj,
  off,
};

// Looks at the first line that has a word outside comments: a header word of OFF, a word that begins lines of
// OBJ, or nothing but two or three whole numbers (the counts of an OFF without its header). Comments alone
// are an OBJ. No JSON object begins so, and no GLB.
Result<TextKind> find_kind(std::string_view body, const Budget& budget);

// "OFF" behind any of ST, C, N, 4 and n, in this order.
bool is_off_header(std::string_view word);

}  // namespace subdivd::proto::text

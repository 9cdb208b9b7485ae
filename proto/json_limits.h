#pragma once
// What no JSON may have, be it a request of our own or a glTF document, and how it is refused.

#include "core/base/index.h"
#include "core/base/result.h"

namespace subdivd::proto {

inline constexpr Count kMaxNumberBytes = 4096;  // characters of a number

// A number of `size` characters begins at `byte` of the text.
Error number_too_long(Path where, Count byte, Count size);
// Something within `allowed` levels of arrays and objects is one more.
Error nested_too_deeply(Path where, Count allowed);

}  // namespace subdivd::proto

#pragma once
// Numbers as every answer in text has them: the shortest that read back to the same bits.

#include <charconv>
#include <cstddef>

#include "core/base/index.h"

namespace subdivd::proto::json {

inline constexpr std::size_t kLongestNumber = 32;  // room for any; of a double 24: -2.2250738585072014e-308

// The longest texts, -1.17549435e-38 and -2.2250738585072014e-308, and what stands between two numbers.
template <class Real>
inline constexpr Count kRealText = sizeof(Real) == sizeof(float) ? 15 + 1 : 24 + 1;

// Writes a number, whole or finite, to `at`, where kLongestNumber bytes are free. Returns its end.
template <class Number>
char* print_number(char* at, Number value) {
  return std::to_chars(at, at + kLongestNumber, value).ptr;
}

inline Count digits_of(Count number) {
  Count digits = 1;
  for (; number >= 10; number /= 10) ++digits;
  return digits;
}

}  // namespace subdivd::proto::json

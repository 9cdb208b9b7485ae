#pragma once
// Numbers as the shortest texts that read back to the same bits: those of std::to_chars, byte for byte, in a
// third of its time.

#include <cstddef>

#include "core/base/index.h"

namespace subdivd::proto::json {

// Room that any number needs; of a double 24 bytes are text: -2.2250738585072014e-308.
inline constexpr std::size_t kLongestNumber = 32;

// Writes at `out`, which has kLongestNumber bytes of room (those behind the text may be overwritten), and
// returns the end of the text. The number must be finite.
char* write_number(char* out, double value);
char* write_number(char* out, float value);
char* write_number(char* out, Index value);

}  // namespace subdivd::proto::json

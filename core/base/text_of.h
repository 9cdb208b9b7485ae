#pragma once
// Numbers as messages show them.

#include <array>
#include <charconv>
#include <string>

namespace subdivd {

// As few digits as name this number and no other: 0.25, 1e-08, 7. Of no locale.
inline std::string text_of(double value) {
  std::array<char, 32> text{};
  const auto written = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), written.ptr};
}

}  // namespace subdivd

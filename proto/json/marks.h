#pragma once
// How many of the marks that structure JSON stand in a short piece of text: to go over arrays 16 bytes at a
// time where only their number matters.

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace subdivd::proto::json {

struct Marks {
  static constexpr std::ptrdiff_t kBytes = 16;  // of the text that are looked at

  bool quote = false;
  std::size_t commas = 0, brackets = 0, braces = 0;  // of brackets and braces the opening ones
  std::size_t closing = 0;                           // of both
};

// Of the kBytes bytes from p on, as if none of them stood in a string.
inline Marks marks_in(const char* p) {
  // Compilers turn comparisons of these into one instruction, on processors that have no such into several.
  using Bytes = std::uint8_t __attribute__((vector_size(Marks::kBytes)));
  struct Halves {
    std::uint64_t low, high;
  };
  const auto halves = [](auto equal) {  // every byte 0 or 255
    Halves out;
    static_assert(sizeof equal == sizeof out);
    std::memcpy(&out, &equal, sizeof out);
    return out;
  };
  const auto count = [&](auto equal) {
    const auto [low, high] = halves(equal);
    constexpr std::uint64_t kOnes = 0x0101010101010101;
    return std::size_t{((low & kOnes) + (high & kOnes)) * kOnes >> 56};  // the sum of the bytes
  };
  Bytes text;
  std::memcpy(&text, p, sizeof text);
  const auto [low, high] = halves(text == '"');
  return {.quote = (low | high) != 0,
          .commas = count(text == ','),
          .brackets = count(text == '['),
          .braces = count(text == '{'),
          .closing = count((text | 0x20) == '}')};
}

}  // namespace subdivd::proto::json

#pragma once
// Where a JSON number ends, and which double it is. In a header, for a body may hold a hundred million of
// them.

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <system_error>

namespace subdivd::proto::json {

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
inline bool ends_value(char c) {
  return c == ',' || c == ']' || c == '}' || c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

struct NumberEnd {
  const char* at;
  bool whole;  // otherwise what stands at `at` belongs to no number
};

// The end of the number that begins at p, as JSON writes numbers, before what may stand behind a value.
inline NumberEnd end_of_number(const char* p, const char* end) {
  const auto digits = [&] {
    const char* const first = p;
    while (p < end && is_digit(*p)) ++p;
    return p > first;
  };
  if (p < end && *p == '-') ++p;
  if (p < end && *p == '0')
    ++p;
  else if (!digits())
    return {p, false};
  if (p < end && *p == '.' && (++p, !digits())) return {p, false};
  if (p < end && (*p == 'e' || *p == 'E')) {
    ++p;
    if (p < end && (*p == '+' || *p == '-')) ++p;
    if (!digits()) return {p, false};
  }
  return {p, p == end || ends_value(*p)};
}

// Of a number that no double can hold: is it too large, not too small? Decided by where its first digit
// stands, for 1000…e-10 and 0.000…1e10 mislead whoever looks at the exponent alone.
inline bool is_too_large(std::string_view token) {
  const std::string_view mantissa = token.substr(0, token.find_first_not_of("-0123456789."));
  const auto first = static_cast<std::int64_t>(mantissa.find_first_of("123456789"));
  const auto point = static_cast<std::int64_t>(std::min(mantissa.find('.'), mantissa.size()));
  std::int64_t exponent = 0;
  if (mantissa.size() < token.size()) {
    std::string_view digits = token.substr(mantissa.size() + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto failure = std::from_chars(digits.data(), digits.data() + digits.size(), exponent).ec;
    if (failure == std::errc::result_out_of_range) return !digits.starts_with('-');
  }
  // Before the point the first digit counts tens, behind it tenths; bodies are shorter than 2^40.
  constexpr std::int64_t kLongest = std::int64_t{1} << 41;
  const std::int64_t before_point = first < point ? point - first : point + 1 - first;
  return exponent > -kLongest && before_point > -exponent;
}

// The number that is the whole token, correctly rounded; false: beyond a double.
inline bool convert(std::string_view token, double& out) {
  double number = 0;
  const auto failure = std::from_chars(token.data(), token.data() + token.size(), number).ec;
  if (failure == std::errc::result_out_of_range) {
    if (is_too_large(token)) return false;
    number = token.starts_with('-') ? -0.0 : 0.0;
  }
  out = number;
  return true;
}

// The digits, at most 8, that begin at p, where 8 bytes can be read.
struct Digits {
  unsigned count;
  std::uint32_t value;
};

inline Digits digits_at(const char* p) {
  static_assert(std::endian::native == std::endian::little);
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, p, sizeof bytes);
  bytes ^= 0x3030303030303030;  // digits are 0 to 9 now; adding 0x76 to anything more sets the upper bit
  const std::uint64_t others = (bytes | (bytes + 0x7676767676767676)) & 0x8080808080808080;
  const unsigned count = static_cast<unsigned>(std::countr_zero(others)) / 8;  // 64 / 8 when there are none
  if (count == 0) return {0, 0};
  bytes <<= 64 - 8 * count;  // as if zeros stood before them
  bytes = (bytes * 10 + (bytes >> 8)) & 0x00FF00FF00FF00FF;
  bytes = (bytes * 100 + (bytes >> 16)) & 0x0000FFFF0000FFFF;
  return {count, static_cast<std::uint32_t>(bytes * 10000 + (bytes >> 32))};
}

inline constexpr double kTens[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,
                                   1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19};

// Most numbers, in one pass: up to 2^53 in digits, and no exponent. Then both the digits and the power of ten
// are doubles, and one division rounds correctly.   [Clinger90]
// The end of such a number, before what may stand behind a value; null: it is none of them, or stands too
// near to the end of the text.
inline const char* read_short(const char* p, const char* end, double& out) {
  constexpr std::ptrdiff_t kMostDigits = 19;  // fit into 64 bits
  constexpr std::ptrdiff_t kRoom = 64;        // what is looked at below, and more
  if (end - p < kRoom) return nullptr;
  const bool negative = *p == '-';
  if (negative) ++p;
  std::uint64_t digits = 0;
  const char* const first = p;
  while (is_digit(*p) && p - first <= kMostDigits)
    digits = 10 * digits + static_cast<std::uint64_t>(*p++ - '0');
  std::ptrdiff_t count = p - first, behind = 0;
  if (count == 0 || (*first == '0' && count > 1)) return nullptr;
  if (*p == '.') {
    ++p;
    static constexpr std::uint64_t kWholeTens[] = {1,      10,      100,      1000,     10000,
                                                   100000, 1000000, 10000000, 100000000};
    for (unsigned found = 8; found == 8 && count <= kMostDigits; p += found) {
      const Digits more = digits_at(p);
      found = more.count;
      digits = digits * kWholeTens[found] + more.value;
      behind += found;
      count += found;
    }
    if (behind == 0) return nullptr;
  }
  if (!ends_value(*p) || count > kMostDigits || digits > (std::uint64_t{1} << 53)) return nullptr;
  const double value = static_cast<double>(digits) / kTens[behind];
  out = negative ? -value : value;
  return p;
}

}  // namespace subdivd::proto::json

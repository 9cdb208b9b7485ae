#pragma once
// Where a JSON number ends, and which double it is. In a header, for a body may hold a hundred million of
// them.

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
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

// Most numbers: up to 2^53 in digits, and no more than 22 of them behind the point. Then both the digits and
// the power of ten are doubles, and one division rounds correctly.   [Clinger90]
inline bool convert_short(const char* p, const char* end, double& out) {
  static constexpr double kTens[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                     1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  constexpr std::ptrdiff_t kMostDigits = 19;  // fit into 64 bits
  const bool negative = *p == '-';
  if (negative) ++p;
  if (end - p > kMostDigits) return false;
  std::uint64_t digits = 0;
  std::size_t behind = 0;
  bool fraction = false;
  for (; p < end; ++p) {
    if (*p == '.') {
      fraction = true;
      continue;
    }
    if (!is_digit(*p)) return false;  // an exponent
    digits = 10 * digits + static_cast<std::uint64_t>(*p - '0');
    behind += fraction ? 1 : 0;
  }
  if (digits > (std::uint64_t{1} << 53)) return false;
  const double value = static_cast<double>(digits) / kTens[behind];
  out = negative ? -value : value;
  return true;
}

}  // namespace subdivd::proto::json

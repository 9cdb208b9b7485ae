#include "proto/json/number_text.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>

namespace subdivd::proto::json {
namespace {

static_assert(std::endian::native == std::endian::little, "texts are put together in registers");

constexpr std::size_t kMostDigits = 17;  // that the shortest text of a double can need

constexpr auto kPowers = [] {
  std::array<std::uint64_t, 20> powers{};
  std::uint64_t power = 1;
  for (std::uint64_t& p : powers) p = power, power *= 10;
  return powers;
}();

unsigned count_digits(std::uint64_t value) {
  value |= 1;  // 0 has a digit, too; no other number gets or loses one
  // 1233 / 4096 is log10(2), near enough for 64 bits; right, or one too small, which the comparison mends.
  const unsigned guess = static_cast<unsigned>(std::bit_width(value)) * 1233 >> 12;
  return guess + (value >= kPowers[guess]);
}

// The eight characters of a number below 10^8, the first in the lowest byte: halved three times, both halves
// of everything at once.
std::uint64_t eight_digits(std::uint32_t value) {
  const std::uint64_t fours = value / 10000 | std::uint64_t{value % 10000} << 32;
  const std::uint64_t hundreds = fours * 10486 >> 20 & 0x0000'007F'0000'007F;
  const std::uint64_t twos = hundreds | (fours - 100 * hundreds) << 16;
  const std::uint64_t tens = twos * 103 >> 10 & 0x000F'000F'000F'000F;
  return (tens | (twos - 10 * tens) << 8) + 0x3030'3030'3030'3030;
}

void store(char* to, std::uint64_t text) { std::memcpy(to, &text, sizeof text); }

// The `count` digits of a number below 10^17, then zeros up to the 17th.
struct Digits {
  Digits(std::uint64_t digits, unsigned count) {
    const std::uint64_t all = digits * kPowers[kMostDigits - count];
    const std::uint64_t rest = all % kPowers[9];
    first = eight_digits(static_cast<std::uint32_t>(all / kPowers[9]));
    second = eight_digits(static_cast<std::uint32_t>(rest / 10));
    last = static_cast<char>('0' + rest % 10);
  }
  void write(char* out) const {
    store(out, first);
    store(out + 8, second);
    out[16] = last;
  }
  std::uint64_t first, second;
  char last;
};

char* write_scientific(char* out, std::uint64_t digits, unsigned count, int exponent) {
  Digits(digits, count).write(out + 1);
  out[0] = out[1];
  char* end = out + 1;
  if (count > 1) {
    out[1] = '.';
    end = out + 1 + count;
  }
  *end++ = 'e';
  *end++ = exponent < 0 ? '-' : '+';
  const auto size = static_cast<unsigned>(exponent < 0 ? -exponent : exponent);
  if (size >= 100) *end++ = static_cast<char>('0' + size / 100);
  *end++ = static_cast<char>('0' + size / 10 % 10);
  *end++ = static_cast<char>('0' + size % 10);
  return end;
}

// Up to 7 digits before the point and one or more behind it, or 0.0…. Whether a coordinate is below 1 is
// anyone's guess, so nothing branches on it; and nothing is read that was just written.
char* write_fraction(char* out, std::uint64_t digits, unsigned count, int whole) {
  const Digits all(digits, count);
  const std::uint64_t is_whole = -std::uint64_t{whole > 0};
  const auto zeros = static_cast<unsigned>(-whole) & ~static_cast<unsigned>(is_whole);  // behind the point
  const unsigned begin = 2 + zeros - (whole > 0);
  all.write(out + begin);
  // 0.000ddd
  const std::uint64_t below_one =
      (0x3030'3030'3030'2E30 & ((std::uint64_t{1} << 8 * begin) - 1)) | all.first << 8 * begin;
  // The digits before the point stand one further to the left.
  const unsigned shift = 8 * (static_cast<unsigned>(whole) & static_cast<unsigned>(is_whole));
  const std::uint64_t before = (std::uint64_t{1} << shift) - 1;
  const std::uint64_t with_point =
      (all.first & before) | std::uint64_t{'.'} << shift | (all.first << 8 & ~(before << 8 | 0xFF));
  store(out, (with_point & is_whole) | (below_one & ~is_whole));
  return out + begin + count;
}

// digits * 10^exponent, with an exponent where that is shorter.
char* write_decimal(char* out, std::uint64_t digits, int exponent) {
  const unsigned count = count_digits(digits);
  const int whole = static_cast<int>(count) + exponent;  // digits before the point
  // 0.000ddd takes 2 - exponent characters; d.dde-04 takes count + 5, or 5 for a single digit.
  if (exponent < 0 && whole < 8 && -exponent <= static_cast<int>(count) + 3 - (count == 1))
    return write_fraction(out, digits, count, whole);
  if (exponent < 0 && whole > 0) {
    Digits(digits, count).write(out + 1);
    std::memmove(out, out + 1, static_cast<std::size_t>(whole));
    out[whole] = '.';
    return out + count + 1;
  }
  // ddd000 takes count + exponent characters.
  if (exponent >= 0 && exponent <= (count > 1 ? 5 : 4)) {
    Digits(digits, count).write(out);
    std::memcpy(out + count, "00000", 5);
    return out + whole;
  }
  return write_scientific(out, digits, count, whole - 1);
}

template <class Real, class Bits>
char* write_real(char* out, Real value) {
  const Bits sign = std::bit_cast<Bits>(value) >> (8 * sizeof(Bits) - 1);
  *out = '-';
  out += sign;
  value = std::bit_cast<Real>(std::bit_cast<Bits>(value) & ~(sign << (8 * sizeof(Bits) - 1)));
  if (value == 0) {
    *out = '0';
    return out + 1;
  }
  // Above 2^53 or 2^24 the shortest digits, filled up with zeros, are not the number's own: std::to_chars
  // prints those when it does without an exponent.
  constexpr Real kExact = Real(std::uint64_t{1} << std::numeric_limits<Real>::digits);
  if (value > kExact) return std::to_chars(out, out + kLongestNumber, value).ptr;
  const auto decimal = fmt::detail::dragonbox::to_decimal(value);
  return write_decimal(out, decimal.significand, decimal.exponent);
}

}  // namespace

char* write_number(char* out, double value) { return write_real<double, std::uint64_t>(out, value); }
char* write_number(char* out, float value) { return write_real<float, std::uint32_t>(out, value); }

char* write_number(char* out, Index value) {
  if (value >= kPowers[8]) return std::to_chars(out, out + kLongestNumber, value).ptr;
  const unsigned count = count_digits(value);
  store(out, eight_digits(value) >> (8 * (8 - count)));
  return out + count;
}

}  // namespace subdivd::proto::json

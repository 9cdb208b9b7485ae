// Numbers of an answer are, byte for byte, what std::to_chars would write.

#include "proto/json/number_text.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace subdivd::proto::json {
namespace {

constexpr int kRounds = 200000;

template <class Number>
std::string ours(Number value) {
  char text[kLongestNumber];
  return {text, write_number(text, value)};
}

template <class Number>
std::string standard(Number value) {
  char text[64];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

template <class Real, class Bits>
void expect_standard_texts_of_random_bits() {
  std::mt19937_64 random(1);
  for (int i = 0; i < kRounds; ++i) {
    const Real value = std::bit_cast<Real>(static_cast<Bits>(random()));
    if (!std::isfinite(value)) continue;
    ASSERT_EQ(ours(value), standard(value));
  }
}

TEST(NumberText, of_any_double_is_the_standard_one) {
  expect_standard_texts_of_random_bits<double, std::uint64_t>();
}
TEST(NumberText, of_any_float_is_the_standard_one) {
  expect_standard_texts_of_random_bits<float, std::uint32_t>();
}

// 1 to 4 digits at every power of ten: where the exponent begins to be shorter.
TEST(NumberText, of_short_numbers_is_the_standard_one) {
  for (int exponent = -40; exponent < 40; ++exponent)
    for (int digits = -1300; digits<1300; digits += digits> 120 ? 17 : 1) {
      const double value = std::stod(std::to_string(digits) + "e" + std::to_string(exponent));
      ASSERT_EQ(ours(value), standard(value));
      ASSERT_EQ(ours(static_cast<float>(value)), standard(static_cast<float>(value)));
    }
}

TEST(NumberText, of_coordinates_is_the_standard_one) {
  std::mt19937_64 random(2);
  for (int i = 0; i < kRounds; ++i) {
    const double value =
        std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 80) - 90);
    ASSERT_EQ(ours(-value), standard(-value));
    ASSERT_EQ(ours(static_cast<float>(value)), standard(static_cast<float>(value)));
  }
}

TEST(NumberText, of_whole_numbers_beyond_exact_ones_is_the_standard_one) {
  for (double value = 1; value < 1e30; value *= 1.37) {
    ASSERT_EQ(ours(std::floor(value)), standard(std::floor(value)));
    ASSERT_EQ(ours(std::floor(static_cast<float>(value))), standard(std::floor(static_cast<float>(value))));
  }
}

TEST(NumberText, of_zeros_and_extremes_is_the_standard_one) {
  using Limits = std::numeric_limits<double>;
  for (const double value : {0.0, -0.0, Limits::min(), Limits::denorm_min(), Limits::max(), Limits::lowest()})
    EXPECT_EQ(ours(value), standard(value));
}

TEST(NumberText, of_indices_is_the_standard_one) {
  for (Index power = 1;; power *= 10) {
    for (const Index value : {power - 1, power, power + 1}) EXPECT_EQ(ours(value), standard(value));
    if (power > kNoIndex / 10) break;
  }
  EXPECT_EQ(ours(kNoIndex), standard(kNoIndex));
}

}  // namespace
}  // namespace subdivd::proto::json

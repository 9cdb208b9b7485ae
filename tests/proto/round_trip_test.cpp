// Numbers survive the journey bit by bit.

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

#include "proto/json/text_writer.h"
#include "tests/proto/support.h"
#include "tests/support/payload_text.h"

namespace subdivd::proto::test {
namespace {

std::string written(const std::vector<double>& values, std::size_t width, ArrayForm form) {
  json::TextWriter writer;
  EXPECT_EQ(writer.tuples(std::span<const double>(values), width, form), json::TextWriter::kAllFinite);
  Payload payload;
  payload.chunks = writer.finish();
  return subdivd::test::text_of(payload);
}

// Through our writer and our reader, as the points of a curve.
std::vector<double> there_and_back(const std::vector<double>& values, ArrayForm form) {
  const auto request = decode(R"({"curves":[{"points":)" + written(values, 3, form) + "}]}");
  EXPECT_TRUE(request.ok()) << request.error().message;
  return request ? request->curves.at(0).points : std::vector<double>{};
}

std::vector<double> random_doubles(std::uint64_t seed, std::size_t count) {
  Random random(seed);
  std::vector<double> values;
  while (values.size() < count) {
    const auto value = std::bit_cast<double>(random.next());
    if (std::isfinite(value)) values.push_back(value);
  }
  return values;
}

void expect_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(a[i]), std::bit_cast<std::uint64_t>(b[i])) << i << ": " << a[i];
}

TEST(round_trip, random_doubles_keep_their_bits) {
  const std::vector<double> values = random_doubles(20240607, 300000);
  expect_same_bits(there_and_back(values, ArrayForm::nested), values);
  expect_same_bits(there_and_back(values, ArrayForm::flat), values);
}

TEST(round_trip, the_ends_of_the_range_keep_their_bits) {
  const std::vector<double> values = {0.0,
                                      -0.0,
                                      5e-324,
                                      -5e-324,
                                      2.2250738585072014e-308,
                                      2.225073858507201e-308,
                                      1.7976931348623157e308,
                                      -1.7976931348623157e308,
                                      0.1,
                                      1.0 / 3,
                                      9007199254740993.0,
                                      123456789012345680.0,
                                      1e22,
                                      1e23,
                                      4.35};
  expect_same_bits(there_and_back(values, ArrayForm::nested), values);
}

TEST(round_trip, long_decimals_are_rounded_correctly) {
  // Half-way cases, and digits that matter after the 17th; std::from_chars is the judge.
  for (const std::string text :
       {"9007199254740993", "9007199254740992.99999999999999999999999999",
        "1.00000000000000011102230246251565404", "0.500000000000000166533453693773481063544750213623046875",
        "2.4703282292062327208e-324", "2.4703282292062328e-324", "1.7976931348623158e308", "1e-400",
        "0.000000000000000000000000000001e30", "100000000000000000000000000000000000000000e-40"}) {
    double expected = 0;
    std::from_chars(text.data(), text.data() + text.size(), expected);
    const auto request = decode(R"({"curves":[{"points":[[)" + text + "],[0]]}]}");
    ASSERT_TRUE(request.ok()) << text << request.error().message;
    if (text == "1e-400") expected = 0;  // from_chars leaves it alone
    EXPECT_EQ(std::bit_cast<std::uint64_t>(request->curves[0].points[0]),
              std::bit_cast<std::uint64_t>(expected))
        << text;
  }
}

// simdjson 3.0.1 reads every other number of 20 and more digits behind "0." wrongly, by factors of ten.
TEST(round_trip, numbers_of_many_digits_are_rounded_correctly) {
  Random random(11);
  std::string body = R"({"curves":[{"points":[)";
  std::vector<double> expected;
  for (int i = 0; i < 30000; ++i) {
    std::string text = random.below(3) == 0 ? "-" : "";
    text += random.below(2) == 0 ? "0." : "7.";
    for (std::size_t digits = 15 + random.below(30); digits > 0; --digits)
      text += static_cast<char>('0' + random.below(10));
    if (random.below(2) == 0) text += "e" + std::to_string(static_cast<int>(random.below(600)) - 300);
    double value = 0;
    ASSERT_EQ(std::from_chars(text.data(), text.data() + text.size(), value).ec, std::errc()) << text;
    expected.push_back(value);
    body += (i == 0 ? "" : ",") + text;
  }
  const auto request = decode(body + "]}]}");
  ASSERT_TRUE(request.ok()) << request.error().message;
  expect_same_bits(request->curves[0].points, expected);
}

TEST(round_trip, long_numbers_out_of_range_are_told_apart) {
  const std::string zeros(400, '0');
  const auto first_of = [](const std::string& number) {
    const auto request = decode(R"({"curves":[{"points":[[)" + number + "],[0]]}]}");
    return request ? request->curves[0].points[0] : HUGE_VAL;
  };
  EXPECT_EQ(first_of("1" + zeros), HUGE_VAL);
  EXPECT_EQ(first_of("1" + zeros + "e-10"), HUGE_VAL);
  EXPECT_EQ(first_of("1" + zeros + "e-400"), 1.0);
  EXPECT_EQ(first_of("0." + zeros + "1e10"), 0.0);
  EXPECT_EQ(first_of("0." + zeros + "1e+401"), 1.0);
  EXPECT_EQ(first_of("0.0000000000000000001e99999999999999999999"), HUGE_VAL);
  EXPECT_TRUE(std::signbit(first_of("-1.0000000000000000001e-99999999999999999999")));
  EXPECT_EQ(first_of("0" + std::string(".") + zeros), 0.0);
  // The smallest exponents that 64 bits hold, and what is too small for those.
  for (const char* exponent : {"7", "8", "9"}) {
    EXPECT_EQ(first_of("1e-922337203685477580" + std::string(exponent)), 0.0) << exponent;
    EXPECT_EQ(first_of("17.5e-922337203685477580" + std::string(exponent)), 0.0) << exponent;
    EXPECT_EQ(first_of("1e922337203685477580" + std::string(exponent)), HUGE_VAL) << exponent;
  }
}

TEST(round_trip, floats_keep_their_bits) {
  Random random(7);
  std::vector<float> values;
  while (values.size() < 99999) {
    const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
    if (std::isfinite(value)) values.push_back(value);
  }
  json::TextWriter writer;
  ASSERT_EQ(writer.tuples(std::span<const float>(values), 3, ArrayForm::flat), json::TextWriter::kAllFinite);
  Payload payload;
  payload.chunks = writer.finish();
  const auto request = decode(R"({"curves":[{"points":)" + subdivd::test::text_of(payload) + "}]}");
  ASSERT_TRUE(request.ok());
  for (std::size_t i = 0; i < values.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint32_t>(static_cast<float>(request->curves[0].points[i])),
              std::bit_cast<std::uint32_t>(values[i]));
}

// Short numbers are read by a division, long ones by std::from_chars: one way or the other, correctly
// rounded.
TEST(round_trip, decimals_of_every_length_are_read_as_strtod_reads_them) {
  Random random(7);
  std::string text;
  std::vector<double> expected;
  for (int i = 0; i < 200000; ++i) {
    std::string number = random.below(2) == 0 ? "-" : "";
    const std::size_t before = 1 + random.below(12), behind = random.below(12);
    number += static_cast<char>('1' + random.below(9));
    for (std::size_t k = 1; k < before; ++k) number += static_cast<char>('0' + random.below(10));
    if (behind > 0) number += '.';
    for (std::size_t k = 0; k < behind; ++k) number += static_cast<char>('0' + random.below(10));
    if (random.below(8) == 0) number += "e" + std::to_string(static_cast<int>(random.below(80)) - 40);
    expected.push_back(std::strtod(number.c_str(), nullptr));
    text += (i > 0 ? "],[" : "[") + number;
  }
  const auto request = decode(R"({"curves":[{"points":[)" + text + "]]}]}");
  ASSERT_TRUE(request.ok());
  ASSERT_EQ(request->curves[0].points.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(request->curves[0].points[i]),
              std::bit_cast<std::uint64_t>(expected[i]))
        << i;
}

TEST(round_trip, the_writer_stops_at_what_is_not_finite) {
  json::TextWriter writer;
  const std::vector<double> values = {1, 2, HUGE_VAL, 3};
  EXPECT_EQ(writer.tuples(std::span<const double>(values), 1, ArrayForm::flat), 2u);
}

TEST(round_trip, nested_and_flat_texts) {
  EXPECT_EQ(written({1, -0.5, 1e300, 4, 5, 6}, 3, ArrayForm::nested), "[[1,-0.5,1e+300],[4,5,6]]");
  EXPECT_EQ(written({1, -0.5, 1e300, 4, 5, 6}, 3, ArrayForm::flat), "[1,-0.5,1e+300,4,5,6]");
  EXPECT_EQ(written({}, 3, ArrayForm::nested), "[]");
}

TEST(round_trip, level_0_gives_the_points_back) {
  // Mantissas only: the engine multiplies, and 1e308 would overflow.
  std::vector<double> small = random_doubles(99, 9);
  for (double& value : small) {
    int exponent = 0;
    value = std::frexp(value, &exponent);
  }
  const auto text = answer(R"({"points":)" + written(small, 3, ArrayForm::nested) +
                           R"(,"faceVertexIndices":[0,1,2],"options":{"level":0}})");
  ASSERT_TRUE(text.ok()) << text.error().message;
  const auto again = decode(*text);
  ASSERT_TRUE(again.ok()) << again.error().message;
  expect_same_bits(again->meshes[0].points, small);
}

}  // namespace
}  // namespace subdivd::proto::test

// What JSON bodies are looked at in many bytes at a time comes to the same as byte by byte.

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "proto/json/cursor.h"
#include "proto/json/survey.h"
#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

// Arrays and objects of any length, in each other; strings with everything in them that could mislead.
std::string random_value(Random& random, int depth) {
  static constexpr std::array<std::string_view, 8> kScalars = {
      "0", "-1.25e3", "true", "\"\"", "\"[,{:\"", "\"a\\\"]}\"", "\"\\\\\"", "12345678"};
  const std::size_t kind = depth == 0 ? 2 : random.below(3);
  if (kind == 2) return std::string(kScalars[random.below(kScalars.size())]);
  std::string text = kind == 0 ? "[" : "{";
  for (std::size_t i = random.below(12), first = i; i > 0; --i) {
    if (i < first) text += ',';
    text += std::string(random.below(8) == 0 ? 17 : 0, ' ');
    if (kind == 1) text += "\"name\":";
    text += random_value(random, depth - 1);
  }
  return text + (kind == 0 ? "]" : "}");
}

struct Counts {
  Count commas = 0, brackets = 0, braces = 0;
};
Counts counts_of(std::string_view text) {
  Counts counts;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (text[i] == '\\') ++i;
    if (quoted) continue;
    counts.commas += text[i] == ',' ? 1 : 0;
    counts.brackets += text[i] == '[' ? 1 : 0;
    counts.braces += text[i] == '{' ? 1 : 0;
  }
  return counts;
}

TEST(json_blocks, a_survey_counts_every_mark_outside_strings) {
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const std::string body = "{\"points\":" + random_value(random, 4) + ",\"type\":\"nurbs\"}";
    const auto survey = json::survey(body, {});
    ASSERT_TRUE(survey.ok());
    const Counts counts = counts_of(body);
    ASSERT_EQ(survey->commas, counts.commas) << body;
    ASSERT_EQ(survey->brackets, counts.brackets) << body;
    ASSERT_EQ(survey->braces, counts.braces) << body;
    ASSERT_TRUE(survey->has_curve_type) << body;  // it has come back to the top
  }
}

TEST(json_blocks, arrays_are_counted_up_to_their_end) {
  Random random(4);
  const Budget unlimited;
  for (int i = 0; i < 20000; ++i) {
    std::string array = random_value(random, 4);
    if (array[0] != '[') continue;
    const std::string text = array + ",[[1,2,3],[4]],{}";
    json::Cursor cursor(text, unlimited);
    ASSERT_TRUE(cursor.open_array(""));
    const json::Cursor::Ahead ahead = cursor.look_ahead();
    const Counts counts = counts_of(array);
    ASSERT_EQ(ahead.values, counts.commas + 1) << array;
    ASSERT_EQ(ahead.brackets + 1, counts.brackets + counts.braces) << array;
  }
}

// Of digits and what may stand between them; few are numbers.
std::string random_number(Random& random) {
  std::string text = random.below(4) == 0 ? "-" : "";
  const auto digits = [&](std::size_t most) {
    for (std::size_t n = random.below(most + 1); n > 0; --n)
      text += static_cast<char>('0' + random.below(10));
  };
  digits(random.below(4) == 0 ? 22 : 3);
  if (random.below(2) == 0) text += '.', digits(22);
  if (random.below(4) == 0) text += random.below(2) == 0 ? "e-" : "E", digits(3);
  if (random.below(8) == 0) text += "+-.eE/:x"[random.below(8)];
  return text;
}

// Near the end of a text there are no many bytes to look at.
TEST(json_blocks, numbers_are_the_same_wherever_they_stand) {
  Random random(5);
  const Budget unlimited;
  const std::string space(100, ' ');
  int numbers = 0, indices = 0;
  for (int i = 0; i < 300000; ++i) {
    const std::string number = random_number(random), before = number + ']', far = before + space;
    json::Cursor at_end(before, unlimited), in_front(far, unlimited);
    double a = 0, b = 0;
    const bool read = at_end.try_number(a);
    ASSERT_EQ(in_front.try_number(b), read) << number;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << number;
    if (read) {
      ++numbers;
      ASSERT_EQ(std::bit_cast<std::uint64_t>(a),
                std::bit_cast<std::uint64_t>(std::strtod(number.c_str(), nullptr)))
          << number;
    }
    json::Cursor index_at_end(before, unlimited), index_in_front(far, unlimited);
    std::uint32_t p = 0, q = 0;
    const bool index = index_at_end.try_index(p);
    ASSERT_EQ(index_in_front.try_index(q), index) << number;
    ASSERT_EQ(p, q) << number;
    indices += index ? 1 : 0;
    if (index) {
      ASSERT_EQ(p, a) << number;
    }
  }
  EXPECT_GT(numbers, 100000);
  EXPECT_GT(indices, 10000);
}

}  // namespace
}  // namespace subdivd::proto::test

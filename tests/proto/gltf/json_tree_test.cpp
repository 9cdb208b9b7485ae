#include "proto/gltf/json_tree.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/proto/gltf/pipeline.h"
#include "tests/proto/gltf/unlimited.h"

namespace subdivd::proto::gltf {
namespace {

Result<Json> parse(std::string_view text, const JsonLimits& limits) {
  test::Unlimited unlimited;
  return parse_json(text, limits, unlimited.work);
}

Error error_of(const std::string& text, JsonLimits limits = {}) {
  const auto parsed = parse(text, limits);
  return parsed ? Error{ErrorCode::internal, "accepted"} : parsed.error();
}

TEST(JsonTree, prints_what_it_read) {
  const std::string text =
      R"({"z":1,"a":[true,false,null,"q\"\\"],"n":123456789012345678901234567890,"m":-9223372036854775808,)"
      R"("f":0.10,"e":1E+2,"d":1.0,"empty":{},"none":[],"u":18446744073709551615})";
  const auto parsed = parse(text, {});
  ASSERT_TRUE(parsed.ok());
  EXPECT_EQ(parsed->text(), text);
}

TEST(JsonTree, escapes_control_characters) {
  const auto parsed = parse(R"(["\u0001\n"])", {});
  ASSERT_TRUE(parsed.ok());
  EXPECT_EQ(parsed->text(), R"(["\u0001\u000a"])");
}

TEST(JsonTree, refuses_duplicate_members_and_says_where) {
  const Error error = error_of(R"({"a":[0,{"b":1,"c":2,"b":3}]})");
  EXPECT_EQ(error.code, ErrorCode::duplicate_field);
  EXPECT_EQ(test::to_pointer(error.where), "/a/1/b");
}

TEST(JsonTree, refuses_duplicates_written_in_two_ways) {
  EXPECT_EQ(error_of(R"({"a":1,"\u0061":2})").code, ErrorCode::duplicate_field);
}

TEST(JsonTree, refuses_deep_nesting) {
  const std::string deep = std::string(20000, '[') + std::string(20000, ']');
  EXPECT_EQ(error_of(deep).code, ErrorCode::too_large);
  EXPECT_EQ(error_of(std::string(1000000, '[')).code, ErrorCode::too_large);
}

// Both are refused before the parser runs, which knew the place.
TEST(JsonTree, points_at_what_is_nested_too_deeply_or_too_long) {
  const JsonLimits four_levels{.max_depth = 4};
  EXPECT_EQ(error_of(R"({"a":[0,[]],"b":{"c":["x",{"d":[]}]}})", four_levels).where,
            (Path{"b", "c", std::uint64_t{1}, "d"}));
  EXPECT_EQ(error_of(R"([[],[[]],[{"\u00e9\/":[[]]}]])", four_levels).where,
            (Path{std::uint64_t{2}, std::uint64_t{0}, "\u00e9/", std::uint64_t{0}}));
  const std::string number(5000, '1'), name(100000, 'n');
  EXPECT_EQ(error_of(R"({"a":{"x":[]},"b":[[0,1],2,)" + number + "]}").where, (Path{"b", std::uint64_t{2}}));
  const Path where = error_of("{\"" + name + "\":" + number + "}").where;
  ASSERT_EQ(where.size(), 1u);
  EXPECT_LT(std::get<std::string>(where[0]).size(), 100u);
}

TEST(JsonTree, accepts_nesting_up_to_the_limit) {
  const std::string text = std::string(64, '[') + std::string(64, ']');
  EXPECT_TRUE(parse(text, {}).ok());
}

TEST(JsonTree, refuses_more_values_than_allowed) {
  const Error error = error_of("[[],[],[],[]]", {64, 4});
  EXPECT_EQ(error.code, ErrorCode::too_large);
  EXPECT_EQ(error.allowed, 4u);
}

TEST(JsonTree, refuses_what_is_no_json) {
  for (const char* text : {"", " ", "{", "{]", "[1,]", "nul", "\"", "{\"a\":}", "[1e999]", "\xff",
                           "[\"\xc0\x80\"]", "{} x", "[01]", "[NaN]", "\"\\ud800\""})
    EXPECT_EQ(error_of(text).code, ErrorCode::malformed) << text;
}

TEST(JsonTree, refuses_what_hides_behind_a_nul) {
  EXPECT_EQ(error_of(std::string("{}\0{}", 5)).code, ErrorCode::malformed);
  EXPECT_TRUE(parse(std::string_view("{}\0\0", 4), {}).ok());
}

TEST(JsonTree, minus_0_is_a_whole_number) {
  const auto parsed = parse("[-0,-0.0,-1]", {});
  ASSERT_TRUE(parsed.ok());
  EXPECT_EQ((*parsed->array())[0].integer(), Count{0});
  EXPECT_EQ((*parsed->array())[1].integer(), std::nullopt);
  EXPECT_EQ((*parsed->array())[2].integer(), std::nullopt);
  EXPECT_EQ(parsed->text(), "[-0,-0.0,-1]");
}

TEST(JsonTree, knows_whole_numbers) {
  const auto parsed = parse("[0,9007199254740992,9007199254740993,-1,1.0,1e2,true]", {});
  ASSERT_TRUE(parsed.ok());
  const Json::Array& numbers = *parsed->array();
  EXPECT_EQ(numbers[0].integer(), Count{0});
  EXPECT_EQ(numbers[1].integer(), Count{1} << 53);
  for (const std::size_t i : {2, 3, 4, 5, 6}) EXPECT_FALSE(numbers[i].integer().has_value()) << i;
}

TEST(JsonTree, takes_long_objects_in_reasonable_time) {
  std::string text = "{";
  for (int i = 0; i < 300000; ++i) text += (i == 0 ? "\"k" : ",\"k") + std::to_string(i) + "\":0";
  EXPECT_TRUE(parse(text + "}", {}).ok());
}

TEST(JsonTree, reads_escapes_and_surrogate_pairs) {
  const auto parsed = parse(R"(["\ud83d\ude00\u00e9\u20ac\/\b\f\n\r\t\"\\"])", {});
  ASSERT_TRUE(parsed.ok());
  EXPECT_EQ(*(*parsed->array())[0].string(), "\U0001F600\u00e9\u20ac/\b\f\n\r\t\"\\");
}

TEST(JsonTree, keeps_a_negative_zero) { EXPECT_EQ(parse("[-0,-0.0]", {})->text(), "[-0,-0.0]"); }

// The text as nlohmann's own tree holds it, or nothing.
std::optional<nlohmann::ordered_json> reference(const std::string& text) {
  auto tree = nlohmann::ordered_json::parse(text, nullptr, false);
  if (tree.is_discarded()) return std::nullopt;
  return tree;
}

void expect_as_reference(const std::string& text) {
  const auto parsed = parse(text, {});
  const auto expected = reference(text);
  ASSERT_EQ(parsed.ok(), expected.has_value()) << text.substr(0, 100);
  if (parsed) {
    EXPECT_EQ(reference(parsed->text()), expected) << text.substr(0, 100);
  }
}

// Long strings and white space take another way than short ones: every length around the limits, with
// characters and escapes of every length at every place where a slice may end.
TEST(JsonTree, agrees_with_nlohmann_on_long_strings) {
  const std::vector<std::string> units = {
      "x",       "\u00e9", "\\ud83d\\ude00", "\\\\",    "\\\"",     "\xe2\x82\xac", "\xf0\x9f\x98\x80",
      "\\u00e9", "\\u12",  "\\ud83d",        "\\ude00", "\xe2\x82", "\x80",         "\n"};
  for (const std::string& unit : units) {
    for (std::size_t shift = 0; shift < 13; ++shift) {
      for (const std::size_t size : {4096 / unit.size() + 1, 12300 / unit.size()}) {
        std::string content(shift, 'a');
        for (std::size_t i = 0; i < size; ++i) content += unit;
        expect_as_reference("[\"" + content + "\",1]");
        expect_as_reference("{\"" + content + "\":[\"" + content + "\"]}");
      }
      std::string once(4090 + shift, 'a');
      once += unit + std::string(5000, 'b');
      expect_as_reference("[\"" + once + "\"]");
    }
  }
}

TEST(JsonTree, agrees_with_nlohmann_on_long_white_space) {
  for (const unsigned size : {4095u, 4096u, 4097u, 4098u, 200000u}) {
    const std::string space(size, ' '), lines(size, '\n');
    for (const std::string& text :
         {space + "[1" + lines + "," + space + "\"a\"" + space + "]" + lines, "1" + space + "2",
          "[1" + space + "2]", space, "\"" + space + "\"", "\"" + lines + "\"", "[\"a\"" + space + "\"b\"]",
          "\xEF\xBB\xBF" + space + "{}", "{\"a\"" + space + ":" + lines + "0}"})
      expect_as_reference(text);
  }
}

TEST(JsonTree, says_where_a_text_is_broken) {
  const std::string head(10000, 'h'), space(10000, ' ');
  struct Case {
    std::string text;
    std::size_t byte;
  };
  for (const Case& one : std::vector<Case>{
           {"[1,x]", 3},
           {"[1 2]", 3},
           {"[1", 2},
           {"[\"" + head, 10002},
           {"[\"" + head + "\",x]", 10004},
           {"[\"" + head + "\\x" + head + "\"]", 10003},
           {"[\"" + head + "\x80" + head + "\"]", 10002},
           {"[" + space + "\"" + head + "\"" + space + "x]", 30003},
           // Broken just before what the parser is not shown
           {"[tru" + space + "e]", 4},
           {"[tru\"" + head + "\"]", 4},
           {"[" + space + "\"" + head + "\",1." + space + "]", 20006},
           {"[1" + space, 10002},
       }) {
    const Error error = error_of(one.text);
    EXPECT_EQ(error.code, ErrorCode::malformed);
    EXPECT_NE(error.message.find("at byte " + std::to_string(one.byte) + ":"), std::string::npos)
        << error.message;
    EXPECT_LT(error.message.size(), 200u);
    for (const char* word : {"json.exception", "parse error", "last read", "syntax"})
      EXPECT_EQ(error.message.find(word), std::string::npos) << error.message;
  }
}

TEST(JsonTree, refuses_numbers_of_thousands_of_digits) {
  const Error error = error_of("[" + std::string(5000, '9') + ".0]");
  EXPECT_EQ(error.code, ErrorCode::too_large);
  EXPECT_EQ(error.allowed, 4096u);
  EXPECT_TRUE(parse("[0." + std::string(4000, '1') + "]", {}).ok());
}

// Gives so much and no more.
class Counting : public MemoryGrant {
 public:
  Result<void> take(Count bytes) override {
    sum += bytes;
    if (sum <= allowed) return {};
    return Error{ErrorCode::overloaded, "no memory now"};
  }
  Count sum = 0, allowed = ~Count{0};
};

TEST(JsonTree, says_that_it_was_stopped_and_nothing_else) {
  const std::string text =
      "[\"" + std::string(300000, 's') + "\"," + std::string(300000, ' ') + "{\"a\":[1,2]}]";
  const std::atomic<bool> gone{true};
  Budget budget;
  budget.cancelled = &gone;
  Work work(budget);
  const auto parsed = parse_json(text, {}, work);
  ASSERT_FALSE(parsed.ok());
  EXPECT_EQ(parsed.error().code, ErrorCode::cancelled);
  for (Count allowed = 0;; allowed += 10000) {
    Counting grant;
    grant.allowed = allowed;
    Budget small;
    small.memory = &grant;
    Work limited(small);
    const auto read = parse_json(text, {}, limited);
    if (read) break;
    EXPECT_EQ(read.error().code, ErrorCode::overloaded);
  }
}

TEST(JsonTree, is_stopped_within_a_string) {
  const std::string text = "[\"" + std::string(200000000, 's') + "\"]";
  Budget budget;
  budget.deadline = Budget::Clock::now() + std::chrono::milliseconds(20);
  Work work(budget);
  const auto parsed = parse_json(text, {}, work);
  ASSERT_FALSE(parsed.ok());
  EXPECT_EQ(parsed.error().code, ErrorCode::deadline_exceeded);
}

// A data URI would be held six times over.
TEST(JsonTree, asks_for_a_long_string_once) {
  Counting grant;
  Budget budget;
  budget.memory = &grant;
  Work work(budget);
  const std::string text = "[\"" + std::string(10000000, 's') + "\"]";
  ASSERT_TRUE(parse_json(text, {}, work).ok());
  EXPECT_LT(grant.sum, 10300000u);
}

// What nlohmann's own tree makes of the same text.
TEST(JsonTree, agrees_with_nlohmann_on_mutated_documents) {
  const std::string seed =
      R"({"a":[1,-2.5e3,true,null,"x\u00e9\ud83d\ude00\n"],"b":{"c":{},"d":[]},"é":"€","n":0.1E-2, "t" : [ [ ] , { } ] })";
  std::mt19937 random(7);
  const std::string alphabet = "{}[]\",:\\u0123456789eE+-.tfn \n\x01\x7f\xc3\xe9\xf0\xed";
  int accepted = 0;
  for (int i = 0; i < 200000; ++i) {
    std::string text = seed;
    for (unsigned changes = 1 + static_cast<unsigned>(random() % 3); changes > 0; --changes) {
      const std::size_t at = random() % text.size();
      const char c = alphabet[random() % alphabet.size()];
      switch (random() % 3) {
        case 0:
          text[at] = c;
          break;
        case 1:
          text.insert(at, 1, c);
          break;
        default:
          text.erase(at, 1);
      }
    }
    const auto parsed = parse(text, {});
    if (!parsed && parsed.error().code == ErrorCode::duplicate_field) continue;
    const auto expected = nlohmann::ordered_json::parse(text, nullptr, false);
    ASSERT_EQ(parsed.ok(), !expected.is_discarded()) << text;
    if (!parsed) continue;
    ++accepted;
    ASSERT_EQ(nlohmann::ordered_json::parse(parsed->text()), expected) << text;
  }
  EXPECT_GT(accepted, 5000);
}

TEST(JsonTree, copies_and_measures_what_it_prints) {
  const std::string text = R"({"z":1,"a":[true,"a string that is longer than fifteen"],"o":{"p":{}}})";
  test::Unlimited unlimited;
  const auto parsed = parse(text, {});
  EXPECT_EQ(parsed->copy(unlimited.work)->text(), text);
  EXPECT_EQ(*parsed->text_size(unlimited.work), text.size());
}

}  // namespace
}  // namespace subdivd::proto::gltf

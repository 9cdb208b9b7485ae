// Bodies made to hurt: whatever arrives, the answer is a request or a refusal, soon and in little memory.

#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

std::vector<std::string> seeds() {
  std::vector<std::string> bodies;
  for (const char* name : {"mesh_at_top", "curve", "seams", "flat", "quads"})
    bodies.push_back(source_file("proto/examples/" + std::string(name) + ".json"));
  return bodies;
}

// Exactly as long as the text, so that AddressSanitizer sees a byte read past it.
Result<RefineRequest> decode_exact(const std::string& body) {
  const std::vector<char> exact(body.begin(), body.end());
  return decode_refine(std::string_view(exact.data(), exact.size()), BodyKind::unspecified, {}, {});
}

TEST(hostile, every_truncation_is_refused) {
  for (const std::string& body : seeds()) {
    ASSERT_TRUE(decode_exact(body).ok());
    const std::size_t end = body.find_last_of('}');
    for (std::size_t size = 0; size <= end; ++size)
      ASSERT_FALSE(decode_exact(body.substr(0, size)).ok()) << body.substr(0, size);
  }
}

std::string mutated(std::string body, Random& random) {
  static const std::vector<std::string> kPieces = {
      "[",    "]",          "{",  "}",  ",",   ":",  "\"", "-",    "0",     "1e999",
      "null", "true",       "\\", "[]", "{}",  "[[", "]]", "0.5",  "-1",    "\xFF",
      "\xC3", "4294967295", " ",  "\n", "\\u", "e",  ".",  "name", "points"};
  const std::size_t edits = 1 + random.below(3);
  for (std::size_t edit = 0; edit < edits && !body.empty(); ++edit) {
    const std::size_t at = random.below(body.size());
    switch (random.below(5)) {
      case 0:
        body[at] = static_cast<char>(random.below(256));
        break;
      case 1:
        body.erase(at, 1 + random.below(8));
        break;
      case 2:
        body.insert(at, kPieces[random.below(kPieces.size())]);
        break;
      case 3:
        body.insert(at, body.substr(random.below(body.size()), random.below(40)));
        break;
      default:
        std::swap(body[at], body[random.below(body.size())]);
        break;
    }
  }
  return body;
}

TEST(hostile, mutations_are_answered_and_accepted_ones_are_json) {
  constexpr std::uint64_t kSeed = 42;
  Random random(kSeed);
  const std::vector<std::string> bodies = seeds();
  int accepted = 0;
  for (int i = 0; i < 100000; ++i) {
    const std::string body = mutated(bodies[random.below(bodies.size())], random);
    const Result<RefineRequest> request = decode_exact(body);
    if (!request) {
      ASSERT_FALSE(request.error().message.empty()) << "seed " << kSeed << ", mutation " << i << ": " << body;
      ASSERT_NE(request.error().code, ErrorCode::internal) << body;
      continue;
    }
    ++accepted;
    ASSERT_TRUE(nlohmann::json::accept(body)) << "seed " << kSeed << ", mutation " << i << ": " << body;
    for (const ControlMesh& mesh : request->meshes) ASSERT_TRUE(mesh.check().ok()) << body;
  }
  EXPECT_GT(accepted, 100);  // otherwise the mutations are too wild to test anything
}

// Refused, and faster than one could wait for.
void expect_quick_refusal(const std::string& body) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(decode_exact(body).ok());
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

std::string repeated(const std::string& piece, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += piece;
  return text;
}

TEST(hostile, a_million_brackets) { expect_quick_refusal(repeated("[", 1000000)); }

TEST(hostile, a_million_objects) { expect_quick_refusal(repeated("{\"a\":", 1000000)); }

TEST(hostile, depth_where_points_should_be) {
  expect_quick_refusal(R"({"points":)" + repeated("[", 1000000) + repeated("]", 1000000) + "}");
}

TEST(hostile, depth_in_an_ignored_member) {
  EXPECT_EQ(refusal(R"({"statistics":)" + repeated("[", 100000) + repeated("]", 100000) + "}"),
            "too_large /statistics");
}

// One limit for the whole body, whatever stands in it.
TEST(hostile, the_deepest_nesting) {
  const auto nested = [](const std::string& begin, std::size_t levels, const std::string& end) {
    return begin + repeated("[", levels) + "1" + repeated("]", levels) + end;
  };
  const auto triangle = std::string(kTriangle.substr(0, kTriangle.size() - 1));
  EXPECT_EQ(refusal(nested(triangle + R"(,"statistics":)", 63, "}")), "accepted");
  EXPECT_EQ(refusal(nested(triangle + R"(,"statistics":)", 64, "}")), "too_large /statistics");
  EXPECT_EQ(refusal(nested(R"({"options":{"level":)", 62, "}}")), "wrong_type /options/level");
  EXPECT_EQ(refusal(nested(R"({"options":{"level":)", 63, "}}")), "too_large /options/level");
  const std::string body = nested(R"({"options":{"level":)", 3, "}}");
  EXPECT_EQ(refusal(body, {}, {.max_json_depth = 5}), "wrong_type /options/level");
  EXPECT_EQ(refusal(body, {}, {.max_json_depth = 4}), "too_large /options/level");
  EXPECT_EQ(message(nested(triangle + R"(,"statistics":)", 64, "}")),
            "JSON is nested deeper than the 64 levels allowed");
}

TEST(hostile, depth_in_options) { expect_quick_refusal(R"({"options":{"level":)" + repeated("[", 1000000)); }

TEST(hostile, many_empty_tuples) {
  expect_quick_refusal(R"({"points":[)" + repeated("[],", 2700000) + "[]]}");
}

TEST(hostile, many_empty_faces) {
  expect_quick_refusal(R"({"points":[],"faceVertexIndices":[)" + repeated("[],", 2700000) + "[]]}");
}

TEST(hostile, many_empty_meshes) {
  expect_quick_refusal(R"({"meshes":[)" + repeated("{},", 2700000) + "{}]}");
}

TEST(hostile, more_meshes_than_anyone_has) {
  EXPECT_EQ(refusal(R"({"meshes":[)" + repeated(R"({"points":[],"faceVertexIndices":[]},)", 70000) + "{}]}"),
            "too_large /meshes");
}

TEST(hostile, more_primvars_than_anyone_has) {
  std::string primvars;
  for (int i = 0; i < 5000; ++i) primvars += "\"p" + std::to_string(i) + "\":{\"values\":[]},";
  EXPECT_EQ(refusal(R"({"primvars":{)" + primvars + R"("z":{"values":[]}}})"), "too_large /primvars");
}

TEST(hostile, an_endless_tuple) {
  expect_quick_refusal(R"({"curves":[{"points":[[)" + repeated("0,", 3000000) + "0]]}]}");
}

TEST(hostile, a_number_of_a_million_digits) {
  const std::string ones(1000000, '1'), zeros(1000000, '0');
  EXPECT_EQ(refusal(R"({"points":[)" + ones + "]}"), "too_large /points/0");
  EXPECT_EQ(refusal(R"({"points":[0,0,0.)" + ones + R"(],"faceVertexIndices":[]})"), "too_large /points/2");
  EXPECT_EQ(refusal(R"({"points":[[0,0,1e)" + zeros + R"(]],"faceVertexIndices":[]})"),
            "too_large /points/0/2");
  EXPECT_EQ(refusal(R"({"faceVertexIndices":[[0,1.)" + zeros + "]]}"), "too_large /faceVertexIndices/0/1");
  EXPECT_EQ(refusal(R"({"options":{"level":)" + ones + "}}"), "too_large /options/level");
  EXPECT_EQ(refusal(R"({"statistics":{"a":[0,)" + ones + "]}}"), "too_large /statistics/a/1");
}

// As long as in glTF, and told in the same words.
TEST(hostile, the_longest_number) {
  const std::string behind = R"(,0],"faceVertexIndices":[]})";
  const auto points = [&](std::size_t size) {
    return R"({"points":[0,0.)" + std::string(size - 2, '1') + behind;
  };
  EXPECT_EQ(refusal(points(4096)), "wrong_length /faceVertexIndices");
  EXPECT_EQ(refusal(points(4097)), "too_large /points/1");
  EXPECT_EQ(message(points(4097)), "the number at byte 13 has 4097 characters; 4096 are allowed");
  const auto error = decode(points(5000)).error();
  EXPECT_EQ(error.predicted, 5000u);
  EXPECT_EQ(error.allowed, 4096u);
  for (const std::string end : {".5", "e1", "1", ""}) {
    const std::string body = R"({"points":[)" + std::string(4096, '1') + end;
    EXPECT_EQ(refusal(body), end.empty() ? "not_finite /points/0" : "too_large /points/0") << end;
  }
}

TEST(hostile, a_name_of_a_million_letters_is_not_repeated_in_the_message) {
  EXPECT_LT(message(R"({")" + std::string(1000000, 'x') + R"(":1})").size(), 2000u);
}

TEST(hostile, a_zero_byte_is_no_white_space) {
  EXPECT_FALSE(decode_exact(std::string(kTriangle) + std::string(1, '\0')).ok());
}

}  // namespace
}  // namespace subdivd::proto::test

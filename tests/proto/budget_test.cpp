// Whatever a body is made of, reading it ends soon after its time or its caller is gone, and takes its memory
// beforehand.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "proto/curve_task.h"
#include "proto/json/cursor.h"
#include "proto/json/survey.h"
#include "proto/json/text_writer.h"
#include "tests/proto/support.h"
#include "tests/support/purse.h"

namespace subdivd::proto::test {
namespace {

std::string repeated(const std::string& piece, std::size_t bytes) {
  std::string text;
  text.reserve(bytes + piece.size());
  while (text.size() < bytes) text += piece;
  return text;
}

constexpr std::size_t kLarge = std::size_t{96} << 20;  // takes far longer to read than it is given

struct Shape {
  const char* name;
  std::string begin, piece, end;
};
std::vector<Shape> shapes() {
  return {
      {"numbers", R"({"points":[)", "0.25,", "0]}"},
      {"tuples", R"({"points":[)", "[0.5,1,2],", "[0,0,0]]}"},
      {"indices", R"({"faceVertexIndices":[)", "17,", "0]}"},
      {"faces", R"({"faceVertexIndices":[)", "[0,1,2],", "[0,1,2]]}"},
      {"ignored numbers", R"({"statistics":[)", "0.25,", "0]}"},
      {"ignored members", R"({"statistics":{)", "\"a\":[],", "\"a\":1}}"},
      {"a string", R"({"name":")", "x", "\"}"},
      {"a string of escapes", R"({"name":")", "\\u00e9", "\"}"},
      {"white space", "{", " ", "}"},
      {"white space in front", " ", " ", "{}"},
      {"brackets", R"({"points":)", "[", ""},
      {"many curves", R"({"points":[[0]],"curveVertexCounts":[)", "4,", "4]}"},
  };
}

TEST(json_budget, reading_stops_at_its_deadline) {
  for (const Shape& shape : shapes()) {
    const std::string body = shape.begin + repeated(shape.piece, kLarge) + shape.end;
    Budget budget;
    budget.deadline = Budget::Clock::now() + std::chrono::milliseconds(5);
    const auto request = decode_refine(body, BodyKind::json, {}, {}, budget);
    ASSERT_FALSE(request.ok()) << shape.name;
    EXPECT_EQ(request.error().code, ErrorCode::deadline_exceeded) << shape.name << request.error().message;
    budget.deadline = Budget::Clock::now() + std::chrono::milliseconds(5);
    const auto task = decode_curves(body, CurveTaskKind::measure, {}, {}, budget);
    ASSERT_FALSE(task.ok()) << shape.name;
    EXPECT_EQ(task.error().code, ErrorCode::deadline_exceeded) << shape.name << task.error().message;
  }
}

// Each part for itself: whichever comes first would hide that the others do not stop.
TEST(json_budget, looking_over_a_body_stops_at_its_deadline) {
  for (const Shape& shape : shapes()) {
    const std::string body = shape.begin + repeated(shape.piece, kLarge) + shape.end;
    Budget budget;
    budget.deadline = Budget::Clock::now() + std::chrono::milliseconds(5);
    EXPECT_FALSE(json::survey(body, budget).ok()) << shape.name;
  }
}

TEST(json_budget, the_walk_stops_wherever_it_is) {
  for (const Shape& shape : shapes()) {
    const std::string body = shape.begin + repeated(shape.piece, std::size_t{2} << 20) + shape.end;
    if (std::string_view(shape.name) == "brackets") continue;  // too deep before it is too late
    Budget budget;
    json::Cursor cursor(body, budget);
    budget.deadline = Budget::Clock::now();
    EXPECT_FALSE(cursor.skip(64)) << shape.name;
    ASSERT_TRUE(cursor.failed());
    EXPECT_EQ(cursor.error()->code, ErrorCode::deadline_exceeded) << shape.name;
  }
}

// Copying 200 MB takes 100 ms, and counting their lines more, when there is one.
TEST(json_budget, neither_copying_nor_counting_lines_goes_on_to_its_end) {
  const std::string lines = repeated("\n", std::size_t{2} << 20) + "x";
  Budget budget;
  json::Cursor copying(lines, budget), failing(lines, budget);
  ASSERT_EQ(failing.type(), json::Type::none);  // it stands on the x
  budget.deadline = Budget::Clock::now();
  std::string copy;
  EXPECT_FALSE(copying.copy(lines, copy));
  EXPECT_LT(copy.size(), lines.size());
  EXPECT_EQ(copying.error()->code, ErrorCode::deadline_exceeded);
  EXPECT_FALSE(failing.fail_syntax());
  EXPECT_EQ(failing.error()->code, ErrorCode::deadline_exceeded);
}

TEST(json_budget, the_text_of_an_answer_stops_wherever_it_is) {
  Budget budget;
  json::TextWriter writer(budget);
  budget.deadline = Budget::Clock::now();
  writer.tuples(std::span<const double>(std::vector<double>(100'000, 1.5)), 1, ArrayForm::flat);
  ASSERT_TRUE(writer.stopped().has_value());
  EXPECT_EQ(writer.stopped()->code, ErrorCode::deadline_exceeded);
}

TEST(json_budget, nothing_is_read_for_a_caller_who_went_away) {
  const std::atomic<bool> gone{true};
  Budget budget;
  budget.cancelled = &gone;
  const auto request = decode_refine(kTriangle, BodyKind::json, {}, {}, budget);
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().code, ErrorCode::cancelled);
  EXPECT_TRUE(request.error().where.empty());
}

TEST(json_budget, an_answer_stops_at_its_deadline) {
  const auto request = decode(kTriangle, {{"level", "10"}}, {.max_level = 10});
  ASSERT_TRUE(request.ok());
  Result<AnyAnswer> answer = compute(*request);
  ASSERT_TRUE(answer.ok());
  Budget budget;
  budget.deadline = Budget::Clock::now();
  const auto payload = encode_refine(*request, *std::move(answer), budget);
  ASSERT_FALSE(payload.ok());
  EXPECT_EQ(payload.error().code, ErrorCode::deadline_exceeded);
}

TEST(json_budget, memory_that_is_not_there_is_no_fault_of_the_body) {
  const std::string body = R"({"points":[)" + repeated("0,", 1'000'000) + "0]}";
  subdivd::test::Purse purse(1'000'000);
  Budget budget;
  budget.memory = &purse;
  const auto request = decode_refine(body, BodyKind::json, {}, {}, budget);
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().code, ErrorCode::overloaded);
  EXPECT_TRUE(request.error().where.empty());
}

// Counts that promise more corners than there are once asked for memory for all of them.
TEST(json_budget, faces_that_are_not_there_take_no_memory) {
  subdivd::test::Purse purse(4'000'000);
  Budget budget;
  budget.memory = &purse;
  for (const char* counts : {"[4000000000]", "[3,4294967294]", "[4]", "[2,2]"}) {
    const std::string body = R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexCounts":)" + std::string(counts) +
                             R"(,"faceVertexIndices":[0,1,2],"options":{"triangulate":true}})";
    const auto request = decode_refine(body, BodyKind::json, {}, {}, budget);
    ASSERT_FALSE(request.ok()) << counts;
    EXPECT_NE(request.error().code, ErrorCode::overloaded) << counts;
    ASSERT_FALSE(request.error().where.empty()) << counts;
    EXPECT_EQ(request.error().where[0], PathStep("faceVertexCounts")) << counts;
  }
}

// The edges of a mesh that is not refined are counted for the statistics; nobody stopped that.
TEST(json_budget, statistics_stop_at_their_deadline) {
  RefineRequest request;
  ControlMesh& mesh = request.meshes.emplace_back();
  constexpr Index kRows = 1000;
  for (Index i = 0; i <= kRows; ++i)
    for (Index k = 0; k <= kRows; ++k) mesh.points.insert(mesh.points.end(), {double(i), double(k), 0});
  for (Index i = 0; i < kRows; ++i)
    for (Index k = 0; k < kRows; ++k) {
      const Index a = i * (kRows + 1) + k, b = a + kRows + 1;
      mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  const auto took = [&](const Budget& budget, bool& ok) {
    const auto begin = Budget::Clock::now();
    ok = encode_report(request, {}, budget).ok();
    return Budget::Clock::now() - begin;
  };
  bool ok = false;
  const auto whole = took({}, ok);
  EXPECT_TRUE(ok);
  const std::atomic<bool> gone{true};
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_LT(took(budget, ok), whole / 4);
  EXPECT_FALSE(ok);
}

// Names that matter are known however they are written: the reader knows them, too.
TEST(json_budget, names_of_escapes_alone_are_known) {
  const auto escaped = [](std::string_view name) {
    std::string text;
    for (const char c : name) {
      constexpr std::string_view kDigits = "0123456789abcdef";
      text += "\\u00";
      text += kDigits[static_cast<unsigned char>(c) >> 4];
      text += kDigits[c & 15];
    }
    return text;
  };
  for (const char* name : {"faceVaryingLinearInterpolation", "subdivisionScheme", "interpolateBoundary"}) {
    const std::string body = "{\"" + escaped(name) + "\":0}";
    const auto survey = json::survey(body, {});
    ASSERT_TRUE(survey.ok());
    EXPECT_TRUE(survey->of_mesh) << name;
  }
  EXPECT_TRUE(json::survey("{\"type\":\"" + escaped("bsplineSurface") + "\"}", {})->has_curve_type);
}

}  // namespace
}  // namespace subdivd::proto::test

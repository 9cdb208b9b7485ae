// Whatever a body is made of, reading it ends soon after its time or its caller is gone, and takes its memory
// beforehand.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <string>

#include "proto/curve_task.h"
#include "tests/proto/support.h"

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

// Grants so much and no more.
class Purse final : public MemoryGrant {
 public:
  explicit Purse(Count bytes) : left_(bytes) {}
  Result<void> take(Count bytes) override {
    if (bytes > left_) return Error{ErrorCode::overloaded, "others take the memory", {}, 0, 0};
    left_ -= bytes;
    return {};
  }

 private:
  Count left_;
};

TEST(json_budget, memory_that_is_not_there_is_no_fault_of_the_body) {
  const std::string body = R"({"points":[)" + repeated("0,", 1'000'000) + "0]}";
  Purse purse(1'000'000);
  Budget budget;
  budget.memory = &purse;
  const auto request = decode_refine(body, BodyKind::json, {}, {}, budget);
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().code, ErrorCode::overloaded);
  EXPECT_TRUE(request.error().where.empty());
}

}  // namespace
}  // namespace subdivd::proto::test

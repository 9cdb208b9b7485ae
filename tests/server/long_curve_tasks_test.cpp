// What the routes under /v1/curves do to one long curve: it stops in its middle, and takes time by its
// length.
#include <gtest/gtest.h>

#include <string>

#include "core/base/pace.h"
#include "server/tasks/compute_curves.h"
#include "tests/support/deadlines.h"

namespace subdivd::server::tasks {
namespace {

using Kind = proto::CurveTaskKind;
using testing::expect_stops_midway;
using testing::kLinear;
using testing::within;

// first, first + 1, ..., as many as that.
std::string row(std::size_t count, std::size_t first = 0, const char* before = "", const char* behind = "") {
  std::string text = "[";
  for (std::size_t i = 0; i < count; ++i)
    text += (i > 0 ? "," : "") + std::string(before) + std::to_string(first + i) + behind;
  return text + "]";
}

// A straight line of degree 3 on whole knots.
std::string line(std::size_t count, const std::string& members) {
  return R"({"type":"nurbs","order":4,"points":)" + row(count, 0, "[", "]") + R"(,"knots":)" +
         row(count + 4) + "," + members + "}";
}

proto::CurveRequest request_of(Kind kind, const std::string& body) {
  auto request = proto::decode_curves(body, kind, {}, {});
  EXPECT_TRUE(request.ok()) << request.error().message;
  return *std::move(request);
}

TEST(LongCurveTasks, stop_in_the_middle_of_a_curve) {
  constexpr std::size_t kPoints = 400'000;
  for (const char* members : {R"("reversed":true)", R"("domain":[0,1])", R"("range":[5,1000])"}) {
    SCOPED_TRACE(members);
    const auto request = request_of(Kind::convert, line(kPoints, members));
    expect_stops_midway([&](const Budget& budget) { return compute_edited(request, budget); });
  }
  const auto insert = request_of(Kind::insert_knot, line(kPoints, R"("insert":[4.5])"));
  expect_stops_midway([&](const Budget& budget) { return compute_edited(insert, budget); });
  const auto remove = request_of(Kind::remove_knot, line(kPoints, R"("remove":[5])"));
  expect_stops_midway([&](const Budget& budget) { return compute_edited(remove, budget); });
  const auto sample = request_of(Kind::evaluate, line(kPoints, R"("samples":{"ts":[5]})"));
  expect_stops_midway([&](const Budget& budget) { return compute_samples(sample, budget); });
}

TEST(LongCurveTasks, stop_while_they_are_predicted) {
  const auto request = request_of(Kind::convert, line(400'000, R"("to":"bezier")"));
  expect_stops_midway(
      [&](const Budget& budget) { return predict_curve_task(request, Count{1} << 40, budget); });
}

// The error of work that was stopped once pointed at whatever member it was about.
TEST(LongCurveTasks, that_were_stopped_blame_no_member) {
  const auto request = request_of(Kind::convert, line(200'000, R"("toDegree":5)"));
  const auto stopped = compute_edited(request, within(std::chrono::milliseconds(20)));
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().code, ErrorCode::deadline_exceeded);
  EXPECT_TRUE(stopped.error().where.empty());
}

// Every knot of the list once made the whole curve anew.
TEST(LongCurveTasks, lose_all_listed_knots_in_linear_time) {
  constexpr std::size_t kPoints = 100'000;
  const auto request =
      request_of(Kind::remove_knot, line(kPoints, R"("tolerance":1,"remove":)" + row(kPoints - 4, 4)));
  const auto edited = compute_edited(request, within(kLinear));
  ASSERT_TRUE(edited.ok()) << edited.error().message;
  EXPECT_GT(edited->removed[0], kPoints / 2);
}

TEST(LongCurveTasks, are_lifted_to_the_highest_degree_in_time) {
  const auto request = request_of(Kind::convert, line(500, R"("toDegree":63)"));
  EXPECT_TRUE(compute_edited(request, within(kLinear)).ok());
}

// For every frame of a curve with weights all of these and all knots once were copied.
TEST(LongCurveTasks, have_as_many_frames_as_points_in_linear_time) {
  constexpr std::size_t kPoints = 100'000;
  const auto request = request_of(
      Kind::evaluate, line(kPoints, R"("pointWeights":)" + row(kPoints, 1) +
                                        R"(,"frames":true,"samples":{"ts":)" + row(kPoints - 4, 4) + "}"));
  const auto samples = compute_samples(request, within(kLinear));
  EXPECT_TRUE(samples.ok()) << samples.error().message;
}

// A short list is looked for in every one of many curves.
TEST(LongCurveTasks, refuse_to_look_for_many_knots_in_many_curves) {
  std::string points = "[0]", counts = "4";
  for (int i = 1; i < 40000; ++i) points += ",[" + std::to_string(i) + "]";
  for (int i = 1; i < 10000; ++i) counts += ",4";
  const auto body = [&](std::size_t listed) {
    std::string knots = "1";
    for (std::size_t k = 1; k < listed; ++k) knots += ",1";
    return "{\"points\":[" + points + "],\"curveVertexCounts\":[" + counts + "],\"remove\":[" + knots + "]}";
  };
  const auto refused = predict_curve_task(request_of(Kind::remove_knot, body(900)), Count{1} << 40);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::too_large);
  EXPECT_EQ(refused.error().where, Path{"remove"});
  EXPECT_TRUE(predict_curve_task(request_of(Kind::remove_knot, body(800)), Count{1} << 40).ok());
}

}  // namespace
}  // namespace subdivd::server::tasks

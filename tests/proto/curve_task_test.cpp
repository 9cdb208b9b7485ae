// Bodies under /v1/curves: what they may hold, and what their refusals point at.
#include "proto/curve_task.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "proto/openapi.h"
#include "proto/problem.h"
#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

using Kind = CurveTaskKind;
using nlohmann::json;

constexpr std::string_view kLine = R"("points":[[0,0],[1,1],[2,0],[3,1]])";
constexpr std::string_view kNurbs = R"("type":"nurbs","order":2,"knots":[0,0,1,1],"points":[[0],[1]])";

std::string body(std::string_view curve, std::string_view members) {
  return "{" + std::string(curve) + (members.empty() ? "" : ",") + std::string(members) + "}";
}

std::string refused(Kind kind, const std::string& text, const QueryParameters& query = {}) {
  const auto request = decode_curves(text, kind, query, {});
  if (request) return "accepted";
  const Error& error = request.error();
  std::string pointer;
  for (const PathStep& step : error.where)
    pointer +=
        "/" + (std::holds_alternative<std::string>(step) ? std::get<std::string>(step)
                                                         : std::to_string(std::get<std::uint64_t>(step)));
  return std::string(name_of(error.code)) + " " + pointer;
}

TEST(CurveTask, takes_one_curve_at_the_top_or_several) {
  const auto one = decode_curves(body(kLine, ""), Kind::measure, {}, {});
  ASSERT_TRUE(one);
  EXPECT_TRUE(one->curves.single_curve_at_top);
  const auto two =
      decode_curves("{\"curves\":[" + body(kLine, "") + "," + body(kNurbs, "") + "]}", Kind::measure, {}, {});
  ASSERT_TRUE(two);
  EXPECT_EQ(two->curves.curves.size(), 2u);
  EXPECT_EQ(refused(Kind::measure, body(kLine, R"("curves":[])")), "duplicate_field /curves");
  EXPECT_EQ(refused(Kind::measure, "{}"), "missing_field ");
  EXPECT_EQ(refused(Kind::measure, R"({"points":[[0,0]]})"), "too_few_points /points");
  EXPECT_EQ(refused(Kind::measure, R"({"curves":[{"points":[[0,0]]}]})"), "too_few_points /curves/0/points");
}

TEST(CurveTask, takes_the_precision_of_its_numbers_and_no_other_option) {
  for (const Kind kind :
       {Kind::evaluate, Kind::measure, Kind::insert_knot, Kind::remove_knot, Kind::convert}) {
    const std::string members = kind == Kind::evaluate      ? R"("samples":{"ts":[0]})"
                                : kind == Kind::insert_knot ? R"("insert":[1])"
                                                            : R"("name":"n")";
    const auto with = [&](const std::string& options) {
      return body(kLine, members + ",\"options\":" + options);
    };
    EXPECT_EQ(refused(kind, with(R"({"precision":"single"})")), "accepted");
    EXPECT_EQ(refused(kind, with("{}")), "accepted");
    EXPECT_EQ(refused(kind, with(R"({"precision":null})")), "wrong_type /options/precision");
    EXPECT_EQ(refused(kind, with(R"({"level":1})")), "unknown_field /options/level");
    EXPECT_EQ(refused(kind, body(kLine, members), {{"precision", "single"}}), "accepted");
    EXPECT_EQ(refused(kind, body(kLine, members), {{"precision", "half"}}), "bad_enum /?precision");
    EXPECT_EQ(refused(kind, body(kLine, members), {{"level", "1"}}), "unknown_field /?level");
    const auto request = decode_curves(body(kLine, members), kind, {{"level", "1"}}, {});
    ASSERT_FALSE(request.ok());
    EXPECT_NE(request.error().message.find("valid: precision"), std::string::npos) << request.error().message;
  }
}

TEST(CurveTask, takes_the_members_of_its_kind_only) {
  EXPECT_EQ(refused(Kind::measure, body(kLine, R"("insert":[1])")), "unknown_field /insert");
  EXPECT_EQ(refused(Kind::insert_knot, body(kLine, R"("insert":[1],"flatten":1)")), "unknown_field /flatten");
  EXPECT_EQ(refused(Kind::insert_knot, body(kLine, R"("insert":[1],"tolerance":1)")),
            "unknown_field /tolerance");
  EXPECT_EQ(refused(Kind::insert_knot, body(kLine, "")), "missing_field /insert");
  EXPECT_EQ(refused(Kind::evaluate, body(kLine, "")), "missing_field /samples");
  EXPECT_EQ(refused(Kind::refine, body(kLine, R"("options":{"level":1})")), "accepted");
  EXPECT_EQ(refused(Kind::refine, body(kLine, R"("samples":{"ts":[0]})")), "unknown_field /samples");
  EXPECT_EQ(refused(Kind::measure, body(kLine, ""), {{"level", "1"}}), "unknown_field /?level");
  EXPECT_EQ(refused(Kind::measure, body(kLine, R"("faceVertexIndices":[])")),
            "unknown_field /faceVertexIndices");
}

TEST(CurveTask, points_at_what_is_wrong) {
  EXPECT_EQ(refused(Kind::evaluate, body(kLine, R"("samples":{"ts":[0,"1"]})")), "wrong_type /samples/ts/1");
  EXPECT_EQ(refused(Kind::evaluate, body(kLine, R"("samples":{"curves":[0],"ts":[0,1]})")),
            "wrong_length /samples/curves");
  EXPECT_EQ(refused(Kind::evaluate, body(kLine, R"("samples":{"curves":[0]})")), "missing_field /samples/ts");
  EXPECT_EQ(refused(Kind::evaluate, body(kLine, R"("samples":{"ts":[0],"us":[0]})")),
            "duplicate_field /samples/ts");
  EXPECT_EQ(refused(Kind::evaluate, body(kLine, R"("samples":{"ts":[0],"xs":[0]})")),
            "unknown_field /samples/xs");
  EXPECT_EQ(refused(Kind::evaluate, body(kLine, R"("samples":{"ts":[0]},"derivatives":33)")),
            "out_of_range /derivatives");
  EXPECT_EQ(refused(Kind::evaluate, body(kLine, R"("samples":{"ts":[0]},"frames":1)")), "wrong_type /frames");
  EXPECT_EQ(refused(Kind::convert, body(kLine, R"("to":"spline")")), "bad_enum /to");
  EXPECT_EQ(refused(Kind::convert, body(kLine, R"("toDegree":64)")), "out_of_range /toDegree");
  EXPECT_EQ(refused(Kind::convert, body(kLine, R"("toDegree":0)")), "out_of_range /toDegree");
  EXPECT_EQ(refused(Kind::convert, body(kLine, R"("range":[0])")), "wrong_length /range");
  EXPECT_EQ(refused(Kind::convert, body(kLine, R"("domain":[0,1,2])")), "wrong_length /domain");
  EXPECT_EQ(refused(Kind::measure, body(kLine, R"("closestTo":[1,2,3])")), "wrong_type /closestTo");
  EXPECT_EQ(refused(Kind::measure, body(kLine, R"("equalLengths":1000001)")), "out_of_range /equalLengths");
  EXPECT_EQ(refused(Kind::measure, body(kLine, R"("convergence":25)")), "out_of_range /convergence");
  EXPECT_EQ(refused(Kind::remove_knot, body(kLine, R"("tolerance":"small")")), "wrong_type /tolerance");
}

// What the reader of each kind takes is what the document lists.
TEST(CurveTask, takes_the_members_that_the_document_lists) {
  const json document = json::parse(openapi_json());
  const std::pair<Kind, const char*> kinds[] = {
      {Kind::refine, "CurvesRequest"},          {Kind::evaluate, "EvaluateRequest"},
      {Kind::insert_knot, "InsertKnotRequest"}, {Kind::remove_knot, "RemoveKnotRequest"},
      {Kind::convert, "ConvertRequest"},        {Kind::measure, "MeasureRequest"}};
  std::set<std::string> all;
  for (const auto& [kind, name] : kinds)
    for (const auto& [member, unused] : document["components"]["schemas"][name]["properties"].items())
      all.insert(member);
  for (const auto& [kind, name] : kinds) {
    const json& listed = document["components"]["schemas"][name]["properties"];
    for (const std::string& member : all) {
      // With a value of no use: whatever is said about the member, it must not be that it is unknown.
      const std::string text = body(kLine, "\"samples\":{\"ts\":[0]},\"insert\":[0],\"" + member + "\":{}");
      if (member == "points" || member == "samples" || member == "insert") continue;
      const auto request = decode_curves(text, kind, {}, {});
      const bool named = !request && request.error().code == ErrorCode::unknown_field &&
                         request.error().message.ends_with(" no " + member);
      if (listed.contains(member)) {
        EXPECT_FALSE(named) << name << ' ' << member;
      }
    }
  }
}

TEST(CurveTask, truncated_bodies_are_refused) {
  const std::string whole =
      body(kNurbs, R"("samples":{"curves":[0,0],"ts":[0.5,1]},"derivatives":2,"frames":true)");
  ASSERT_EQ(refused(Kind::evaluate, whole), "accepted");
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_NE(refused(Kind::evaluate, whole.substr(0, length)), "accepted") << length;
}

}  // namespace
}  // namespace subdivd::proto::test

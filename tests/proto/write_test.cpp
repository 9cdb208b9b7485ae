// What JSON answers look like.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "proto/json/json.h"
#include "tests/proto/support.h"
#include "tests/support/payload_text.h"

namespace subdivd::proto::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json answered(std::string_view body, const QueryParameters& query = {}) {
  const Result<std::string> text = answer(body, query);
  EXPECT_TRUE(text.ok()) << text.error().message;
  return text ? json::parse(*text) : json();
}

// The triangle with further members, refined once.
std::string triangle(const std::string& members) {
  return R"({"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2],"options":{"level":1},)" +
         members + "}";
}

TEST(write, a_mesh_at_the_top_comes_back_at_the_top) {
  const json one = answered(kTriangle, {{"level", "1"}});
  EXPECT_EQ(one["points"].size(), 6u);
  EXPECT_FALSE(one.contains("meshes"));
}

TEST(write, meshes_in_an_array_come_back_in_an_array) {
  const json several = answered(R"({"meshes":[)" + std::string(kTriangle) + "]}", {{"level", "1"}});
  EXPECT_EQ(several["meshes"].size(), 1u);
  EXPECT_FALSE(several.contains("points"));
}

TEST(write, arrays_have_the_form_of_the_request) {
  const json nested = answered(kTriangle, {{"level", "1"}, {"normals", "1"}});
  EXPECT_TRUE(nested["points"][0].is_array() && nested["normals"][0].is_array());
  EXPECT_TRUE(nested["faceVertexIndices"][0].is_number());
  const json flat = answered(R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[[0,1,2]]})");
  EXPECT_TRUE(flat["points"][0].is_number());
  EXPECT_EQ(flat["faceVertexIndices"][0].size(), 3u);
}

TEST(write, primvars_come_back_with_their_interpolation) {
  const json one = answered(triangle(
      R"("primvars":{"st":{"interpolation":"faceVarying","values":[[0,0],[1,0],[0,1]]},"t":{"values":[1,2,3]},
         "m":{"interpolation":"uniform","values":[7]},"c":{"interpolation":"constant","values":[5]}})"));
  EXPECT_EQ(one["primvars"]["st"]["interpolation"], "faceVarying");
  EXPECT_EQ(one["primvars"]["st"]["elementSize"], 2);
  EXPECT_EQ(one["primvars"]["st"]["indices"].size(), 12u);
  EXPECT_EQ(one["primvars"]["t"]["values"].size(), 6u);
  EXPECT_EQ(one["primvars"]["m"]["values"], json({7.0, 7.0, 7.0, 7.0}));
  EXPECT_EQ(one["primvars"]["c"]["values"], json({5.0}));
}

TEST(write, limit_points_stand_in_the_place_of_points) {
  const json refined = answered(kTriangle, {{"level", "1"}, {"interpolateBoundary", "edgeOnly"}});
  const json limit =
      answered(kTriangle, {{"level", "1"}, {"interpolateBoundary", "edgeOnly"}, {"limit", "1"}});
  EXPECT_EQ(limit["points"].size(), refined["points"].size());
  EXPECT_NE(limit["points"], refined["points"]);
}

TEST(write, normals_only_when_asked) {
  EXPECT_FALSE(answered(kTriangle).contains("normals"));
  EXPECT_EQ(answered(kTriangle, {{"normals", "1"}})["normals"][0], json({0.0, 0.0, 1.0}));
}

TEST(write, curves_come_back_as_curves) {
  const json one = answered(R"({"curves":[{"name":"c","points":[[0,0],[1,1],[2,0]]}]})", {{"level", "1"}});
  EXPECT_EQ(one["curves"][0]["points"].size(), 5u);
  EXPECT_EQ(one["curves"][0]["curveVertexCounts"], json({5}));
  EXPECT_EQ(one["curves"][0]["wrap"], "pinned");
  EXPECT_FALSE(one.contains("meshes"));
}

TEST(write, curves_get_tangents_when_normals_are_asked_for) {
  const json one = answered(R"({"curves":[{"points":[[0,0],[1,1],[2,0]]}]})", {{"normals", "1"}});
  EXPECT_EQ(one["curves"][0]["tangents"].size(), one["curves"][0]["points"].size());
}

TEST(write, options_are_echoed_with_effective_values) {
  const json options = answered(kTriangle, {{"level", "1"}})["options"];
  EXPECT_EQ(options["level"], 1);
  EXPECT_EQ(options["precision"], "double");
  EXPECT_EQ(options["loopWeights"], "loop");
}

TEST(write, statistics_count_every_level) {
  const json statistics = answered(kTriangle, {{"level", "2"}})["statistics"];
  EXPECT_EQ(statistics["meshes"][0]["input"], json({{"points", 3}, {"faces", 1}}));
  EXPECT_EQ(statistics["meshes"][0]["output"], json({{"points", 15}, {"triangles", 16}}));
  EXPECT_EQ(statistics["meshes"][0]["levels"][1],
            json({{"level", 1}, {"vertices", 6}, {"edges", 9}, {"triangles", 4}}));
  EXPECT_EQ(statistics["meshes"][0]["levels"].size(), 3u);
}

TEST(write, statistics_count_curves) {
  const json curves =
      answered(R"({"curves":[{"wrap":"periodic","points":[[0],[1],[2]]}]})", {{"level", "2"}});
  EXPECT_EQ(curves["statistics"]["curves"][0]["levels"][2], json({{"level", 2}, {"points", 12}}));
}

TEST(write, warnings_only_when_there_are_some) {
  EXPECT_FALSE(answered(kTriangle).contains("warnings"));
  EXPECT_EQ(
      answered(R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2,0,0,1]})")["warnings"].size(), 1u);
}

TEST(write, an_answer_is_a_valid_request) {
  const auto first = answer(triangle(
      R"("name":"n","interpolateBoundary":"edgeOnly","primvars":{"st":{"interpolation":"faceVarying",
         "values":[[0,0],[1,0],[0,1]]},"m":{"interpolation":"uniform","values":[7]}})"));
  ASSERT_TRUE(first.ok());
  const auto again = decode(*first);
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ(again->meshes[0].name, "n");
  EXPECT_EQ(again->meshes[0].interpolate_boundary, BoundaryInterpolation::edge_only);
  EXPECT_EQ(again->options.level, 1u);
}

TEST(write, an_answer_of_curves_is_a_valid_request) {
  const auto first = answer(R"({"curves":[{"points":[[0,0],[1,1],[2,0]]}]})", {{"normals", "1"}});
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(refusal(*first), "accepted");
}

TEST(write, single_precision_is_written_as_floats) {
  const auto text = answer(R"({"points":[[0.1,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2]})",
                           {{"level", "0"}, {"precision", "single"}});
  ASSERT_TRUE(text.ok());
  EXPECT_THAT(*text, HasSubstr("[[0.1,0,0]"));
}

TEST(write, numbers_that_overflow_are_an_error_and_not_infinity) {
  Result<RefineRequest> request = decode(kTriangle);
  ASSERT_TRUE(request.ok());
  Result<AnyAnswer> computed = compute(*request);
  ASSERT_TRUE(computed.ok());
  auto& answer = std::get<RefineAnswer<double>>(*computed);
  answer.meshes[0].points[4] = std::numeric_limits<double>::quiet_NaN();
  const Result<Payload> payload = encode_refine(*request, std::move(*computed));
  ASSERT_FALSE(payload.ok());
  EXPECT_EQ(payload.error().code, ErrorCode::not_finite);
}

TEST(write, names_are_escaped) {
  const json one = answered(triangle(R"("name":"a\"\\\u0001é")"));
  EXPECT_EQ(one["name"], "a\"\\\x01é");
}

TEST(write, big_answers_come_in_chunks) {
  Result<RefineRequest> request = decode(kTriangle, {{"level", "8"}});
  ASSERT_TRUE(request.ok());
  Result<AnyAnswer> computed = compute(*request);
  ASSERT_TRUE(computed.ok());
  const Result<Payload> payload = encode_refine(*request, std::move(*computed));
  ASSERT_TRUE(payload.ok());
  EXPECT_GT(payload->chunks.size(), 2u);
  for (const Chunk& chunk : payload->chunks) EXPECT_LE(chunk.bytes.size(), std::size_t{1} << 20);
  EXPECT_EQ(json::parse(subdivd::test::text_of(*payload))["points"].size(), 257u * 258 / 2);
}

oracle::Report report_with_a_failure() {
  oracle::Deviation deviation;
  deviation.quantity = "points";
  deviation.max_absolute = std::numeric_limits<double>::infinity();
  deviation.tolerance = 1e-12;
  deviation.compared = 6;
  deviation.verdict = oracle::Verdict::failed;
  deviation.worst_vertex = 4;
  deviation.worst_face = 1;
  deviation.worst_u = 0.5;
  oracle::Report report;
  report.oracle = "OpenSubdiv";
  report.meshes.push_back(
      {"m", "double", {{1, true, 6, 4, {deviation}}}, oracle::Verdict::failed, {"a remark"}});
  report.curves.push_back({"c", "single", {{1, true, 5, 0, {}}}, oracle::Verdict::nothing_compared, {}});
  report.surfaces.push_back({"s", "double", {{2, true, 25, 16, {}}}, oracle::Verdict::passed, {}});
  return report;
}

TEST(write, a_report_tells_the_worst_place) {
  const json verification = json::parse(subdivd::proto::json::report(report_with_a_failure()));
  EXPECT_EQ(verification["passed"], false);
  const json deviation = verification["meshes"][0]["levels"][0]["deviations"][0];
  EXPECT_EQ(deviation["worst"], json({{"vertex", 4}, {"face", 1}, {"u", 0.5}, {"v", 0.0}}));
  EXPECT_EQ(deviation["withinTolerance"], false);
  EXPECT_EQ(verification["meshes"][0]["remarks"][0], "a remark");
  EXPECT_EQ(verification["curves"][0]["name"], "c");
}

TEST(write, a_report_counts_faces_of_what_has_faces) {
  const json verification = json::parse(subdivd::proto::json::report(report_with_a_failure()));
  EXPECT_EQ(verification["meshes"][0]["levels"][0]["faces"], 4);
  EXPECT_EQ(verification["surfaces"][0]["levels"][0]["faces"], 16);
  EXPECT_FALSE(verification["curves"][0]["levels"][0].contains("faces"));
}

TEST(write, a_report_tells_at_which_corner_of_a_polygon_the_worst_place_is) {
  oracle::Report report = report_with_a_failure();
  report.meshes[0].levels[0].deviations[0].worst_corner = 3;
  const json verification = json::parse(subdivd::proto::json::report(report));
  const json deviation = verification["meshes"][0]["levels"][0]["deviations"][0];
  EXPECT_EQ(deviation["worst"], json({{"vertex", 4}, {"face", 1}, {"corner", 3}, {"u", 0.5}, {"v", 0.0}}));
}

// Of six edges that are all semi-sharp no limit can be compared; that was called a pass.
TEST(write, a_report_does_not_pass_what_was_not_compared) {
  oracle::LevelReport level{1, true, 10, 16, std::vector<oracle::Deviation>(2)};
  level.deviations[0].compared = 10;
  level.deviations[0].verdict = oracle::Verdict::passed;
  level.deviations[1].excepted = 10;
  oracle::Report report;
  report.meshes.emplace_back().levels = {level};
  report.meshes[0].verdict = verdict_of(report.meshes[0].levels);
  const json verification = json::parse(subdivd::proto::json::report(report));
  const json& mesh = verification["meshes"][0];
  EXPECT_EQ(mesh["levels"][0]["deviations"][0]["withinTolerance"], true);
  for (const json& verdict : {mesh["levels"][0]["deviations"][1]["withinTolerance"],
                              mesh["levels"][0]["passed"], mesh["passed"], verification["passed"]})
    EXPECT_TRUE(verdict.is_null()) << verification;
}

TEST(write, a_report_has_null_for_what_is_no_number) {
  const json verification = json::parse(subdivd::proto::json::report(report_with_a_failure()));
  EXPECT_TRUE(verification["meshes"][0]["levels"][0]["deviations"][0]["maxAbsolute"].is_null());
}

TEST(write, a_report_numbers_faces_as_the_caller_did) {
  RefineRequest request;
  request.face_origins = {{3, 7}};
  const json verification = json::parse(subdivd::proto::json::report(report_with_a_failure(), &request));
  EXPECT_EQ(verification["meshes"][0]["levels"][0]["deviations"][0]["worst"]["face"], 7);
}

TEST(write, a_report_alone_has_options_and_statistics) {
  const auto request = decode(kTriangle);
  ASSERT_TRUE(request.ok());
  const auto payload = encode_report(*request, report_with_a_failure());
  ASSERT_TRUE(payload.ok());
  const json one = json::parse(subdivd::test::text_of(*payload));
  EXPECT_EQ(one["verification"]["oracle"], "OpenSubdiv");
  EXPECT_EQ(one["statistics"]["meshes"][0]["input"]["points"], 3);
}

TEST(write, a_verification_is_a_member_of_the_answer) {
  const auto request = decode(kTriangle, {{"verify", "1"}});
  ASSERT_TRUE(request.ok());
  Result<AnyAnswer> computed = compute(*request);
  ASSERT_TRUE(computed.ok());
  std::get<RefineAnswer<double>>(*computed).verification = report_with_a_failure();
  const auto payload = encode_refine(*request, std::move(*computed));
  ASSERT_TRUE(payload.ok());
  EXPECT_EQ(json::parse(subdivd::test::text_of(*payload))["verification"]["passed"], false);
}

}  // namespace
}  // namespace subdivd::proto::test

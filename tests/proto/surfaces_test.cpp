// B-spline surfaces on the wire: what a body may hold, what its refusals point at, what comes back.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "proto/curve_task.h"
#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

using nlohmann::json;

// A grid of points in a wave; u along the rows.
json grid(int u_count, int v_count, int width = 3) {
  json points = json::array();
  for (int j = 0; j < v_count; ++j)
    for (int i = 0; i < u_count; ++i) {
      json point = json::array({i, j, (i * j) % 3, i - j, 1});
      point.erase(point.begin() + width, point.end());
      points.push_back(point);
    }
  return {{"type", "bsplineSurface"}, {"uVertexCount", u_count}, {"points", points}};
}

json with(json body, const json& members) {
  body.update(members);
  return body;
}
json without(json body, const char* member) {
  body.erase(member);
  return body;
}

json answered(const json& body, const QueryParameters& query = {}) {
  const Result<std::string> text = answer(body.dump(), query);
  EXPECT_TRUE(text.ok()) << text.error().message;
  return text ? json::parse(*text) : json();
}

std::string refused(const json& body) { return refusal(body.dump()); }

TEST(surfaces, stand_at_the_top_or_in_a_list) {
  const auto top = decode(grid(4, 3).dump());
  ASSERT_TRUE(top);
  EXPECT_TRUE(top->single_surface_at_top);
  EXPECT_FALSE(top->single_curve_at_top);
  ASSERT_EQ(top->surfaces.size(), 1u);
  const auto list = decode(json{{"surfaces", {grid(4, 3), grid(5, 5)}}}.dump());
  ASSERT_TRUE(list);
  EXPECT_EQ(list->surfaces.size(), 2u);
  // In the list the type is known; at the top it tells a surface from a mesh.
  EXPECT_EQ(refused({{"surfaces", {without(grid(4, 3), "type")}}}), "accepted");
  EXPECT_EQ(refused(without(grid(4, 3), "type")), "unknown_field /uVertexCount");
  const json beside = {{"meshes", {json::parse(kTriangle)}},
                       {"curves", {{{"points", {{0, 0}, {1, 1}}}}}},
                       {"surfaces", {grid(4, 3)}}};
  const json all = answered(beside);
  for (const char* kind : {"meshes", "curves", "surfaces"}) {
    EXPECT_EQ(all[kind].size(), 1u);
    EXPECT_EQ(all["statistics"][kind].size(), 1u);
  }
}

TEST(surfaces, either_count_follows_from_the_other) {
  const auto u = decode(grid(4, 3).dump());
  EXPECT_EQ(u->surfaces[0].v_count, 3u);
  const auto v = decode(with(without(grid(4, 3), "uVertexCount"), {{"vVertexCount", 3}}).dump());
  EXPECT_EQ(v->surfaces[0].u_count, 4u);
  EXPECT_EQ(refused(without(grid(4, 3), "uVertexCount")), "missing_field /uVertexCount");
  EXPECT_EQ(refused(with(grid(4, 3), {{"vVertexCount", 4}})), "wrong_length /points");
  EXPECT_EQ(refused(with(grid(4, 3), {{"uVertexCount", 5}})), "wrong_length /points");
  EXPECT_EQ(refused(with(grid(4, 3), {{"uVertexCount", 0}})), "wrong_length /points");
  EXPECT_EQ(refused(with(grid(4, 3), {{"points", json::array()}})), "wrong_length /points");
}

TEST(surfaces, one_degree_and_wrap_hold_for_both_directions_unless_one_has_its_own) {
  const auto both = decode(with(grid(4, 3), {{"degree", 2}, {"wrap", "periodic"}}).dump());
  EXPECT_EQ(both->surfaces[0].u_degree, 2u);
  EXPECT_EQ(both->surfaces[0].v_degree, 2u);
  EXPECT_EQ(both->surfaces[0].v_wrap, CurveWrap::periodic);
  const auto one = decode(
      with(grid(4, 3), {{"vDegree", 3}, {"degree", 2}, {"uWrap", "pinned"}, {"wrap", "periodic"}}).dump());
  EXPECT_EQ(one->surfaces[0].u_degree, 2u);
  EXPECT_EQ(one->surfaces[0].v_degree, 3u);
  EXPECT_EQ(one->surfaces[0].u_wrap, CurveWrap::pinned);
  EXPECT_EQ(one->surfaces[0].v_wrap, CurveWrap::periodic);
}

TEST(surfaces, refusals_point_at_what_is_wrong) {
  const std::pair<json, const char*> cases[] = {
      {with(grid(4, 3), {{"uDegree", 4}}), "out_of_range /uDegree"},
      {with(grid(4, 3), {{"degree", 1}}), "out_of_range /degree"},
      {grid(1, 3), "too_few_points /uVertexCount"},
      {with(grid(4, 3), {{"vWrap", "nonperiodic"}}), "too_few_points /points"},
      {with(grid(4, 3), {{"uWrap", "closed"}}), "bad_enum /uWrap"},
      {with(grid(4, 3), {{"knots", {0, 1}}}), "unknown_field /knots"},
      {with(grid(4, 3), {{"basis", "bspline"}}), "unknown_field /basis"},
      {with(grid(4, 3), {{"curveVertexCounts", {12}}}), "unknown_field /curveVertexCounts"},
      {with(grid(4, 3), {{"surfaces", json::array()}}), "duplicate_field /surfaces"},
      {with(grid(4, 3), {{"type", "nurbsSurface"}}), "bad_enum /type"},
      {{{"curves", {grid(4, 3)}}}, "unknown_field /curves/0/uVertexCount"},
      {{{"curves", {without(grid(4, 3), "uVertexCount")}}}, "missing_field /curves/0/uVertexCount"},
      {{{"surfaces", {with(grid(4, 3), {{"type", "cubic"}})}}}, "unknown_field /surfaces/0/uVertexCount"},
      {{{"surfaces", {{{"type", "cubic"}, {"points", {{0, 0}, {1, 1}}}}}}}, "wrong_type /surfaces/0/type"},
      {{{"surfaces", {grid(4, 3), with(grid(4, 3), {{"vDegree", 9}})}}}, "out_of_range /surfaces/1/vDegree"},
      {{{"surfaces", {with(grid(4, 3), {{"knots", json::array()}})}}}, "unknown_field /surfaces/0/knots"},
      {{{"surfaces", 1}}, "wrong_type /surfaces"},
      {{{"surfaces", {1}}}, "wrong_type /surfaces/0"},
      {{{"points", {{0, 0}, {1, 1}}}, {"type", "cubic"}, {"uVertexCount", 2}}, "unknown_field /uVertexCount"},
  };
  for (const auto& [body, expected] : cases) EXPECT_EQ(refused(body), expected) << body;
}

TEST(surfaces, numbers_that_single_precision_cannot_hold_are_pointed_at) {
  json body = grid(4, 3);
  body["points"][5][2] = 1e39;
  EXPECT_EQ(refused(body), "accepted");
  EXPECT_EQ(refused(with(body, {{"options", {{"precision", "single"}}}})), "out_of_range /points/5/2");
}

TEST(surfaces, an_answer_is_a_valid_request_for_more) {
  for (const char* wrap : {"pinned", "periodic", "nonperiodic"})
    for (const int degree : {2, 3}) {
      const json body = with(grid(5, 4), {{"wrap", wrap}, {"degree", degree}, {"name", "hill"}});
      const json twice = answered(body, {{"level", "2"}});
      json once = answered(body, {{"level", "1"}, {"normals", "true"}});
      EXPECT_TRUE(once.contains("normals"));
      once.erase("options");
      const json again = answered(once, {{"level", "1"}});
      for (const char* member : {"points", "faceVertexIndices", "faceVertexCounts", "uVertexCount",
                                 "vVertexCount", "uDegree", "vDegree", "uWrap", "vWrap", "name", "type"})
        EXPECT_EQ(again[member], twice[member]) << wrap << degree << member;
    }
}

// Faces of a torus: every edge of one face is that of its neighbour, the other way round.
TEST(surfaces, closed_surfaces_are_watertight) {
  const json body = with(grid(4, 3), {{"wrap", "periodic"}});
  for (const auto& [faces, corners] : {std::pair{"quads", 4u}, {"triangles", 3u}}) {
    const json torus = answered(body, {{"level", "2"}, {"faces", faces}});
    EXPECT_EQ(torus.contains("faceVertexCounts"), corners == 4);
    const auto indices = torus["faceVertexIndices"].get<std::vector<int>>();
    EXPECT_EQ(indices.size(), corners == 4 ? 16u * 12 * 4 : 16u * 12 * 6);
    std::map<std::pair<int, int>, int> edges;
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const std::size_t next = i % corners + 1 == corners ? i + 1 - corners : i + 1;
      ++edges[{indices[i], indices[next]}];
    }
    for (const auto& [edge, times] : edges) {
      EXPECT_EQ(times, 1);
      EXPECT_TRUE(edges.contains({edge.second, edge.first}));
    }
  }
}

TEST(surfaces, every_width_is_refined_and_only_space_has_normals) {
  for (const int width : {1, 2, 3, 5}) {
    const json answer = answered(grid(4, 4, width), {{"normals", "true"}});
    EXPECT_EQ(answer["points"][0].size(), std::size_t(width));
    EXPECT_EQ(answer.contains("normals"), width == 3);
    EXPECT_EQ(answer.contains("warnings"), width != 3);
  }
}

TEST(surfaces, flat_points_come_back_flat) {
  json body = grid(4, 3);
  json flat = json::array();
  for (const json& point : body["points"])
    for (const json& x : point) flat.push_back(x);
  const json nested = answered(body);
  body["points"] = flat;
  const json answer = answered(body);
  EXPECT_TRUE(answer["points"][0].is_number());
  EXPECT_EQ(answer["points"].size(), 3 * nested["points"].size());
  body["points"][7] = 1e39;
  EXPECT_EQ(refused(with(body, {{"options", {{"precision", "single"}}}})), "out_of_range /points/7");
}

TEST(surfaces, sizes_are_told_before) {
  for (const char* format : {"json", "glb", "gltf"})
    for (const char* faces : {"quads", "triangles"})
      for (const char* wrap : {"pinned", "periodic"}) {
        const QueryParameters query = {
            {"level", "4"}, {"format", format}, {"faces", faces}, {"normals", "true"}};
        const std::string body = with(grid(9, 7), {{"wrap", wrap}}).dump();
        const auto request = decode(body, query);
        ASSERT_TRUE(request);
        const auto predicted = predict_refine(*request, {});
        ASSERT_TRUE(predicted);
        const auto text = answer(body, query);
        ASSERT_TRUE(text.ok()) << text.error().message;
        EXPECT_GE(predicted->answer_bytes, text->size()) << format << faces << wrap;
        EXPECT_LE(predicted->answer_bytes, 3 * text->size()) << format << faces << wrap;
      }
  const auto bomb = decode(with(grid(40, 40), {{"options", {{"level", 8}}}}).dump());
  ASSERT_TRUE(bomb);
  EXPECT_EQ(predict_refine(*bomb, {.max_output_bytes = 1 << 24}).error().code, ErrorCode::too_large);
}

TEST(surfaces, gltf_answers_hold_triangles_and_say_so) {
  const auto text = answer(grid(4, 3, 2).dump(), {{"format", "gltf"}, {"faces", "quads"}, {"level", "1"}});
  ASSERT_TRUE(text.ok()) << text.error().message;
  const json document = json::parse(*text);
  EXPECT_NE(document["asset"]["extras"]["subdivd"]["warnings"][0].get<std::string>().find("quads"),
            std::string::npos);
  const json& primitive = document["meshes"][0]["primitives"][0];
  EXPECT_EQ(primitive["mode"], 4);
  EXPECT_EQ(document["accessors"][primitive["indices"].get<int>()]["count"], 6 * 4 * 6);
  EXPECT_EQ(document["accessors"][primitive["attributes"]["POSITION"].get<int>()]["count"], 7 * 5);
  EXPECT_EQ(document["scenes"][0]["nodes"], json({0}));
}

TEST(surfaces, samples_have_a_u_and_a_v) {
  const auto refusal_of = [](const json& samples, const json& members = json::object()) {
    const json body = with(with(grid(4, 3), {{"samples", samples}}), members);
    const auto request = decode_curves(body.dump(), CurveTaskKind::evaluate, {}, {});
    if (request) return std::string("accepted");
    std::string place(name_of(request.error().code));
    for (const PathStep& step : request.error().where)
      place +=
          "/" + (std::holds_alternative<std::string>(step) ? std::get<std::string>(step)
                                                           : std::to_string(std::get<std::uint64_t>(step)));
    return place;
  };
  EXPECT_EQ(refusal_of({{"us", {0}}, {"vs", {0}}}), "accepted");
  EXPECT_EQ(refusal_of({{"us", {0}}, {"vs", {0}}}, {{"derivatives", 2}}), "accepted");
  EXPECT_EQ(refusal_of({{"us", {0}}, {"vs", {0}}}, {{"derivatives", 3}}), "out_of_range/derivatives");
  EXPECT_EQ(refusal_of({{"us", {0}}}), "missing_field/samples/vs");
  EXPECT_EQ(refusal_of({{"vs", {0}}}), "missing_field/samples/us");
  EXPECT_EQ(refusal_of({{"us", {0, 1}}, {"vs", {0}}}), "wrong_length/samples/vs");
  EXPECT_EQ(refusal_of({{"us", {0, 1}}, {"vs", {0, 1}}, {"surfaces", {0}}}), "wrong_length/samples/surfaces");
  EXPECT_EQ(refusal_of({{"us", {0}}, {"vs", {0}}, {"ts", {0}}}), "duplicate_field/samples/ts");
}

TEST(surfaces, only_refining_and_evaluating_take_them) {
  const auto convert = decode_curves(grid(4, 3).dump(), CurveTaskKind::convert, {}, {});
  ASSERT_FALSE(convert);
  EXPECT_EQ(convert.error().code, ErrorCode::unsupported);
  EXPECT_EQ(convert.error().where, Path{"type"});
  EXPECT_TRUE(decode_curves(grid(4, 3).dump(), CurveTaskKind::refine, {}, {}));
}

TEST(surfaces, a_curve_at_the_top_needs_its_type_or_basis_at_the_door_for_everything) {
  EXPECT_EQ(refused({{"type", "cubic"}, {"points", {{0, 0}, {1, 1}}}}), "accepted");
  EXPECT_EQ(refused({{"basis", "bspline"}, {"points", {{0, 0}, {1, 1}}}}), "accepted");
  EXPECT_EQ(refused({{"points", {{0, 0}, {1, 1}}}}), "wrong_length /points/0");
  EXPECT_EQ(refused({{"type", "cubic"}, {"points", {{0, 0}}}}), "too_few_points /points");
  EXPECT_EQ(refused({{"type", "cubic"}, {"points", {{0, 0}, {1, 1}}}, {"frames", true}}),
            "unknown_field /frames");
}

}  // namespace
}  // namespace subdivd::proto::test

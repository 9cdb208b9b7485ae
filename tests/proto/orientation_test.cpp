// Meshes whose faces run clockwise, seen from outside.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

using nlohmann::json;

// 3 x 3 points with waves, its faces clockwise seen from above; uv are the places of the corners.
json grid() {
  json body = {
      {"points", json::array()}, {"faceVertexIndices", json::array()}, {"orientation", "leftHanded"}};
  json values = json::array();
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x)
      body["points"].push_back({double(x), double(y), 0.25 * std::sin(2.0 * x + y)});
  const auto add = [&](int a, int b, int c) {
    for (const int v : {a, b, c}) {
      body["faceVertexIndices"].push_back(v);
      values.push_back({double(v % 3), double(v / 3)});
    }
  };
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) {
      const int a = 3 * y + x;
      add(a, a + 4, a + 1);
      add(a, a + 3, a + 4);
    }
  body["primvars"] = {{"uv", {{"interpolation", "faceVarying"}, {"values", values}}}};
  body["creaseIndices"] = {3, 4, 5};
  body["creaseLengths"] = {3};
  body["creaseSharpnesses"] = {1.5};
  body["options"] = {{"level", 2}, {"normals", true}, {"faceVaryingLinearInterpolation", "all"}};
  return body;
}

std::string bytes_of(const json& body, const QueryParameters& query = {}) {
  const auto text = answer(body.dump(), query);
  EXPECT_TRUE(text.ok()) << (text.ok() ? "" : text.error().message);
  return text.ok() ? *text : "{}";
}
json answered(const json& body, const QueryParameters& query = {}) {
  return json::parse(bytes_of(body, query));
}

json right_handed(json body) {
  body["orientation"] = "rightHanded";
  return body;
}

TEST(orientation, left_handed_normals_point_to_the_other_side_and_nothing_else_changes) {
  json left = answered(grid()), right = answered(right_handed(grid()));
  ASSERT_EQ(left["normals"].size(), 81u);
  for (std::size_t v = 0; v < left["normals"].size(); ++v) {
    EXPECT_GT(left["normals"][v][2], 0.0);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(left["normals"][v][k].get<double>(), -right["normals"][v][k].get<double>());
  }
  EXPECT_EQ(left["orientation"], "leftHanded");
  EXPECT_FALSE(right.contains("orientation"));
  for (json* one : {&left, &right}) {
    one->erase("normals");
    one->erase("orientation");
  }
  EXPECT_EQ(left, right);
}

TEST(orientation, where_there_is_no_normal_zeros_stay_zeros) {
  json body = {{"points", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}},
               {"faceVertexIndices", {0, 1, 2}},
               {"orientation", "leftHanded"},
               {"options", {{"level", 0}, {"normals", true}}}};
  const std::string text = bytes_of(body);
  EXPECT_THAT(text, testing::HasSubstr(R"("normals":[[0,0,0],[0,0,0],[0,0,0]])"));
}

TEST(orientation, an_answer_is_a_request_for_the_same_surface) {
  json once = answered(grid());
  const json again = answered(once, {{"level", "0"}, {"normals", "1"}});
  EXPECT_EQ(again["orientation"], "leftHanded");
  EXPECT_EQ(again["points"], once["points"]);
  EXPECT_EQ(again["faceVertexIndices"], once["faceVertexIndices"]);
  for (const json& normal : again["normals"]) EXPECT_GT(normal[2], 0.0);
}

TEST(orientation, stands_in_meshes_of_lists_each_for_itself) {
  json left = grid(), right = right_handed(grid());
  for (json* one : {&left, &right}) one->erase("options");
  const json both = answered({{"meshes", {left, right}}, {"options", {{"level", 1}, {"normals", true}}}});
  EXPECT_GT(both["meshes"][0]["normals"][0][2], 0.0);
  EXPECT_LT(both["meshes"][1]["normals"][0][2], 0.0);
}

TEST(orientation, holds_for_faces_that_are_split) {
  const json body = {{"points", {{0, 0, 0}, {3, 1, 0}, {4, 4, 0}, {4, 0, 0}}},
                     {"faceVertexIndices", {{0, 1, 2, 3}}},
                     {"orientation", "leftHanded"},
                     {"options", {{"level", 0}, {"normals", true}, {"triangulate", true}}}};
  const json answer = answered(body);
  EXPECT_EQ(answer["normals"].size(), 4u);
  for (const json& normal : answer["normals"]) EXPECT_EQ(normal, json({0.0, 0.0, 1.0}));
}

TEST(orientation, verifies) {
  for (const char* limit : {"0", "1"}) {
    const json report = answered(grid(), {{"verify", "1"}, {"limit", limit}, {"level", "3"}})["verification"];
    EXPECT_EQ(report["passed"], true) << report;
  }
}

TEST(orientation, other_words_are_refused_with_the_valid_ones) {
  json body = grid();
  body["orientation"] = "lefthanded";
  EXPECT_EQ(refusal(body.dump()), "bad_enum /orientation");
  EXPECT_THAT(message(body.dump()), testing::HasSubstr("rightHanded"));
  EXPECT_THAT(message(body.dump()), testing::HasSubstr("leftHanded"));
  body["orientation"] = 1;
  EXPECT_EQ(refusal(body.dump()), "wrong_type /orientation");
}

// Floats of the accessor that an attribute names, from the binary chunk of a GLB.
struct Glb {
  explicit Glb(const std::string& bytes) {
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    document = json::parse(bytes.substr(20, length));
    binary = bytes.substr(28 + length);
  }
  template <class Number>
  std::vector<Number> array(const json& accessor_number, std::size_t width) const {
    const json& accessor = document["accessors"][accessor_number.get<std::size_t>()];
    const json& view = document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    std::vector<Number> out(accessor["count"].get<std::size_t>() * width);
    std::memcpy(out.data(),
                binary.data() + view.value("byteOffset", std::size_t{0}) +
                    accessor.value("byteOffset", std::size_t{0}),
                out.size() * sizeof(Number));
    return out;
  }
  json document;
  std::string binary;
};

// glTF knows counter-clockwise faces only: triangles and normals both look up.
TEST(orientation, gltf_answers_run_counter_clockwise_with_values_on_their_corners) {
  for (const bool with_uv : {true, false}) {
    json body = grid();
    if (!with_uv) body.erase("primvars");
    const Glb glb(bytes_of(body, {{"format", "glb"}}));
    const json& primitive = glb.document["meshes"][0]["primitives"][0];
    const auto points = glb.array<float>(primitive["attributes"]["POSITION"], 3);
    const auto normals = glb.array<float>(primitive["attributes"]["NORMAL"], 3);
    const auto indices = glb.array<std::uint16_t>(primitive["indices"], 1);
    for (std::size_t v = 2; v < normals.size(); v += 3) EXPECT_GT(normals[v], 0);
    ASSERT_EQ(indices.size(), 3u * 8 * 16);
    for (std::size_t t = 0; t < indices.size(); t += 3) {
      const auto at = [&](std::size_t corner, std::size_t k) { return points[3u * indices[t + corner] + k]; };
      EXPECT_GT((at(1, 0) - at(0, 0)) * (at(2, 1) - at(0, 1)) - (at(1, 1) - at(0, 1)) * (at(2, 0) - at(0, 0)),
                0);
    }
    if (!with_uv) continue;
    // Linear values of the places: between their neighbours as the points are, but for the waves' rounding.
    const auto uv = glb.array<float>(primitive["attributes"]["TEXCOORD_0"], 2);
    ASSERT_EQ(uv.size() / 2, points.size() / 3);
    for (std::size_t v = 0; v < uv.size() / 2; ++v)
      for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(uv[2 * v + k], points[3 * v + k], 0.5);
  }
}

}  // namespace
}  // namespace subdivd::proto::test

// Which scheme refines a mesh, and what answers of quads look like.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

using nlohmann::json;

// A quad and a triangle on one edge.
json two_faces() {
  return {{"points", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0.5, 1}}},
          {"faceVertexIndices", {{0, 1, 2, 3}, {1, 4, 2}}},
          {"options", {{"level", 1}}}};
}
json cube() {
  json body = {{"points", json::array()},
               {"faceVertexIndices",
                {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}},
               {"options", {{"level", 1}}}};
  for (int v = 0; v < 8; ++v) body["points"].push_back({v & 1, v >> 1 & 1, v >> 2 & 1});
  return body;
}
json tetrahedron() {
  return {{"points", {{4, 4, 4}, {-4, -4, 4}, {-4, 4, -4}, {4, -4, -4}}},
          {"faceVertexIndices", {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}},
          {"options", {{"level", 1}}}};
}

json answered(const json& body, const QueryParameters& query = {}) {
  const auto text = answer(body.dump(), query);
  EXPECT_TRUE(text.ok()) << (text.ok() ? "" : text.error().message);
  return text.ok() ? json::parse(*text) : json::object();
}

TEST(schemes_of_meshes, follow_the_faces_where_none_is_named) {
  EXPECT_EQ(answered(tetrahedron())["subdivisionScheme"], "loop");
  EXPECT_EQ(answered(cube())["subdivisionScheme"], "catmullClark");
  EXPECT_EQ(answered(two_faces())["subdivisionScheme"], "catmullClark");
  EXPECT_EQ(answered(two_faces(), {{"triangulate", "true"}})["subdivisionScheme"], "loop");
}

TEST(schemes_of_meshes, are_the_meshs_own_and_the_options_before_that) {
  json body = tetrahedron();
  body["subdivisionScheme"] = "catmullClark";
  EXPECT_EQ(answered(body)["subdivisionScheme"], "catmullClark");
  EXPECT_EQ(answered(body, {{"subdivisionScheme", "bilinear"}})["subdivisionScheme"], "bilinear");
  body["options"]["subdivisionScheme"] = "loop";
  const json by_option = answered(body);
  EXPECT_EQ(by_option["subdivisionScheme"], "loop");
  EXPECT_EQ(by_option["options"]["subdivisionScheme"], "loop");
}

TEST(schemes_of_meshes, answer_with_quads_and_count_them) {
  const json refined = answered(cube());
  EXPECT_EQ(refined["faceVertexCounts"], json(std::vector<int>(24, 4)));
  EXPECT_EQ(refined["faceVertexIndices"].size(), 24u);
  for (const json& face : refined["faceVertexIndices"]) EXPECT_EQ(face.size(), 4u);
  EXPECT_EQ(refined["points"].size(), 26u);
  // Halstead, Kass, DeRose: (n - 2) / n v + 1 / n^2 (e + f) at a corner of the cube.
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(refined["points"][0][axis].get<double>(), 2.0 / 9, 1e-15);
  const json& statistics = refined["statistics"]["meshes"][0];
  EXPECT_EQ(statistics["subdivisionScheme"], "catmullClark");
  EXPECT_EQ(statistics["levels"][1], json({{"level", 1}, {"vertices", 26}, {"edges", 48}, {"quads", 24}}));
  EXPECT_EQ(statistics["output"], json({{"points", 26}, {"quads", 24}}));
}

TEST(schemes_of_meshes, keep_polygons_at_level_0) {
  const json same = answered(two_faces(), {{"level", "0"}});
  EXPECT_EQ(same["faceVertexCounts"], json({4, 3}));
  EXPECT_EQ(same["faceVertexIndices"], json({0, 1, 2, 3, 1, 4, 2}));
  EXPECT_EQ(same["statistics"]["meshes"][0]["levels"][0],
            json({{"level", 0}, {"vertices", 5}, {"edges", 6}, {"faces", 2}}));
}

TEST(schemes_of_meshes, answer_what_can_be_asked_again) {
  for (const json& body : {cube(), two_faces(), tetrahedron()})
    for (const char* level : {"0", "1"}) {
      const json once = answered(body, {{"level", level}});
      const json twice = answered(once, {{"level", "1"}});
      EXPECT_EQ(twice["subdivisionScheme"], once["subdivisionScheme"]);
    }
}

TEST(schemes_of_meshes, read_the_rule_of_triangles) {
  json body = two_faces();
  const json standard = answered(body);
  body["triangleSubdivisionRule"] = "smooth";
  const json smooth = answered(body);
  EXPECT_EQ(smooth["triangleSubdivisionRule"], "smooth");
  EXPECT_FALSE(standard.contains("triangleSubdivisionRule"));
  EXPECT_NE(smooth["points"], standard["points"]);
  body["triangleSubdivisionRule"] = "round";
  const auto refused = answer(body.dump(), {});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::bad_enum);
}

// The chunks of a GLB: its document, and the first buffer.
json document_of(const std::string& glb, std::string& bin) {
  std::uint32_t length = 0;
  std::memcpy(&length, &glb[12], 4);
  if (glb.size() > 20 + length) bin = glb.substr(28 + length);
  return json::parse(glb.substr(20, length));
}

TEST(schemes_of_meshes, cut_quads_for_gltf_from_their_first_corner_on) {
  for (const json& body : {cube(), two_faces()})
    for (const char* level : {"0", "1", "2"}) {
      const json quads = answered(body, {{"level", level}});
      const auto glb = answer(body.dump(), {{"level", level}, {"format", "glb"}});
      ASSERT_TRUE(glb.ok()) << glb.error().message;
      std::string bin;
      const json document = document_of(*glb, bin);
      const json& primitive = document["meshes"][0]["primitives"][0];
      const json& accessor = document["accessors"][primitive["indices"].get<std::size_t>()];
      ASSERT_EQ(accessor["componentType"], 5123);
      const std::size_t offset =
          document["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteOffset"];
      std::vector<int> indices, expected;
      for (std::size_t k = 0; k < accessor["count"].get<std::size_t>(); ++k) {
        std::uint16_t index = 0;
        std::memcpy(&index, &bin[offset + 2 * k], 2);
        indices.push_back(index);
      }
      std::vector<int> corners;
      for (const json& row : quads["faceVertexIndices"])
        if (row.is_array())
          corners.insert(corners.end(), row.begin(), row.end());
        else
          corners.push_back(row);
      std::size_t first = 0;
      for (const int size : quads["faceVertexCounts"].get<std::vector<int>>()) {
        for (int k = 1; k + 1 < size; ++k)
          expected.insert(expected.end(), {corners[first], corners[first + static_cast<std::size_t>(k)],
                                           corners[first + static_cast<std::size_t>(k) + 1]});
        first += static_cast<std::size_t>(size);
      }
      EXPECT_EQ(indices, expected) << level;
      EXPECT_EQ(document["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()]["count"],
                quads["points"].size());
    }
}

// Nothing that is promised before the work falls short of what comes.
TEST(schemes_of_meshes, of_quads_are_predicted) {
  json body = two_faces();
  body["primvars"] = {{"st",
                       {{"interpolation", "faceVarying"},
                        {"values", {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {5, 5}, {6, 5}, {5, 6}}}}},
                      {"id", {{"interpolation", "uniform"}, {"values", {7, 9}}}}};
  for (const char* level : {"0", "1", "3"}) {
    const json refined = answered(body, {{"level", level}, {"normals", "true"}, {"limit", "true"}});
    const std::size_t faces = refined["faceVertexCounts"].size();
    EXPECT_EQ(refined["primvars"]["id"]["values"].size(), faces);
    std::size_t corners = 0;
    for (const int size : refined["faceVertexCounts"].get<std::vector<int>>())
      corners += static_cast<std::size_t>(size);
    EXPECT_EQ(refined["primvars"]["st"]["indices"].size(), corners);
    EXPECT_EQ(refined["normals"].size(), refined["points"].size());
  }
}

TEST(schemes_of_meshes, that_opensubdiv_has_may_be_verified) {
  for (const char* scheme : {"catmullClark", "bilinear"})
    EXPECT_EQ(refusal(cube().dump(), {{"verify", "true"}, {"subdivisionScheme", scheme}}), "accepted")
        << scheme;
}

}  // namespace
}  // namespace subdivd::proto::test

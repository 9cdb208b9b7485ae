// faces=triangles and faces=quads, of meshes.
#include "proto/cut_faces.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

using nlohmann::json;

// A quad, a pentagon and a triangle with everything that hangs on faces and corners.
json mixed() {
  return json::parse(R"({
    "points": [[0,0,0],[1,0,0],[1,1,0.2],[0,1,0],[2,0,0],[2.5,0.5,0.1],[2,1,0],[-1,0.5,0.3]],
    "faceVertexIndices": [[0,1,2,3],[1,4,5,6,2],[0,3,7]],
    "primvars": {
      "id": {"interpolation": "uniform", "elementSize": 2, "values": [[10,1],[11,2],[12,3]]},
      "st": {"interpolation": "faceVarying", "values": [[0,0],[1,0],[1,1],[0,1],[5,0],[6,0],[7,1],[6,2],[5,1],[0,0],[0,1],[9,9]],
             "indices": [0,1,2,3,4,5,6,7,8,9,10,11]},
      "heat": {"interpolation": "vertex", "values": [0,1,2,3,4,5,6,7]}}})");
}

json answered(const json& body, const QueryParameters& query) {
  const auto text = answer(body.dump(), query);
  EXPECT_TRUE(text.ok()) << text.error().message;
  return text.ok() ? json::parse(*text) : json();
}

// The corners of the faces, one after the other, as those of the triangles that they are cut into.
json cut_corners(const json& corners, const json& counts) {
  json cut = json::array();
  std::size_t first = 0;
  for (const std::size_t count : counts) {
    for (std::size_t k = 1; k + 1 < count; ++k)
      for (const std::size_t corner : {std::size_t{0}, k, k + 1}) cut.push_back(corners[first + corner]);
    first += count;
  }
  return cut;
}

json flat(const json& nested) {
  json all = json::array();
  for (const json& one : nested)
    if (one.is_array())
      for (const json& value : one) all.push_back(value);
    else
      all.push_back(one);
  return all;
}

TEST(faces, triangles_are_the_same_faces_cut_from_their_first_corner) {
  for (const char* level : {"0", "1", "2"})
    for (const char* scheme : {"catmullClark", "bilinear"}) {
      json body = mixed();
      body["holeIndices"] = {1};
      for (const bool hole : {true, false}) {
        if (!hole) body.erase("holeIndices");
        const QueryParameters plain = {{"level", level}, {"subdivisionScheme", scheme}, {"normals", "true"}};
        QueryParameters cutting = plain;
        cutting.push_back({"faces", "triangles"});
        const json whole = answered(body, plain), cut = answered(body, cutting);
        const json& counts = whole["faceVertexCounts"];
        EXPECT_FALSE(cut.contains("faceVertexCounts"));
        EXPECT_EQ(flat(cut["faceVertexIndices"]), cut_corners(flat(whole["faceVertexIndices"]), counts));
        EXPECT_EQ(cut["primvars"]["st"]["indices"], cut_corners(whole["primvars"]["st"]["indices"], counts));
        EXPECT_EQ(cut["primvars"]["st"]["values"], whole["primvars"]["st"]["values"]);
        EXPECT_EQ(cut["primvars"]["heat"], whole["primvars"]["heat"]);
        json repeated = json::array();
        for (std::size_t f = 0; f < counts.size(); ++f)
          for (std::size_t k = 2; k < counts[f].get<std::size_t>(); ++k)
            repeated.push_back(whole["primvars"]["id"]["values"][f]);
        EXPECT_EQ(cut["primvars"]["id"]["values"], repeated);
        EXPECT_EQ(cut["points"], whole["points"]);
        EXPECT_EQ(cut["normals"], whole["normals"]);
        EXPECT_EQ(cut["statistics"]["meshes"][0]["output"]["triangles"], repeated.size());
        EXPECT_EQ(cut["options"]["faces"], "triangles");
      }
    }
}

TEST(faces, triangles_are_those_of_a_gltf_answer) {
  json body = mixed();
  body.erase("primvars");
  for (const char* level : {"0", "1", "3"}) {
    const json cut = answered(body, {{"level", level}, {"faces", "triangles"}});
    const json gltf = answered(body, {{"level", level}, {"format", "gltf"}});
    EXPECT_EQ(flat(cut["faceVertexIndices"]).size(),
              gltf["accessors"][gltf["meshes"][0]["primitives"][0]["indices"].get<std::size_t>()]["count"]);
  }
}

TEST(faces, triangles_leave_triangles_as_they_are) {
  json whole = answered(json::parse(kTriangle), {{"level", "2"}}),
       cut = answered(json::parse(kTriangle), {{"level", "2"}, {"faces", "triangles"}});
  whole.erase("options");
  cut.erase("options");
  EXPECT_EQ(whole, cut);
}

TEST(faces, quads_are_what_comes_by_default) {
  for (const char* level : {"0", "2"}) {
    json whole = answered(mixed(), {{"level", level}}),
         quads = answered(mixed(), {{"level", level}, {"faces", "quads"}});
    EXPECT_EQ(quads["options"]["faces"], "quads");
    whole.erase("options");
    quads.erase("options");
    EXPECT_EQ(whole, quads);
  }
}

TEST(faces, quads_are_refused_by_a_scheme_of_triangles) {
  EXPECT_EQ(refusal(kTriangle, {{"faces", "quads"}}), "unsupported ?faces");
  const std::string said = message(kTriangle, {{"faces", "quads"}});
  EXPECT_NE(said.find("loop"), std::string::npos) << said;
  json body = json::parse(kTriangle);
  body["options"]["faces"] = "quads";
  EXPECT_EQ(refusal(body.dump()), "unsupported /options/faces");
  EXPECT_EQ(refusal(body.dump(), {{"subdivisionScheme", "catmullClark"}}), "accepted");
}

// Surfaces have the word, too, and an answer's options are a valid request's.
TEST(faces, quads_of_surfaces_beside_meshes_of_triangles_are_accepted) {
  json surface = {{"type", "bsplineSurface"}, {"uVertexCount", 4}, {"points", json::array()}};
  for (int k = 0; k < 16; ++k) surface["points"].push_back({k % 4, k / 4, k % 3});
  json body = {{"meshes", {json::parse(kTriangle)}}, {"surfaces", {surface}}};
  const json first = answered(body, {{"level", "1"}});
  EXPECT_EQ(first["options"]["faces"], "quads");
  body["options"] = first["options"];
  EXPECT_EQ(refusal(body.dump()), "accepted");
}

TEST(faces, of_gltf_answers_are_triangles_with_a_warning) {
  const json gltf = answered(mixed(), {{"level", "1"}, {"faces", "quads"}, {"format", "gltf"}});
  const json& ours = gltf["asset"]["extras"]["subdivd"];
  EXPECT_NE(ours["warnings"].dump().find("ngons"), std::string::npos);
  EXPECT_EQ(ours["options"]["faces"], "triangles");
}

TEST(faces, cut_are_predicted) {
  for (const char* level : {"0", "1", "3"}) {
    const QueryParameters query = {{"level", level}, {"faces", "triangles"}};
    const auto request = decode(mixed().dump(), query);
    ASSERT_TRUE(request.ok());
    const auto predicted = predict_refine(*request, {});
    ASSERT_TRUE(predicted.ok());
    const auto text = answer(mixed().dump(), query);
    ASSERT_TRUE(text.ok());
    EXPECT_GE(predicted->answer_bytes, text->size());
    const auto whole = predict_refine(*decode(mixed().dump(), {{"level", level}}), {});
    EXPECT_GT(predicted->answer_bytes, whole->answer_bytes);
    EXPECT_GT(predicted->working_bytes, whole->working_bytes);
  }
}

// Values of faces are written as often as there are triangles: with wide ones they are the larger part.
TEST(faces, cut_are_predicted_with_wide_values) {
  json body = mixed();
  json wide = json::array();
  for (int f = 0; f < 3; ++f) {
    json one = json::array();
    for (int k = 0; k < 200; ++k) one.push_back(-1.2345678901234567e-101 * (k + 1));
    wide.push_back(one);
  }
  body["primvars"] = {{"wide", {{"interpolation", "uniform"}, {"values", wide}}}};
  const QueryParameters query = {{"level", "2"}, {"faces", "triangles"}};
  const auto request = decode(body.dump(), query);
  ASSERT_TRUE(request.ok());
  EXPECT_GE(predict_refine(*request, {})->answer_bytes, answer(body.dump(), query)->size());
  const RefinedSize before = *predict_size<double>(request->meshes[0], mesh_options(*request)),
                    cut = cut_size(before);
  EXPECT_EQ(cut.counts.faces, 2 * before.counts.faces);
  EXPECT_EQ(cut.corners, 6 * before.counts.faces);
  EXPECT_EQ(cutting_bytes(request->meshes[0], cut, 8),
            cut.corners * sizeof(Index) + cut.counts.faces * 200 * sizeof(double));
}

TEST(faces, cut_take_base_faces_along) {
  const auto request = decode(mixed().dump(), {{"level", "0"}});
  RefineOptions options = mesh_options(*request);
  options.provenance = true;
  auto mesh = refine<double>(request->meshes[0], options, {});
  ASSERT_TRUE(mesh.ok());
  ASSERT_TRUE(cut_faces(*mesh, {}).ok());
  EXPECT_EQ(std::vector<Index>(mesh->base_faces.begin(), mesh->base_faces.end()),
            (std::vector<Index>{0, 0, 1, 1, 1, 2}));
  EXPECT_EQ(mesh->face_count, 6u);
  EXPECT_EQ(mesh->provenance.size(), 8u);
}

}  // namespace
}  // namespace subdivd::proto::test

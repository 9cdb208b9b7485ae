// Answers as OFF.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/proto/text/written.h"
#include "tests/shapes/build.h"

namespace subdivd::proto::test {
namespace {

using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

const std::string kTriangle3 = R"("points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2])";
const std::string kColors =
    R"("displayColor":{"interpolation":"vertex","values":[[1,0,0],[0,1,0],[0,0,0.5]]})";
const std::string kSt = R"("st":{"interpolation":"vertex","values":[[0,0],[1,0],[0,1]]})";

QueryParameters off(const char* level, bool normals = false) {
  return {{"format", "off"}, {"level", level}, {"normals", normals ? "true" : "false"}};
}

TEST(write_off, a_mesh_is_its_counts_points_and_faces) {
  EXPECT_EQ(written("{" + kTriangle3 + "}", off("0")), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
}

TEST(write_off, the_first_word_says_what_points_have) {
  EXPECT_THAT(written("{" + kTriangle3 + R"(,"primvars":{)" + kColors + "}}", off("0")),
              StartsWith("COFF\n3 1 0\n0 0 0 1.0 0.0 0.0\n1 0 0 0.0 1.0 0.0\n0 1 0 0.0 0.0 0.5\n"));
  EXPECT_THAT(written("{" + kTriangle3 + R"(,"primvars":{)" + kSt + "}}", off("0")),
              StartsWith("STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 1 0\n"));
  const std::string all =
      written("{" + kTriangle3 + R"(,"primvars":{)" + kSt + "," + kColors + "}}", off("0", true));
  EXPECT_THAT(all, StartsWith("STCNOFF\n3 1 0\n0 0 0 "));
  EXPECT_THAT(all, HasSubstr(" 1.0 0.0 0.0 0 0\n"));
  const RefineRequest read = read_again(all);
  EXPECT_THAT(read.meshes.at(0).primvars, SizeIs(2));
}

TEST(write_off, colours_of_faces_stand_behind_them) {
  EXPECT_THAT(
      written("{" + kTriangle3 +
                  R"(,"primvars":{"displayColor":{"interpolation":"uniform","values":[[1,0,0,0.5]]}}})",
              off("0")),
      testing::EndsWith("3 0 1 2 1.0 0.0 0.0 0.5\n"));
}

// All of them whole and one above 1: they would be read as going to 255.
TEST(write_off, whole_colours_are_not_read_as_bytes) {
  const std::string text = written(
      "{" + kTriangle3 +
          R"(,"primvars":{"displayColor":{"interpolation":"vertex","values":[[2,0,0],[0,1,0],[0,-3,1]]}}})",
      off("0"));
  EXPECT_EQ(read_again(text).meshes.at(0).primvars.at(0).values,
            (std::vector<double>{2, 0, 0, 0, 1, 0, 0, -3, 1}));
}

TEST(write_off, meshes_are_joined) {
  const std::string text = written("{\"meshes\":[{" + kTriangle3 + R"(,"primvars":{)" + kColors + "}},{" +
                                       kTriangle3 + R"(,"primvars":{)" + kColors + "}}]}",
                                   off("0"));
  EXPECT_THAT(text, StartsWith("COFF\n# an OFF is one mesh: all 2 are joined, without their names\n6 2 0\n"));
  EXPECT_THAT(text, testing::EndsWith("3 0 1 2\n3 3 4 5\n"));
  const std::string other = written(
      "{\"meshes\":[{" + kTriangle3 + R"(,"primvars":{)" + kColors + "}},{" + kTriangle3 + "}]}", off("0"));
  EXPECT_THAT(other, StartsWith("OFF\n# primvar \"displayColor\" is left out"));
}

TEST(write_off, curves_are_refused_with_what_would_hold_them) {
  const auto request = decode(R"({"points":[[0,0,0],[1,0,0],[0,1,0]],"type":"cubic"})", off("1"));
  ASSERT_TRUE(request.ok()) << request.error().message;
  const auto refused = check_format(*request, off("1"));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
  EXPECT_EQ(refused.error().where, Path{"?format"});
  EXPECT_THAT(refused.error().message, HasSubstr("format obj"));
  EXPECT_EQ(encode_refine(*request, *compute(*request)).error().code, ErrorCode::unsupported);
}

TEST(write_off, surfaces_are_faces_without_normals_where_not_all_have_them) {
  const std::string flat = R"({"uVertexCount":2,"points":[[0,0],[1,0],[0,1],[1,1]]})";
  const std::string deep = R"({"uVertexCount":2,"points":[[0,0,0],[1,0,0],[0,1,0],[1,1,0]]})";
  const std::string text = written("{\"surfaces\":[" + flat + "," + deep + "]}", off("0", true));
  EXPECT_THAT(text, StartsWith("OFF\n"));
  EXPECT_THAT(text, HasSubstr("normals are left out"));
  EXPECT_THAT(text, testing::EndsWith("4 0 1 3 2\n4 4 5 7 6\n"));
  EXPECT_THAT(read_again(text).meshes.at(0).points, SizeIs(24));
}

template <class Real>
void expect_round_trip(Index level, Precision precision) {
  RefineRequest request;
  request.meshes = {shapes::cube()};
  ControlMesh& mesh = request.meshes[0];
  mesh.primvars.push_back(shapes::plain_primvar(mesh, "displayColor", Interpolation::vertex, 4));
  mesh.primvars.push_back(shapes::plain_primvar(mesh, "st", Interpolation::vertex, 2));
  request.options.level = level;
  request.options.normals = true;
  request.options.precision = precision;
  request.options.format = Format::off;
  const auto computed = compute(request);
  ASSERT_TRUE(computed.ok());
  const RefinedMesh<Real>& refined = std::get<RefineAnswer<Real>>(*computed).meshes[0];
  const RefineRequest again = read_again(written(request));
  const ControlMesh& read = again.meshes.at(0);
  EXPECT_TRUE(same_bits(read.points, refined.points));
  EXPECT_TRUE(std::ranges::equal(read.face_vertex_indices, refined.faces));
  EXPECT_EQ(read.primvars.at(0).name, "displayColor");
  EXPECT_TRUE(same_bits(read.primvars.at(0).values, refined.primvars[0].values));
  EXPECT_TRUE(same_bits(read.primvars.at(1).values, refined.primvars[1].values));
}

TEST(write_off, what_was_written_reads_back_to_the_bit) {
  for (const Index level : {0u, 2u, 5u}) {
    expect_round_trip<double>(level, Precision::double_precision);
    expect_round_trip<float>(level, Precision::single_precision);
  }
}

}  // namespace
}  // namespace subdivd::proto::test

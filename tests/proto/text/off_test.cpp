// OFF bodies: what is read, what is refused and in which line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "tests/proto/support.h"
#include "tests/proto/text/support.h"

namespace subdivd::proto::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::string_view kTetrahedron = R"(OFF
4 4 6
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
)";

std::string refusal_of(std::string_view body, const QueryParameters& query = {}) {
  return text_refusal(body, BodyKind::unspecified, query);
}

RefineRequest read(std::string_view body, const QueryParameters& query = {}) {
  auto request = decode_refine(body, BodyKind::unspecified, query, {});
  EXPECT_TRUE(request.ok()) << request.error().message;
  return request ? *std::move(request) : RefineRequest{};
}

const ControlMesh& mesh_of(const RefineRequest& request) { return request.meshes.at(0); }

TEST(off, a_mesh_is_read_without_a_content_type) {
  const RefineRequest request = read(kTetrahedron);
  EXPECT_THAT(mesh_of(request).points, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1));
  EXPECT_THAT(mesh_of(request).face_vertex_indices, ElementsAre(0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3));
  EXPECT_THAT(mesh_of(request).face_vertex_counts, IsEmpty());
  EXPECT_THAT(request.warnings, IsEmpty());
}

TEST(off, the_answer_is_that_of_the_same_mesh_in_json) {
  const std::string json =
      R"({"points":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]],"faceVertexIndices":[0,2,1,0,1,3,0,3,2,1,2,3]})";
  const auto of_off = encode_refine(read(kTetrahedron), *compute(read(kTetrahedron)));
  ASSERT_TRUE(of_off.ok());
  const auto of_json = encode_refine(*decode(json), *compute(*decode(json)));
  ASSERT_TRUE(of_json.ok());
  std::string texts[2];
  for (const Chunk& chunk : of_off->chunks)
    texts[0].append(reinterpret_cast<const char*>(chunk.bytes.data()), chunk.bytes.size());
  for (const Chunk& chunk : of_json->chunks)
    texts[1].append(reinterpret_cast<const char*>(chunk.bytes.data()), chunk.bytes.size());
  EXPECT_EQ(texts[0], texts[1]);
}

TEST(off, an_answer_as_glb_is_made) {
  const RefineRequest request = read(kTetrahedron, {{"format", "glb"}});
  const auto payload = encode_refine(request, *compute(request));
  ASSERT_TRUE(payload.ok()) << payload.error().message;
  EXPECT_EQ(payload->content_type, "model/gltf-binary");
}

TEST(off, blanks_comments_and_ends_of_lines_do_not_matter) {
  const RefineRequest request = read(
      "\xEF\xBB\xBF# a\r\n\r\nOFF # b\r\n\t# c\r\n3 1 # no edges\r\n\r\n0 0 0 # d\r\n\t1\t0 0\r\n# e\r\n "
      "0 1 0\r\n3 0 1 2 # f");
  EXPECT_THAT(mesh_of(request).points, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
  EXPECT_THAT(mesh_of(request).face_vertex_indices, ElementsAre(0, 1, 2));
}

TEST(off, the_header_may_have_the_counts_and_be_left_out) {
  const std::string rest = "3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2";
  EXPECT_EQ(refusal_of("OFF " + rest), "accepted");
  EXPECT_EQ(refusal_of(rest), "accepted");
  EXPECT_EQ(text_refusal(rest, BodyKind::off), "accepted");
}

TEST(off, numbers_are_read_to_the_last_bit) {
  const RefineRequest request =
      read("OFF 3 1 0\n0.1 -2.5e-3 +7\n1e-400 3.14159265358979312 .5\n1 2 3.\n3 0 1 2\n");
  EXPECT_THAT(mesh_of(request).points, ElementsAre(0.1, -2.5e-3, 7, 0, 3.14159265358979312, 0.5, 1, 2, 3));
}

TEST(off, larger_faces_are_kept_or_split) {
  const std::string body = "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 2 2\n4 0 1 2 3\n3 0 1 4\n";
  EXPECT_THAT(mesh_of(read(body)).face_vertex_counts, ElementsAre(4, 3));
  EXPECT_THAT(refusal_of(body, {{"subdivisionScheme", "loop"}}), HasSubstr("set triangulate to true"));
  const RefineRequest request = read(body, {{"triangulate", "true"}});
  EXPECT_THAT(mesh_of(request).face_vertex_indices, ElementsAre(0, 1, 2, 0, 2, 3, 0, 1, 4));
}

TEST(off, a_face_may_have_a_hundred_thousand_corners) {
  constexpr int kCorners = 100000;
  std::string body = "OFF " + std::to_string(kCorners) + " 1 0\n", face = std::to_string(kCorners);
  for (int k = 0; k < kCorners; ++k) {
    body += std::to_string(k) + " 0 " + std::to_string(k % 7) + '\n';
    face += ' ' + std::to_string(k);
  }
  const RefineRequest request = read(body + face, {{"triangulate", "true"}});
  EXPECT_EQ(mesh_of(request).face_count(), kCorners - 2u);
}

TEST(off, colours_of_vertices_are_a_primvar_from_0_to_1) {
  const RefineRequest request =
      read("COFF\n3 1 0\n0 0 0 255 0 51 255\n1 0 0 0 0 0 0\n0 1 0 0 255 0 255\n3 0 1 2\n");
  ASSERT_EQ(mesh_of(request).primvars.size(), 1u);
  const Primvar& color = mesh_of(request).primvars[0];
  EXPECT_EQ(color.name, "displayColor");
  EXPECT_EQ(color.interpolation, Interpolation::vertex);
  EXPECT_EQ(color.element_size, 4u);
  EXPECT_THAT(color.values, ElementsAre(1, 0, 0.2, 1, 0, 0, 0, 0, 0, 1, 0, 1));
}

TEST(off, colours_with_fractions_stay) {
  const RefineRequest request = read("COFF\n3 1 0\n0 0 0 1 0 .5\n1 0 0 0 0 0\n0 1 0 1 1 1\n3 0 1 2\n");
  EXPECT_THAT(mesh_of(request).primvars.at(0).values, ElementsAre(1, 0, 0.5, 0, 0, 0, 1, 1, 1));
}

TEST(off, texture_coordinates_follow_normals_and_colours) {
  const RefineRequest request = read(
      "STCNOFF\n3 1 0\n0 0 0 0 0 1 .1 .2 .3 .4 .5\n1 0 0 0 0 1 0 0 0 1 0\n0 1 0 0 0 1 1 1 1 0 1\n3 0 1 2\n");
  ASSERT_EQ(mesh_of(request).primvars.size(), 2u);
  EXPECT_THAT(mesh_of(request).primvars[0].values, ElementsAre(.1, .2, .3, 0, 0, 0, 1, 1, 1));
  EXPECT_EQ(mesh_of(request).primvars[1].name, "st");
  EXPECT_THAT(mesh_of(request).primvars[1].values, ElementsAre(.4, .5, 1, 0, 0, 1));
}

TEST(off, normals_are_left_out) {
  const RefineRequest request = read("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n");
  EXPECT_THAT(mesh_of(request).points, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
  EXPECT_THAT(mesh_of(request).primvars, IsEmpty());
}

const std::string kFourPoints = "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";

TEST(off, colours_of_all_faces_are_a_uniform_primvar) {
  const RefineRequest request = read(kFourPoints + "3 0 1 2 255 0 0\n3 0 2 3 0 51 0\n");
  ASSERT_EQ(mesh_of(request).primvars.size(), 1u);
  EXPECT_EQ(mesh_of(request).primvars[0].interpolation, Interpolation::uniform);
  EXPECT_THAT(mesh_of(request).primvars[0].values, ElementsAre(1, 0, 0, 0, 0.2, 0));
}

TEST(off, colours_of_some_faces_are_left_out_with_a_warning) {
  for (const char* faces :
       {"3 0 1 2 255 0 0\n3 0 2 3\n", "3 0 1 2 1\n3 0 2 3 2\n", "3 0 1 2 1 0 0\n3 0 2 3 1 0 0 1\n"}) {
    const RefineRequest request = read(kFourPoints + faces);
    EXPECT_THAT(mesh_of(request).primvars, IsEmpty());
    EXPECT_THAT(request.warnings, ElementsAre(HasSubstr("colours of faces are left out"))) << faces;
  }
}

TEST(off, other_kinds_of_off_are_refused_by_name) {
  EXPECT_THAT(refusal_of("OFF BINARY\n"), HasSubstr("unsupported line 1: OFF BINARY"));
  EXPECT_THAT(refusal_of("4OFF\n3 1 0\n"), HasSubstr("unsupported line 1: \"4OFF\""));
  EXPECT_THAT(refusal_of("STCN4nOFF\n3\n3 1 0\n"), HasSubstr("unsupported line 1:"));
}

TEST(off, counts_that_lie_are_refused_with_their_line_before_memory_is_taken) {
  for (const char* counts :
       {"1000000000000 1 0", "3 4000000000 0", "9223372036854775807 9223372036854775807 0"})
    EXPECT_THAT(refusal_of("OFF\n# c\n" + std::string(counts) + "\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
                testing::MatchesRegex("(wrong_length|too_large) line 3: .*"));
  EXPECT_THAT(refusal_of("OFF\n-3 1 0\n"),
              HasSubstr("out_of_range line 2: the number of vertices is below 0"));
  EXPECT_THAT(refusal_of("OFF\n99999999999999999999 1 0\n"), HasSubstr("out_of_range line 2"));
}

TEST(off, lines_that_are_missing_or_too_many_are_refused) {
  EXPECT_THAT(refusal_of("OFF\n4 1 0\n0 0 0.000\n1 0 0.00\n0 1 0.00 # room\n"),
              HasSubstr("wrong_length line 6: the body ends after 3 of the 4 vertices that line 2 counts"));
  EXPECT_THAT(refusal_of("OFF\n3 2 0\n0 0 0.0000\n1 0 0.0000\n0 1 0.0000\n3 0 1 2\n"),
              HasSubstr("wrong_length line 7: the body ends after 1 of the 2 faces"));
  EXPECT_THAT(refusal_of("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n\n3 0 1 2\n"),
              HasSubstr("wrong_length line 8: follows the last of the 1 faces"));
}

TEST(off, faults_of_vertices_name_their_line) {
  for (const BadLine& bad :
       {BadLine{"1 0", "wrong_length line 4: the line ends where a coordinate must stand"},
        BadLine{"1 0 x", "wrong_type line 4: \"x\" is no number"},
        BadLine{"1 0 1,5", "wrong_type line 4: \"1,5\" is no number"},
        BadLine{"1 0 0x1", "wrong_type line 4"}, BadLine{"1 0 nan", "not_finite line 4"},
        BadLine{"1 0 -inf", "not_finite line 4"}, BadLine{"1 0 1e999", "not_finite line 4"},
        BadLine{"1 0 0 5", "wrong_length line 4: \"5\" follows the numbers of a vertex"}})
    EXPECT_THAT(refusal_of("OFF\n3 1 0\n0 0 0\n" + std::string(bad.line) + "\n0 1 0\n3 0 1 2\n"),
                HasSubstr(bad.expected));
}

TEST(off, faults_of_faces_name_their_line) {
  for (const BadLine& bad :
       {BadLine{"3 0 1 9", "out_of_range line 7: face index 9 is past the 4 points"},
        BadLine{"3 0 1 -1", "out_of_range line 7: face index -1 is below 0"},
        BadLine{"3 0 1 4294967298", "out_of_range line 7: face index 4294967298 is past"},
        BadLine{"3 0 1 9223372036854775808", "out_of_range line 7: face index \"9223372036854775808\""},
        BadLine{"3 0 1", "wrong_length line 7: the line ends where face index must stand"},
        BadLine{"3 0 1 2.0", "wrong_type line 7"}, BadLine{"2 0 1", "not_a_triangle line 7"},
        BadLine{"100000 0 1 2", "wrong_length line 7: a face of 100000 vertices does not fit"},
        BadLine{"3 0 1 2 1 1", "wrong_length line 7: behind the indices of a face"},
        BadLine{"3 0 1 2 256 0 0", "out_of_range line 7: a colour"}})
    EXPECT_THAT(refusal_of(kFourPoints + bad.line + "\n3 0 1 2\n"), HasSubstr(bad.expected));
}

TEST(off, faults_of_the_mesh_name_the_mesh) {
  EXPECT_THAT(refusal_of("OFF 3 0 0\n0 0 0\n1 0 0\n0 1 0\n"),
              HasSubstr("mesh 0: faceVertexIndices: is empty"));
}

TEST(off, degenerate_faces_are_left_out_with_a_warning) {
  const RefineRequest request = read(kFourPoints + "3 0 1 1\n3 0 1 2\n");
  EXPECT_THAT(request.warnings, ElementsAre(HasSubstr("mesh 0: 1 face repeats a vertex")));
}

TEST(off, colours_of_different_width_are_refused) {
  EXPECT_THAT(refusal_of("COFF\n3 1 0\n0 0 0 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1\n3 0 1 2\n"),
              HasSubstr("wrong_length line 4: a colour has 3 or 4 numbers"));
}

TEST(off, a_long_word_is_refused_and_a_long_comment_is_not) {
  EXPECT_THAT(refusal_of("OFF\n3 1 0\n0 0 " + std::string(5000, '1') + "\n"), HasSubstr("too_large line 3"));
  EXPECT_EQ(refusal_of("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0 #" + std::string(100'000'000, 'x') + "\n3 0 1 2\n"),
            "accepted");
}

TEST(off, every_beginning_is_answered) { decode_beginnings(kTetrahedron, BodyKind::off); }

TEST(off, reading_stops_when_nobody_waits) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_THAT(text_refusal(kTetrahedron, BodyKind::off, {}, budget), HasSubstr("cancelled"));
}

}  // namespace
}  // namespace subdivd::proto::test

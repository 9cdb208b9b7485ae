// OBJ bodies: what is read, what is refused and in which line.

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
using testing::SizeIs;

const std::string kFourPoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

std::string refusal_of(std::string_view body, const QueryParameters& query = {}) {
  return text_refusal(body, BodyKind::unspecified, query);
}

RefineRequest read(std::string_view body, const QueryParameters& query = {}) {
  auto request = decode_refine(body, BodyKind::unspecified, query, {});
  EXPECT_TRUE(request.ok()) << request.error().message;
  return request ? *std::move(request) : RefineRequest{};
}

TEST(obj, a_mesh_is_read_with_and_without_its_type) {
  EXPECT_EQ(text_refusal(kFourPoints + "f 1 2 3", BodyKind::obj), "accepted");
  const RefineRequest request = read(kFourPoints + "f 1 3 2\nf 1 2 4");
  ASSERT_THAT(request.meshes, SizeIs(1));
  EXPECT_TRUE(request.single_mesh_at_top);
  EXPECT_THAT(request.meshes[0].points, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1));
  EXPECT_THAT(request.meshes[0].face_vertex_indices, ElementsAre(0, 2, 1, 0, 1, 3));
  EXPECT_THAT(request.warnings, IsEmpty());
}

TEST(obj, numbers_are_read_to_the_last_bit) {
  const RefineRequest request =
      read("v 0.1 -2.5e-3 +7\nv 1e-400 3.14159265358979312 .5\nv 1 2 3.\nf 1 2 3\n");
  EXPECT_THAT(request.meshes.at(0).points,
              ElementsAre(0.1, -2.5e-3, 7, 0, 3.14159265358979312, 0.5, 1, 2, 3));
}

TEST(obj, blanks_comments_continuations_and_ends_of_lines_do_not_matter) {
  const RefineRequest request =
      read("# a \\\r\n\r\nv\t0 0 \\\r\n 0 # b\r\nv 1 0\\\n 0\nv 0 1 0 \r\n  # c\r\nf 1 \\\n \\\n2 3");
  EXPECT_THAT(request.meshes.at(0).points, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
  EXPECT_THAT(request.meshes.at(0).face_vertex_indices, ElementsAre(0, 1, 2));
}

TEST(obj, indices_below_zero_count_back_and_those_of_later_points_are_taken) {
  const RefineRequest request = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nf 1 4 2\nv 0 0 1\nf -1 -3 -2\n");
  EXPECT_THAT(request.meshes.at(0).face_vertex_indices, ElementsAre(0, 1, 2, 0, 3, 1, 3, 1, 2));
}

TEST(obj, larger_faces_are_kept_or_split) {
  const std::string body = kFourPoints + "f 1 2 3 4\nf 1 3 2\n";
  EXPECT_THAT(read(body).meshes.at(0).face_vertex_counts, ElementsAre(4, 3));
  EXPECT_THAT(refusal_of(body, {{"subdivisionScheme", "loop"}}), HasSubstr("set triangulate to true"));
  EXPECT_THAT(read(body, {{"triangulate", "1"}}).meshes.at(0).face_vertex_indices,
              ElementsAre(0, 1, 2, 0, 2, 3, 0, 2, 1));
}

TEST(obj, a_face_may_have_a_hundred_thousand_corners) {
  std::string body, face = "f";
  for (int k = 1; k <= 100000; ++k) {
    body += "v " + std::to_string(k) + " 0 " + std::to_string(k % 7) + '\n';
    face += ' ' + std::to_string(k);
  }
  EXPECT_EQ(read(body + face, {{"triangulate", "true"}}).meshes.at(0).face_count(), 99998u);
}

TEST(obj, texture_coordinates_are_a_face_varying_primvar) {
  const RefineRequest request =
      read(kFourPoints + "vt 0 .5\nvt 1\nvt .25 1 9\nvn 0 0 1\nf 1/1 2/2 3/3\nf 1/3/1 3/-2/1 4/1/-1\n");
  ASSERT_THAT(request.meshes.at(0).primvars, SizeIs(1));
  const Primvar& st = request.meshes[0].primvars[0];
  EXPECT_EQ(st.name, "st");
  EXPECT_EQ(st.interpolation, Interpolation::face_varying);
  EXPECT_EQ(st.element_size, 2u);
  EXPECT_THAT(st.values, ElementsAre(0, .5, 1, 0, .25, 1));
  EXPECT_THAT(st.indices, ElementsAre(0, 1, 2, 2, 1, 0));
}

TEST(obj, texture_coordinates_at_some_corners_only_are_left_out_with_a_warning) {
  const RefineRequest request = read(kFourPoints + "vt 0 0\nf 1/1 2/1 3/1\nf 1 3 4\n");
  EXPECT_THAT(request.meshes.at(0).primvars, IsEmpty());
  EXPECT_THAT(request.warnings, ElementsAre(HasSubstr("some corners only")));
}

TEST(obj, normals_may_stand_without_texture_coordinates) {
  EXPECT_THAT(read(kFourPoints + "vn 0 0 1\nf 1//1 2//1 3//-1\n").meshes.at(0).primvars, IsEmpty());
}

TEST(obj, colours_are_a_vertex_primvar_where_all_points_have_one) {
  const RefineRequest request = read("v 0 0 0 1 0 0\nv 1 0 0 0 .5 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
  ASSERT_THAT(request.meshes.at(0).primvars, SizeIs(1));
  EXPECT_EQ(request.meshes[0].primvars[0].name, "displayColor");
  EXPECT_THAT(request.meshes[0].primvars[0].values, ElementsAre(1, 0, 0, 0, .5, 0, 0, 0, 1));
  const RefineRequest other = read("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 1\nf 1 2 3\n");
  EXPECT_THAT(other.meshes.at(0).primvars, IsEmpty());
  EXPECT_THAT(other.warnings, ElementsAre(HasSubstr("colours of points are left out")));
}

// Room for the colours was counted as the words beyond three of each point: less than nothing, here.
TEST(obj, a_colour_before_points_without_numbers_is_no_reason_to_fail) {
  EXPECT_THAT(refusal_of("v 0 0 0 1 0 0\nv\nv 1\nf 1 2 3\n"), HasSubstr("wrong_length line 2"));
}

TEST(obj, every_object_is_a_mesh_of_the_points_that_it_uses) {
  const RefineRequest request = read("o first one\n" + kFourPoints +
                                     "vt 0 0\nvt 1 1\nf 1 4 2\no empty\no second\nv 5 5 5\nf 5/2 2/1 3/2\n");
  ASSERT_THAT(request.meshes, SizeIs(2));
  EXPECT_EQ(request.meshes[0].name, "first one");
  EXPECT_EQ(request.meshes[1].name, "second");
  EXPECT_THAT(request.meshes[0].points, ElementsAre(0, 0, 0, 1, 0, 0, 0, 0, 1));
  EXPECT_THAT(request.meshes[0].face_vertex_indices, ElementsAre(0, 2, 1));
  EXPECT_THAT(request.meshes[1].points, ElementsAre(1, 0, 0, 0, 1, 0, 5, 5, 5));
  EXPECT_THAT(request.meshes[1].face_vertex_indices, ElementsAre(2, 0, 1));
  EXPECT_THAT(request.meshes[1].primvars.at(0).values, ElementsAre(0, 0, 1, 1));
  EXPECT_THAT(request.meshes[1].primvars.at(0).indices, ElementsAre(1, 0, 1));
}

TEST(obj, a_mesh_alone_keeps_all_points) {
  EXPECT_THAT(read("o a\n" + kFourPoints + "f 1 2 4\n").meshes.at(0).points, SizeIs(12));
}

TEST(obj, lines_are_cubic_curves) {
  const RefineRequest request = read("o a\n" + kFourPoints + "vt 0 0\nl 1 2 3\nl 4/1 -4\n");
  ASSERT_THAT(request.curves, SizeIs(1));
  EXPECT_EQ(request.curves[0].name, "a");
  EXPECT_THAT(request.curves[0].vertex_counts, ElementsAre(3, 2));
  EXPECT_THAT(request.curves[0].points, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0));
  EXPECT_THAT(request.meshes, IsEmpty());
}

TEST(obj, tags_are_read) {
  const RefineRequest request =
      read(kFourPoints +
           "f 1 2 3\nf 1 3 4\nt crease 2/1/0 0 2 2.5\nt corner 1/1/0 3 10\nt hole 1/0/0 1\n"
           "t interpolateboundary 1/0/0 2\nt facevaryinginterpolateboundary 1/0/0 4\n"
           "t creasemethod 0/0/1 chaikin\n");
  const ControlMesh& mesh = request.meshes.at(0);
  EXPECT_THAT(mesh.crease_indices, ElementsAre(0, 2));
  EXPECT_THAT(mesh.crease_lengths, ElementsAre(2));
  EXPECT_THAT(mesh.crease_sharpnesses, ElementsAre(2.5f));
  EXPECT_THAT(mesh.corner_indices, ElementsAre(3));
  EXPECT_THAT(mesh.corner_sharpnesses, ElementsAre(10.f));
  EXPECT_THAT(mesh.hole_indices, ElementsAre(1));
  EXPECT_EQ(mesh.interpolate_boundary, BoundaryInterpolation::edge_only);
  EXPECT_EQ(mesh.face_varying_linear_interpolation, FaceVaryingInterpolation::boundaries);
  EXPECT_EQ(request.options.crease_method, CreaseMethod::chaikin);
}

TEST(obj, tags_choose_the_rule_of_triangles) {
  const std::string face = kFourPoints + "f 1 2 3\n";
  EXPECT_EQ(read(face).meshes.at(0).triangle_subdivision_rule, TriangleRule::catmull_clark);
  EXPECT_EQ(read(face + "t smoothtriangles 0/0/1 smooth\n").meshes.at(0).triangle_subdivision_rule,
            TriangleRule::smooth);
  EXPECT_EQ(read(face + "t smoothtriangles 0/0/1 catmark\n").meshes.at(0).triangle_subdivision_rule,
            TriangleRule::catmull_clark);
  EXPECT_THAT(refusal_of(face + "t smoothtriangles 0/0/1 round\n"),
              HasSubstr("bad_enum line 6: \"round\" is no rule of smoothtriangles: catmark or smooth"));
  EXPECT_THAT(refusal_of(face + "t smoothtriangles 1/0/0 1\n"), HasSubstr("wrong_length line 6"));
}

TEST(obj, the_query_wins_over_tags) {
  const RefineRequest request =
      read(kFourPoints + "f 1 2 3\nt interpolateboundary 1/0/0 2\nt creasemethod 0/0/1 chaikin\n",
           {{"interpolateBoundary", "none"}, {"creaseMethod", "uniform"}});
  EXPECT_EQ(request.meshes.at(0).interpolate_boundary, BoundaryInterpolation::none);
  EXPECT_EQ(request.options.crease_method, CreaseMethod::uniform);
}

TEST(obj, tags_belong_to_the_object_in_which_they_stand) {
  const std::string two = kFourPoints + "o a\nf 1 2 3\no b\nf 2 3 4\n";
  const RefineRequest request = read(two + "t crease 2/1/0 3 2 1\nt corner 1/1/0 1 4\nt hole 1/0/0 1\n");
  EXPECT_THAT(request.meshes.at(0).crease_indices, IsEmpty());
  EXPECT_THAT(request.meshes.at(1).crease_indices, ElementsAre(2, 1));
  EXPECT_THAT(request.meshes.at(1).corner_indices, ElementsAre(0));
  EXPECT_THAT(request.meshes.at(1).hole_indices, ElementsAre(0));
  EXPECT_THAT(refusal_of(two + "t corner 1/1/0 0 4\n"),
              HasSubstr("out_of_range line 9: point 0 does not belong"));
  EXPECT_THAT(refusal_of(two + "t hole 1/0/0 0\n"), HasSubstr("out_of_range line 9: face 0 does not belong"));
}

TEST(obj, what_is_not_kept_is_named) {
  EXPECT_THAT(read("mtllib a.mtl\n" + kFourPoints + "g a b\nusemtl m\ns 1\nf 1 2 3\n").warnings,
              ElementsAre(HasSubstr("smoothing groups")));
  EXPECT_THAT(read(kFourPoints + "f 1 2 3\np 1\n").warnings, ElementsAre(HasSubstr("are left out")));
  EXPECT_THAT(read(kFourPoints + "f 1 2 3\nt vertexedit 0/0/1 set\n").warnings,
              ElementsAre(HasSubstr("tags of hierarchical edits are left out")));
}

TEST(obj, faults_name_their_line) {
  for (const BadLine& bad :
       {BadLine{"v 1 2", "wrong_length line 5: the line ends where a coordinate must stand"},
        BadLine{"v 1 2 x", "wrong_type line 5: \"x\" is no number"},
        BadLine{"v 1 2 nan", "not_finite line 5"},
        BadLine{"v 1 2 1e999", "not_finite line 5"},
        BadLine{"v 1 2 3 4 5", "wrong_length line 5: a point has 3 numbers"},
        BadLine{"v 1 2 3 4 5 6 7", "wrong_length line 5: a point has 3 numbers"},
        BadLine{"vt", "wrong_length line 5"},
        BadLine{"f 1 2 9", "out_of_range line 5: face index 9 is past the 4 points"},
        BadLine{"f 1 2 0", "out_of_range line 5: face index 0: OBJ counts from 1"},
        BadLine{"f 1 2 -5", "out_of_range line 5: face index -5 is before the first of the 4 points so far"},
        BadLine{"f 1 2 2147483649", "out_of_range line 5: face index 2147483649 is past"},
        BadLine{"f 1 2 4294967297", "out_of_range line 5: face index 4294967297 is past"},
        BadLine{"f 1 2 -9223372036854775808", "out_of_range line 5"},
        BadLine{"f 1 2 9223372036854775808", "out_of_range line 5"},
        BadLine{"f 1 2", "not_a_triangle line 5: a face of 2 vertices"},
        BadLine{"f 1 2 3x", "wrong_type line 5"},
        BadLine{"f 1/ 2/ 3/", "wrong_length line 5"},
        BadLine{"f 1/1 2/1 3/1", "out_of_range line 5: texture index 1 is past the 0"},
        BadLine{"f 1//1 2//1 3//1", "out_of_range line 5: normal index 1 is past the 0"},
        BadLine{"f 1/1/1/1 2 3", "line 5"},
        BadLine{"l 1", "too_few_points line 5"},
        BadLine{"vertex 1 2 3", "malformed line 5: \"vertex\" begins no line of an OBJ"},
        BadLine{"t creese 2/1/0 0 1 3", "bad_enum line 5: \"creese\" is no tag; did you mean \"crease\"?"},
        BadLine{"t crease 2/1/0 0 1", "wrong_length line 5: the line ends where a tag's number"},
        BadLine{"t crease 2/1 0 1 3", "wrong_length line 5"},
        BadLine{"t crease 3/1/0 0 1 2 3", "wrong_length line 5: the tag crease does not take"},
        BadLine{"t crease 9223372036854775807/1/0 0", "wrong_length line 5: the tag counts more"},
        BadLine{"t crease -1/1/0 0", "wrong_length line 5"},
        BadLine{"t crease 2/1/0 0 1 3 4", "wrong_length line 5: \"4\" follows"},
        BadLine{"t crease 2/1/0 0 9 3", "out_of_range line 5: point 9 is past the 4 points"},
        BadLine{"t corner 1/1/0 0 -1", "out_of_range line 5: sharpness must be 0 or more"},
        BadLine{"t hole 1/0/0 7", "out_of_range line 5: face 7 is past the 2 faces"},
        BadLine{"t interpolateboundary 1/0/0 3", "bad_enum line 5"},
        BadLine{"t facevaryinginterpolateboundary 1/0/0 6", "bad_enum line 5"},
        BadLine{"t creasemethod 0/0/1 uniform", "bad_enum line 5"}}) {
    // One line of a face more, so that two are there where the bad line is none.
    const std::string body = kFourPoints + bad.line + "\nf 1 2 3\nf 1 3 4\n";
    EXPECT_THAT(refusal_of(body), HasSubstr(bad.expected)) << bad.line;
  }
}

TEST(obj, faults_of_the_mesh_name_the_mesh) {
  EXPECT_THAT(refusal_of("o vase\n" + kFourPoints + "f 1 2 3\nt crease 2/1/0 0 3 1\n"),
              HasSubstr("not_an_edge mesh 0 (\"vase\"): creaseIndices[1]: points 0 and 3 share no edge"));
}

TEST(obj, a_body_without_faces_and_lines_is_refused) {
  EXPECT_THAT(refusal_of(kFourPoints), HasSubstr("missing_field"));
  EXPECT_THAT(refusal_of("# nothing"), HasSubstr("missing_field"));
}

TEST(obj, a_million_objects_are_read_in_linear_time_and_taken_from_the_budget) {
  std::string body = kFourPoints;
  for (int k = 0; k < 1'000'000; ++k) body += "o\nf 1 2 3\n";
  struct Counter : MemoryGrant {
    Count taken = 0;
    Result<void> take(Count bytes) override {
      taken += bytes;
      return Error{ErrorCode::overloaded, "no memory"};
    }
  } counter;
  Budget budget;
  budget.memory = &counter;
  EXPECT_THAT(text_refusal(body, BodyKind::obj, {}, budget), HasSubstr("overloaded"));
  EXPECT_GT(counter.taken, 1'000'000 * (sizeof(ControlMesh) + 48));
  EXPECT_EQ(refusal_of(body), "accepted");
}

TEST(obj, a_long_comment_is_read_and_a_long_name_refused) {
  EXPECT_EQ(refusal_of('#' + std::string(100'000'000, 'x') + '\n' + kFourPoints + "f 1 2 3\n"), "accepted");
  EXPECT_THAT(refusal_of("o " + std::string(5000, 'x') + '\n' + kFourPoints + "f 1 2 3\n"),
              HasSubstr("too_large line 1"));
  EXPECT_THAT(refusal_of(kFourPoints + "f 1 2 " + std::string(5000, '3') + '\n'),
              HasSubstr("too_large line 5"));
}

TEST(obj, every_beginning_is_answered) {
  decode_beginnings("o a\n" + kFourPoints +
                        "vt 0 1\nvn 0 0 1\nf 1/1/1 2/1/1 \\\r\n 3/-1/1\nl 1 2\no b\nf 1 2 4\n" +
                        "t crease 2/1/0 0 1 3\nt creasemethod 0/0/1 chaikin\n",
                    BodyKind::obj);
}

TEST(obj, reading_stops_when_nobody_waits) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_THAT(text_refusal(kFourPoints + "f 1 2 3\n", BodyKind::obj, {}, budget), HasSubstr("cancelled"));
}

}  // namespace
}  // namespace subdivd::proto::test

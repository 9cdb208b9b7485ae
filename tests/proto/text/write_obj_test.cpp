// Answers as OBJ: every line, and that reading them gives the same mesh.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <string>
#include <vector>

#include "proto/text/line_text.h"
#include "tests/proto/text/written.h"
#include "tests/shapes/build.h"

namespace subdivd::proto::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

const std::string kSquare =
    R"({"name":"square","points":[[0,0,0],[1,0,0],[1,1,0],[0,1,0.1]],"faceVertexCounts":[4],"faceVertexIndices":[0,1,2,3]})";

QueryParameters obj(const char* level, std::vector<std::pair<std::string, std::string>> more = {}) {
  more.emplace_back("format", "obj");
  more.emplace_back("level", level);
  return more;
}

TEST(write_obj, a_mesh_is_an_object_of_points_and_faces) {
  EXPECT_EQ(written(kSquare, obj("0")), "o square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.1\nf 1 2 3 4\n");
}

TEST(write_obj, normals_texture_coordinates_and_colours_stand_in_their_lines) {
  const std::string text = written(
      R"({"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2],"primvars":{
        "displayColor":{"interpolation":"vertex","values":[[1,0,0],[0,1,0],[0,0,0.5]]},
        "st":{"interpolation":"faceVarying","values":[[0,0],[1,0.25]],"indices":[1,0,1]}}})",
      obj("0", {{"normals", "true"}}));
  EXPECT_THAT(text,
              StartsWith("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 0.5\nvt 0 0\nvt 1 0.25\nvt 1 0.25\nvn "));
  EXPECT_THAT(text, testing::EndsWith("\nf 1/2/1 2/1/2 3/3/3\n"));
}

TEST(write_obj, texture_coordinates_of_points_are_numbered_as_the_points_are) {
  EXPECT_THAT(written(R"({"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2],"primvars":{
                "st":{"interpolation":"vertex","values":[[0,0],[1,0],[0,1]]}}})",
                      obj("0")),
              testing::EndsWith("f 1/1 2/2 3/3\n"));
}

TEST(write_obj, normals_alone_leave_a_gap_for_texture_coordinates) {
  EXPECT_THAT(written(kSquare, obj("0", {{"normals", "true"}})),
              testing::EndsWith("f 1//1 2//2 3//3 4//4\n"));
}

TEST(write_obj, numbers_run_over_the_whole_file) {
  const std::string triangle = R"("points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2])";
  EXPECT_EQ(written("{\"meshes\":[{\"name\":\"a\"," + triangle + "},{" + triangle + "}]}", obj("0")),
            "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 4 5 6\n");
}

TEST(write_obj, curves_are_lines_and_closed_ones_end_where_they_begin) {
  const std::string points = R"("type":"linear","points":[[0,0,0],[1,0,0],[0,1,0]])";
  EXPECT_EQ(written("{\"curves\":[{\"name\":\"c\"," + points + "},{\"wrap\":\"periodic\"," + points + "}]}",
                    obj("0")),
            "# a line knows no wrap: closed curves end with the point they begin with\n"
            "o c\nv 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\no\nv 0 0 0\nv 1 0 0\nv 0 1 0\nl 4 5 6 4\n");
}

TEST(write_obj, points_of_two_numbers_lie_in_the_plane) {
  EXPECT_THAT(written(R"({"type":"linear","points":[[1,2],[3,4]]})", obj("0")),
              StartsWith("v 1 2 0\nv 3 4 0\nl 1 2\n"));
  EXPECT_THAT(written(R"({"type":"linear","points":[[1,2,3,9],[3,4,5,9]]})", obj("0")),
              StartsWith("# of points of more than 3 numbers the first 3 are written\nv 1 2 3\n"));
}

TEST(write_obj, surfaces_are_objects_of_quads_or_triangles) {
  const std::string surface =
      R"({"type":"bsplineSurface","uVertexCount":2,"points":[[0,0,0],[1,0,0],[0,1,0],[1,1,0]]})";
  EXPECT_EQ(written(surface, obj("0")), "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4 3\n");
  EXPECT_THAT(written(surface, obj("0", {{"faces", "triangles"}})), HasSubstr("f 1 2 4\nf 1 4 3\n"));
  EXPECT_THAT(written(surface, obj("1", {{"normals", "true"}})), HasSubstr("vn 0 0 1\n"));
}

TEST(write_obj, limits_stand_in_the_place_of_points) {
  const std::string text = written(kSquare, obj("1", {{"limit", "true"}}));
  const auto request = decode(kSquare, {{"level", "1"}, {"limit", "true"}});
  const auto answer = compute(*request);
  EXPECT_TRUE(same_bits(read_again(text).meshes.at(0).points,
                        std::get<RefineAnswer<double>>(*answer).meshes[0].limit_points));
}

TEST(write_obj, faces_of_holes_are_left_out) {
  std::string holed = kSquare;
  holed.replace(holed.find("\"faceVertexCounts\":[4]"), 22, R"("holeIndices":[1],"faceVertexCounts":[3,3])");
  holed.replace(holed.find("[0,1,2,3]"), 9, "[0,1,2,0,2,3]");
  EXPECT_THAT(written(holed, obj("0")), testing::EndsWith("f 1 2 3\n"));
  EXPECT_THAT(written(holed, obj("0")), Not(HasSubstr("f 1 3 4")));
}

TEST(write_obj, left_handed_faces_are_turned) {
  std::string left = kSquare;
  left.insert(1, "\"orientation\":\"leftHanded\",");
  EXPECT_THAT(written(left, obj("0")), testing::EndsWith("f 1 4 3 2\n"));
}

TEST(write_obj, what_has_no_place_is_named_in_a_comment) {
  const std::string text = written(
      R"({"name":"m","points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2],"primvars":{
        "heat\nv 1 2 3":{"interpolation":"vertex","values":[1,2,3]},
        "width":{"interpolation":"constant","values":[1]},
        "displayColor":{"interpolation":"vertex","values":[[1,0,0,1],[0,1,0,1],[0,0,1,1]]}}})",
      obj("0"));
  EXPECT_THAT(text,
              HasSubstr("# primvar \"displayColor\" of mesh \"m\" is written without its fourth number\n"));
  EXPECT_THAT(text, HasSubstr("(and 1 more) is left out: an OBJ holds"));
  EXPECT_THAT(text, HasSubstr("\"heat_v 1 2 3\""));
  EXPECT_THAT(read_again(text).meshes.at(0).points, SizeIs(9));
}

TEST(write_obj, no_name_begins_a_line) {
  using text::line_text;
  EXPECT_EQ(line_text("a\nv 1 2 3"), "a_v 1 2 3");
  EXPECT_EQ(line_text(" \t two  words \r\n"), "two  words");
  EXPECT_EQ(line_text("a\rb\tc\x01"
                      "d\x7F"),
            "a_b_c_d_");
  EXPECT_EQ(line_text("Würfel 立方体 🧊"), "Würfel 立方体 🧊");
  EXPECT_EQ(line_text("a\u0085"
                      "b\u2028"
                      "c\u2029"
                      "d"),
            "a_b_c_d");
  EXPECT_EQ(line_text("a\xFF\xC0\xAF\xED\xA0\x80"
                      "b"),
            "a______b");
  EXPECT_EQ(line_text("back\\"), "back_");
  EXPECT_EQ(line_text("\xE7\xAB"), "__");
  EXPECT_EQ(line_text(""), "");
  EXPECT_EQ(line_text("\n\r\n"), "");
}

TEST(write_obj, names_are_cut_to_what_is_read_at_a_boundary_of_characters) {
  const std::string name(4095, 'x');
  EXPECT_EQ(text::line_text(name + "ü"), name);
  EXPECT_EQ(text::line_text(name + "yz"), name + "y");
}

TEST(write_obj, names_read_back) {
  const std::string mesh = R"("points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2]})";
  const std::string text =
      written(R"({"meshes":[{"name":"a\nb",)" + mesh + R"(,{"name":"",)" + mesh +
                  R"(,{"name":"  # ünder \\",)" + mesh + R"(,{"name":"\u2028",)" + mesh + "]}",
              obj("1"));
  std::vector<std::string> names;
  for (const ControlMesh& read : read_again(text).meshes) names.push_back(read.name);
  EXPECT_THAT(names, ElementsAre("a_b", "", "# ünder _", "_"));
}

template <class Real>
void expect_same(const ControlMesh& read, const RefinedMesh<Real>& mesh) {
  EXPECT_TRUE(same_bits(read.points, mesh.points));
  EXPECT_TRUE(std::ranges::equal(read.face_vertex_indices, mesh.faces));
  if (mesh.face_size == 3) {
    EXPECT_TRUE(read.face_vertex_counts.empty());
  } else {
    EXPECT_EQ(read.face_vertex_counts.size(), mesh.face_count);
  }
}

RefineRequest rich_request(Index level, Precision precision) {
  RefineRequest request;
  request.meshes = {shapes::cube(), shapes::torus(7, 9), shapes::double_pyramid(5)};
  for (ControlMesh& mesh : request.meshes) {
    mesh.primvars.push_back(shapes::seamed(mesh, "st", 2, {}));
    mesh.primvars.push_back(shapes::plain_primvar(mesh, "displayColor", Interpolation::vertex, 3));
  }
  request.meshes[0].name = "cube";
  request.options.level = level;
  request.options.format = Format::obj;
  request.options.precision = precision;
  return request;
}

template <class Real>
void expect_round_trip(Index level, Precision precision) {
  const RefineRequest request = rich_request(level, precision);
  const auto computed = compute(request);
  ASSERT_TRUE(computed.ok()) << computed.error().message;
  const auto& answer = std::get<RefineAnswer<Real>>(*computed);
  const RefineRequest read = read_again(written(request));
  ASSERT_THAT(read.meshes, SizeIs(answer.meshes.size()));
  for (std::size_t i = 0; i < answer.meshes.size(); ++i) {
    expect_same(read.meshes[i], answer.meshes[i]);
    ASSERT_THAT(read.meshes[i].primvars, SizeIs(2));
    const Primvar &color = read.meshes[i].primvars[0], &st = read.meshes[i].primvars[1];
    EXPECT_EQ(color.name, "displayColor");
    EXPECT_TRUE(same_bits(color.values, answer.meshes[i].primvars[1].values));
    EXPECT_TRUE(same_bits(st.values, answer.meshes[i].primvars[0].values));
    EXPECT_TRUE(std::ranges::equal(st.indices, answer.meshes[i].primvars[0].indices));
  }
  EXPECT_EQ(read.meshes[0].name, "cube");
}

TEST(write_obj, what_was_written_reads_back_to_the_bit) {
  for (const Index level : {0u, 1u, 3u}) {
    expect_round_trip<double>(level, Precision::double_precision);
    expect_round_trip<float>(level, Precision::single_precision);
  }
}

TEST(write_obj, extreme_numbers_read_back_to_the_bit) {
  RefineRequest request;
  request.meshes = {shapes::tetrahedron()};
  request.meshes[0].points = {-0.0,
                              5e-324,
                              1e300,
                              2.2250738585072014e-308,
                              -1.7976931348623157e301,
                              0.1,
                              1e22,
                              123456789.0,
                              1.0 / 3,
                              4.9e-320,
                              1,
                              -1};
  request.options.level = 0;
  request.options.format = Format::obj;
  const RefineRequest read = read_again(written(request));
  EXPECT_TRUE(same_bits(read.meshes.at(0).points,
                        Buffer<double>(request.meshes[0].points.begin(), request.meshes[0].points.end())));
}

Count points_of(const RefineRequest& request) {
  Count points = 0;
  const auto answer = compute(request);
  for (const RefinedMesh<double>& mesh : std::get<RefineAnswer<double>>(*answer).meshes)
    points += mesh.points.size() / 3;
  return points;
}

// Beyond a megabyte the text is made while it is sent; a face of a hundred thousand corners is longer than a piece.
TEST(write_obj, long_answers_are_made_while_they_are_sent) {
  RefineRequest request = rich_request(5, Precision::double_precision);
  ControlMesh polygon;
  constexpr Index kCorners = 100'000;
  for (Index k = 0; k < kCorners; ++k) {
    polygon.points.insert(polygon.points.end(), {double(k), double(k) * k, 0.5});
    polygon.face_vertex_indices.push_back(k);
  }
  polygon.face_vertex_counts = {kCorners};
  polygon.subdivision_scheme = "catmullClark";
  RefineRequest flat;
  flat.meshes = {polygon, polygon};
  flat.options.level = 0;
  flat.options.format = Format::obj;
  for (const RefineRequest& long_request : {request, flat}) {
    const auto answer = compute(long_request);
    ASSERT_TRUE(answer.ok());
    const auto payload = encode_refine(long_request, *answer);
    ASSERT_TRUE(payload.ok());
    ASSERT_THAT(payload->chunks, SizeIs(1));
    ASSERT_TRUE(payload->chunks[0].maker);
    EXPECT_GT(payload->size(), 2'000'000u);
    // What it is made from, not what it is: 4 bytes an index, 8 a number.
    EXPECT_LT(payload->chunks[0].maker->held_bytes(), 500'000 + 150 * points_of(long_request));
    Count longest = 0, total = 0;
    for (std::span<const std::byte> piece; !(piece = payload->chunks[0].maker->next()).empty();) {
      longest = std::max<Count>(longest, piece.size());
      total += piece.size();
    }
    EXPECT_EQ(total, payload->size());
    EXPECT_LE(longest, 200'000u);
  }
  const RefineRequest read = read_again(written(flat));
  ASSERT_THAT(read.meshes, SizeIs(2));
  EXPECT_EQ(read.meshes[1].points, polygon.points);
  EXPECT_EQ(read.meshes[1].face_vertex_indices, polygon.face_vertex_indices);
}

TEST(write_obj, an_answer_over_the_limit_is_refused_before_it_is_refined) {
  Limits limits;
  limits.max_output_bytes = 10'000;
  const RefineRequest request = rich_request(5, Precision::double_precision);
  const auto predicted = predict_refine(request, limits);
  ASSERT_FALSE(predicted.ok());
  EXPECT_EQ(predicted.error().code, ErrorCode::too_large);
  EXPECT_EQ(predicted.error().allowed, 10'000u);
}

// The size of the text is known by walking through it once, which takes as long as making it.
TEST(write_obj, a_request_that_nobody_waits_for_is_not_written_to_its_end) {
  const RefineRequest request = rich_request(4, Precision::double_precision);
  const auto answer = compute(request);
  ASSERT_TRUE(answer.ok());
  const std::atomic<bool> gone = true;
  Budget cancelled;
  cancelled.cancelled = &gone;
  EXPECT_EQ(encode_refine(request, *answer, cancelled).error().code, ErrorCode::cancelled);
  Budget late;
  late.deadline = std::chrono::steady_clock::now() - std::chrono::seconds(1);
  EXPECT_EQ(encode_refine(request, *answer, late).error().code, ErrorCode::deadline_exceeded);
}

TEST(write_obj, numbers_that_are_not_finite_are_never_written) {
  const RefineRequest request = rich_request(1, Precision::double_precision);
  const auto answer = compute(request);
  for (const double bad :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    AnyAnswer spoilt = *answer;
    auto& mesh = std::get<RefineAnswer<double>>(spoilt).meshes[1];
    mesh.primvars[0].values.back() = bad;
    EXPECT_EQ(encode_refine(request, std::move(spoilt)).error().code, ErrorCode::not_finite);
  }
}

TEST(write_obj, the_report_of_verify_has_no_place) {
  auto request = rich_request(1, Precision::double_precision);
  request.options.verify = true;
  for (const Format format : {Format::obj, Format::off}) {
    request.options.format = format;
    const auto refused = check_format(request, {{"verify", "true"}});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
    EXPECT_EQ(refused.error().where, Path{"?verify"});
    EXPECT_THAT(refused.error().message, HasSubstr("/v1/verify"));
  }
}

TEST(write_obj, objects_keep_their_colours_beside_others_without) {
  const RefineRequest read = read_again(
      "o a\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\no b\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 4 5 6\n");
  EXPECT_THAT(read.meshes.at(0).primvars, SizeIs(1));
  EXPECT_THAT(read.meshes.at(1).primvars, SizeIs(0));
  EXPECT_THAT(read.warnings, SizeIs(0));
}

TEST(write_obj, a_mesh_beside_curves_has_its_own_points) {
  const RefineRequest read =
      read_again("o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no b\nv 5 5 5\nv 6 6 6\nl 4 5\n");
  EXPECT_THAT(read.meshes.at(0).points, SizeIs(9));
  EXPECT_THAT(read.curves.at(0).points, SizeIs(6));
}

}  // namespace
}  // namespace subdivd::proto::test

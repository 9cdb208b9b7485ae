// Every refusal of a JSON body: its code and the pointer to what is wrong.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

struct Case {
  const char* name;
  std::string body;
  const char* expected;  // "code pointer"
};
void PrintTo(const Case& refused, std::ostream* out) { *out << refused.body; }

class refusals : public testing::TestWithParam<Case> {};

TEST_P(refusals, names_the_code_and_the_place) { EXPECT_EQ(refusal(GetParam().body), GetParam().expected); }

TEST_P(refusals, says_it_in_a_sentence) { EXPECT_GE(message(GetParam().body).size(), 15u); }

// The triangle with further members.
std::string with(const std::string& members) {
  return R"({"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2],)" + members + "}";
}
std::string primvar(const std::string& members) { return with(R"("primvars":{"a/b":{)" + members + "}}"); }
std::string curve(const std::string& members) { return R"({"curves":[{)" + members + "}]}"; }

std::string name_of_case(const testing::TestParamInfo<Case>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(
    document, refusals,
    testing::Values(
        Case{"empty", "", "malformed "}, Case{"white_space", " \n ", "malformed "},
        Case{"no_json", "hello", "malformed "}, Case{"array", "[]", "wrong_type "},
        Case{"number", "17", "wrong_type "}, Case{"string", R"("mesh")", "wrong_type "},
        Case{"null", "null", "wrong_type "}, Case{"nothing_to_refine", "{}", "missing_field "},
        Case{"only_options", R"({"options":{"level":1}})", "missing_field "},
        Case{"unknown_member", R"({"mesh":[]})", "unknown_field /mesh"},
        Case{"member_twice", R"({"name":"a","name":"b"})", "duplicate_field /name"},
        Case{"member_twice_by_escape", R"({"name":"a","n\u0061me":"b"})", "duplicate_field /name"},
        Case{"meshes_twice", R"({"meshes":[],"meshes":[]})", "duplicate_field /meshes"},
        Case{"meshes_and_a_mesh", R"({"meshes":[],"points":[],"faceVertexIndices":[]})",
             "duplicate_field /meshes"},
        Case{"meshes_no_array", R"({"meshes":{}})", "wrong_type /meshes"},
        Case{"mesh_no_object", R"({"meshes":[[]]})", "wrong_type /meshes/0"},
        Case{"mesh_null", R"({"meshes":[null]})", "wrong_type /meshes/0"},
        Case{"curves_no_array", R"({"curves":1})", "wrong_type /curves"},
        Case{"trailing_text", std::string(kTriangle) + "x", "malformed "},
        Case{"trailing_object", std::string(kTriangle) + "{}", "malformed "},
        Case{"trailing_bracket", std::string(kTriangle) + "}", "malformed "},
        Case{"trailing_comma", R"({"points":[[0,0,0],],"faceVertexIndices":[]})", "malformed /points/1"},
        Case{"missing_colon", R"({"points" [0]})", "malformed /points"},
        Case{"single_quotes", "{'points':[]}", "malformed "},
        Case{"comment", R"({/* */"points":[]})", "malformed "},
        Case{"nan", R"({"points":[NaN,0,0]})", "malformed /points/0"},
        Case{"infinity", R"({"points":[0,0,-Infinity]})", "malformed /points/2"},
        // What follows a complete value, here 0, is taken for the next element.
        Case{"leading_zero", R"({"points":[01,0,0]})", "malformed /points/0"},
        Case{"plus_sign", R"({"points":[0,+1,0]})", "malformed /points/1"},
        Case{"bare_dot", R"({"points":[0,1.,0]})", "malformed /points/1"},
        Case{"hexadecimal", R"({"points":[0,0,0x10]})", "malformed /points/2"},
        Case{"bad_utf8", "{\"name\":\"\xFF\"}", "malformed /name"},
        Case{"surrogate_alone", R"({"name":"\ud800"})", "malformed /name"},
        Case{"control_character", "{\"name\":\"a\nb\"}", "malformed /name"},
        Case{"malformed_in_ignored_member", R"({"statistics":[1,2,tru],"points":[]})",
             "malformed /statistics/2"},
        Case{"mismatched_brackets", R"({"points":[[0,0,0}]})", "malformed /points/0/3"}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    mesh, refusals,
    testing::Values(
        Case{"no_points", R"({"faceVertexIndices":[0,1,2]})", "missing_field /points"},
        Case{"no_faces", R"({"points":[]})", "missing_field /faceVertexIndices"},
        Case{"no_faces_in_meshes", R"({"meshes":[{"points":[]}]})",
             "missing_field /meshes/0/faceVertexIndices"},
        Case{"empty_mesh", R"({"points":[],"faceVertexIndices":[]})", "wrong_length /faceVertexIndices"},
        Case{"unknown_member", R"({"meshes":[{"vertices":[]}]})", "unknown_field /meshes/0/vertices"},
        Case{"name_no_string", with(R"("name":1)"), "wrong_type /name"},
        Case{"points_no_array", R"({"points":{}})", "wrong_type /points"},
        Case{"points_of_strings", R"({"points":["0"]})", "wrong_type /points/0"},
        Case{"points_of_null", R"({"points":[0,null,0]})", "wrong_type /points/1"},
        Case{"point_of_strings", R"({"points":[[0,"0",0]]})", "wrong_type /points/0/1"},
        Case{"number_among_tuples", R"({"points":[[0,0,0],0]})", "wrong_type /points/1"},
        Case{"tuple_among_numbers", R"({"points":[0,[0,0,0]]})", "wrong_type /points/1"},
        Case{"point_too_short", R"({"points":[[0,0,0],[0,0]]})", "wrong_length /points/1"},
        Case{"point_too_long", R"({"points":[[0,0,0,0]]})", "wrong_length /points/0"},
        Case{"point_empty", R"({"points":[[]]})", "wrong_length /points/0"},
        Case{"point_too_deep", R"({"points":[[[0,0,0]]]})", "wrong_type /points/0/0"},
        Case{"flat_points_not_in_threes", R"({"points":[0,0,0,0]})", "wrong_length /points"},
        Case{"point_beyond_doubles", R"({"points":[[0,0,1e999]]})", "not_finite /points/0/2"},
        Case{"point_beyond_doubles_negative", R"({"points":[0,-1e999,0]})", "not_finite /points/1"},
        Case{"index_negative", with(R"("holeIndices":[0,-1])"), "out_of_range /holeIndices/1"},
        Case{"index_fraction", with(R"("holeIndices":[0.5])"), "wrong_type /holeIndices/0"},
        Case{"index_no_index", with(R"("holeIndices":[4294967295])"), "out_of_range /holeIndices/0"},
        Case{"index_wraps_to_0", with(R"("holeIndices":[4294967296])"), "out_of_range /holeIndices/0"},
        Case{"index_wraps_64_bits", with(R"("holeIndices":[18446744073709551616])"),
             "out_of_range /holeIndices/0"},
        Case{"index_true", with(R"("holeIndices":[true])"), "wrong_type /holeIndices/0"},
        Case{"index_string", with(R"("holeIndices":["0"])"), "wrong_type /holeIndices/0"},
        Case{"index_beyond_doubles", with(R"("holeIndices":[1e999])"), "not_finite /holeIndices/0"},
        Case{"indices_no_array", with(R"("holeIndices":0)"), "wrong_type /holeIndices"},
        Case{"face_past_the_points", R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,3]})",
             "out_of_range /faceVertexIndices/2"},
        Case{"nested_face_past_the_points",
             R"({"meshes":[{"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[[0,1,2],[0,1,3]]}]})",
             "out_of_range /meshes/0/faceVertexIndices/1/2"},
        Case{"faces_not_in_threes", R"({"points":[0,0,0],"faceVertexIndices":[0,0,0,0]})",
             "wrong_length /faceVertexIndices"},
        Case{"face_mixed_with_indices", R"({"points":[],"faceVertexIndices":[[0,1,2],0]})",
             "wrong_type /faceVertexIndices/1"},
        Case{"counts_that_do_not_add_up",
             R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2],"faceVertexCounts":[3,3]})",
             "wrong_length /faceVertexCounts"},
        Case{"counts_against_nested_faces",
             R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[[0,1,2]],"faceVertexCounts":[4]})",
             "wrong_length /faceVertexCounts"},
        Case{
            "counts_that_wrap",
            R"({"points":[0,0,0],"faceVertexIndices":[0,0,0],"faceVertexCounts":[4294967294,4294967294,11]})",
            "wrong_length /faceVertexCounts"},
        Case{
            "quad",
            R"({"points":[0,0,0,1,0,0,1,1,0,0,1,0],"faceVertexIndices":[0,1,2,3],"faceVertexCounts":[4],"subdivisionScheme":"loop"})",
            "unsupported /subdivisionScheme"},
        Case{
            "nested_quad",
            R"({"points":[0,0,0,1,0,0,1,1,0,0,1,0],"faceVertexIndices":[[0,1,2],[0,1,2,3]],"options":{"subdivisionScheme":"loop"}})",
            "unsupported /subdivisionScheme"},
        Case{"two_sided_polygon",
             R"({"points":[0,0,0,1,0,0,1,1,0,0,1,0],"faceVertexIndices":[[0,1,2,3],[0,1]]})",
             "not_a_triangle /faceVertexIndices/1"},
        Case{"two_sided_face",
             R"({"points":[0,0,0],"faceVertexIndices":[[0,0]],"options":{"triangulate":true}})",
             "not_a_triangle /faceVertexIndices/0"},
        Case{"nothing_but_degenerate_faces", R"({"points":[0,0,0],"faceVertexIndices":[0,0,0]})",
             "not_a_triangle /faceVertexIndices"},
        Case{"scheme", with(R"("subdivisionScheme":"catmullclark")"), "bad_enum /subdivisionScheme"},
        Case{"boundary", with(R"("interpolateBoundary":"edgesOnly")"), "bad_enum /interpolateBoundary"},
        Case{"boundary_number", with(R"("interpolateBoundary":1)"), "wrong_type /interpolateBoundary"},
        Case{"seams", with(R"("faceVaryingLinearInterpolation":"corners")"),
             "bad_enum /faceVaryingLinearInterpolation"}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    tags, refusals,
    testing::Values(
        Case{"crease_no_edge",
             R"({"points":[0,0,0,1,0,0,1,1,0,0,1,0],"faceVertexIndices":[0,1,2,0,2,3],"creaseIndices":[1,3],
                 "creaseLengths":[2],"creaseSharpnesses":[1]})",
             "not_an_edge /creaseIndices/1"},
        Case{"nested_crease_no_edge",
             R"({"points":[0,0,0,1,0,0,1,1,0,0,1,0],"faceVertexIndices":[0,1,2,0,2,3],
                 "creaseIndices":[[0,1,2],[2,1,3]],"creaseSharpnesses":[1,1]})",
             "not_an_edge /creaseIndices/1/2"},
        Case{"crease_of_one_point",
             with(R"("creaseIndices":[0],"creaseLengths":[1],"creaseSharpnesses":[1])"),
             "out_of_range /creaseLengths/0"},
        Case{"nested_crease_of_one_point", with(R"("creaseIndices":[[0]],"creaseSharpnesses":[1])"),
             "out_of_range /creaseIndices/0"},
        Case{"crease_lengths_that_do_not_add_up",
             with(R"("creaseIndices":[0,1],"creaseLengths":[3],"creaseSharpnesses":[1])"),
             "wrong_length /creaseLengths"},
        Case{"crease_past_the_points", with(R"("creaseIndices":[[0,7]],"creaseSharpnesses":[1])"),
             "out_of_range /creaseIndices/0/1"},
        Case{"crease_without_sharpness", with(R"("creaseIndices":[[0,1]])"),
             "wrong_length /creaseSharpnesses"},
        Case{"sharpness_negative", with(R"("creaseIndices":[[0,1]],"creaseSharpnesses":[-1])"),
             "out_of_range /creaseSharpnesses/0"},
        Case{"sharpness_word", with(R"("creaseSharpnesses":["sharp"])"), "bad_enum /creaseSharpnesses/0"},
        Case{"sharpness_true", with(R"("creaseSharpnesses":[true])"), "wrong_type /creaseSharpnesses/0"},
        Case{"corner_twice", with(R"("cornerIndices":[1,1],"cornerSharpnesses":[1,1])"),
             "duplicate_tag /cornerIndices/1"},
        Case{"corner_past_the_points", with(R"("cornerIndices":[3],"cornerSharpnesses":[1])"),
             "out_of_range /cornerIndices/0"},
        Case{"corner_without_sharpness", with(R"("cornerIndices":[1])"), "wrong_length /cornerSharpnesses"},
        Case{"hole_twice", with(R"("holeIndices":[0,0])"), "duplicate_tag /holeIndices/1"},
        Case{"hole_past_the_faces", with(R"("holeIndices":[1])"), "out_of_range /holeIndices/0"}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    primvars, refusals,
    testing::Values(
        Case{"no_object", with(R"("primvars":[])"), "wrong_type /primvars"},
        Case{"primvar_no_object", with(R"("primvars":{"a":[1]})"), "wrong_type /primvars/a"},
        Case{"twice", with(R"("primvars":{"a":{"values":[1,2,3]},"a":{"values":[1,2,3]}})"),
             "duplicate_field /primvars/a"},
        Case{"without_values", primvar(R"("elementSize":1)"), "missing_field /primvars/a~1b/values"},
        Case{"unknown_member", primvar(R"("data":[1])"), "unknown_field /primvars/a~1b/data"},
        Case{"interpolation", primvar(R"("interpolation":"facevarying")"),
             "bad_enum /primvars/a~1b/interpolation"},
        Case{"element_size_0", primvar(R"("elementSize":0)"), "out_of_range /primvars/a~1b/elementSize"},
        Case{"element_size_large", primvar(R"("elementSize":4097)"),
             "out_of_range /primvars/a~1b/elementSize"},
        Case{"element_size_against_values", primvar(R"("elementSize":3,"values":[[1,2]])"),
             "wrong_length /primvars/a~1b/values/0"},
        Case{"values_not_of_element_size", primvar(R"("elementSize":2,"values":[1,2,3])"),
             "wrong_length /primvars/a~1b/values"},
        Case{"values_of_two_widths", primvar(R"("values":[[1,2],[3]])"),
             "wrong_length /primvars/a~1b/values/1"},
        Case{"too_few_values", primvar(R"("values":[1,2])"), "wrong_length /primvars/a~1b/values"},
        Case{"index_past_the_values", primvar(R"("values":[1,2,3],"indices":[0,1,3])"),
             "out_of_range /primvars/a~1b/indices/2"},
        Case{"too_few_indices", primvar(R"("values":[1,2,3],"indices":[0,1])"),
             "wrong_length /primvars/a~1b/indices"},
        Case{"nameless", with(R"("primvars":{"":{"values":[1,2,3]}})"), "out_of_range /primvars/"}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    curves, refusals,
    testing::Values(
        Case{"no_points", curve(""), "missing_field /curves/0/points"},
        Case{"type", curve(R"("type":"quartic","points":[[0],[1]])"), "bad_enum /curves/0/type"},
        Case{"type_against_degree", curve(R"("type":"linear","degree":3,"points":[[0],[1]])"),
             "out_of_range /curves/0/degree"},
        Case{"type_against_basis", curve(R"("type":"linear","basis":"bezier","points":[[0],[1]])"),
             "wrong_type /curves/0/basis"},
        Case{"degree_too_high", curve(R"("degree":16,"points":[[0],[1]])"), "out_of_range /curves/0/degree"},
        Case{"degree_of_nothing", curve(R"("degree":0,"points":[[0],[1]])"), "out_of_range /curves/0/degree"},
        Case{"degree_with_another_basis", curve(R"("basis":"bezier","degree":3,"points":[[0],[1]])"),
             "unknown_field /curves/0/degree"},
        Case{"tension_of_a_bspline", curve(R"("tension":0.1,"points":[[0],[1]])"),
             "unknown_field /curves/0/tension"},
        Case{"tension_too_high", curve(R"("basis":"fourPoint","tension":0.2,"points":[[0],[1]])"),
             "out_of_range /curves/0/tension"},
        Case{"ratio_of_a_half", curve(R"("basis":"cornerCutting","ratio":0.5,"points":[[0],[1],[2]])"),
             "out_of_range /curves/0/ratio"},
        Case{"spacing", curve(R"("basis":"catmullRom","spacing":"even","points":[[0],[1]])"),
             "bad_enum /curves/0/spacing"},
        Case{"bezier_points", curve(R"("basis":"bezier","points":[[0],[1],[2],[3],[4]])"),
             "wrong_length /curves/0/points"},
        Case{"hermite_points", curve(R"("basis":"hermite","points":[[0],[1],[2],[3],[4]])"),
             "wrong_length /curves/0/points"},
        Case{"nurbs_without_order", curve(R"("type":"nurbs","knots":[0,0,1,1],"points":[[0],[1]])"),
             "missing_field /curves/0/order"},
        Case{"nurbs_without_knots", curve(R"("type":"nurbs","order":2,"points":[[0],[1]])"),
             "missing_field /curves/0/knots"},
        Case{"nurbs_with_a_basis",
             curve(R"("type":"nurbs","basis":"bezier","order":2,"knots":[0,0,1,1],"points":[[0],[1]])"),
             "unknown_field /curves/0/basis"},
        Case{"order_of_one", curve(R"("type":"nurbs","order":1,"knots":[0,0,1],"points":[[0],[1]])"),
             "out_of_range /curves/0/order"},
        Case{"falling_knots", curve(R"("type":"nurbs","order":2,"knots":[0,1,0,1],"points":[[0],[1]])"),
             "out_of_range /curves/0/knots/2"},
        Case{"knots_too_often",
             curve(R"("type":"nurbs","order":2,"knots":[0,0,1,1,2,2],"points":[[0],[1],[2],[3]])"),
             "out_of_range /curves/0/knots/3"},
        Case{"too_few_knots", curve(R"("type":"nurbs","order":2,"knots":[0,0,1],"points":[[0],[1]])"),
             "wrong_length /curves/0/knots"},
        Case{"degree_of_all_points",
             curve(R"("type":"nurbs","order":3,"knots":[0,0,0,1,1],"points":[[0],[1]])"),
             "too_few_points /curves/0/points"},
        Case{"weight_of_nothing",
             curve(R"("type":"nurbs","order":2,"knots":[0,0,1,1],"points":[[0],[1]],"pointWeights":[1,0])"),
             "out_of_range /curves/0/pointWeights/1"},
        Case{"range_outside",
             curve(R"("type":"nurbs","order":2,"knots":[0,0,1,1],"points":[[0],[1]],"ranges":[[0,2]])"),
             "out_of_range /curves/0/ranges/0"},
        Case{"basis", curve(R"("basis":"b-spline","points":[[0],[1]])"), "bad_enum /curves/0/basis"},
        Case{"wrap", curve(R"("wrap":"closed","points":[[0],[1]])"), "bad_enum /curves/0/wrap"},
        Case{"one_point", curve(R"("points":[[0]])"), "too_few_points /curves/0/points"},
        Case{"flat_not_in_threes", curve(R"("points":[0,1])"), "wrong_length /curves/0/points"},
        Case{"counts_that_do_not_add_up", curve(R"("points":[[0],[1],[2]],"curveVertexCounts":[2])"),
             "wrong_length /curves/0/curveVertexCounts"},
        Case{"count_too_small", curve(R"("points":[[0],[1],[2]],"curveVertexCounts":[2,1])"),
             "too_few_points /curves/0/curveVertexCounts/1"},
        Case{"knots_of_a_cubic", curve(R"("knots":[],"points":[[0],[1]])"), "unknown_field /curves/0/knots"},
        Case{"unknown_member", curve(R"("closed":true)"), "unknown_field /curves/0/closed"}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    repaired, refusals,
    testing::Values(
        // The pointers lead into the body as it was written, not into the mesh that was made of it.
        Case{"face_after_a_dropped_one",
             R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,0,1,0,1,2,0,1,9]})",
             "out_of_range /faceVertexIndices/8"},
        Case{"corner_of_a_split_face",
             R"({"points":[0,0,0,1,0,0,1,1,0,0,1,0],"faceVertexIndices":[[0,1,2],[0,1,2,9]],
                 "options":{"triangulate":true}})",
             "out_of_range /faceVertexIndices/1/3"},
        Case{"corner_of_a_split_flat_face",
             R"({"points":[0,0,0,1,0,0,1,1,0,0,1,0],"faceVertexIndices":[0,1,2,0,1,2,3,0,1,9],
                 "faceVertexCounts":[3,4,3],"options":{"triangulate":true}})",
             "out_of_range /faceVertexIndices/9"},
        Case{"channel_of_a_split_face",
             R"({"points":[0,0,0,1,0,0,1,1,0,0,1,0],"faceVertexIndices":[[0,1,2,3]],
                 "primvars":{"st":{"interpolation":"faceVarying","values":[1,2,3],"indices":[0,1,2,3]}},
                 "options":{"triangulate":true}})",
             "out_of_range /primvars/st/indices/3"},
        Case{
            "value_beyond_single_precision",
            R"({"points":[[0,0,0],[1,0,1e39],[0,1,0]],"faceVertexIndices":[0,1,2],"options":{"precision":"single"}})",
            "out_of_range /points/1/2"}),
    name_of_case);

TEST(refusal_messages, say_where_the_text_stops_being_json) {
  EXPECT_THAT(message("{\n  \"points\": [1, 2 3]}"), testing::HasSubstr("line 2, column 19"));
}

TEST(refusal_messages, guess_that_a_body_was_cut_short) {
  EXPECT_THAT(message(R"({"points":[[0,0)"), testing::HasSubstr("cut short"));
}

// Whatever the end of the body cuts, nothing before it was wrong.
TEST(refusal_messages, guess_that_a_value_was_cut_short) {
  for (const char* body :
       {"{\"warnings\":\"\\", "{\"warnings\":\"\\u", "{\"warnings\":\"\\u12", "{\"name\":\"\\ud83d",
        "{\"name\":\"\\ud83d\\", "{\"name\":\"\\ud83d\\ude0", "{\"name\":\"\xC3", "{\"name\":\"a\xE2\x82",
        "{\"name\":\"\\n\xF0\x9F\x98", "{\"points\":[-", "{\"points\":[1.", "{\"points\":[[1e",
        "{\"statistics\":1e+", "{\"statistics\":tru"})
    EXPECT_THAT(message(body), testing::HasSubstr("cut short")) << body;
  for (const char* body : {"{\"warnings\":\"\\u12\"}", "{\"name\":\"\\ud83dx\"}", "{\"name\":\"\xC3\"}",
                           "{\"name\":\"\xFF", "{\"points\":[-]}", "{\"points\":[1.]}"})
    EXPECT_THAT(message(body), testing::HasSubstr("stops being valid JSON")) << body;
}

TEST(refusal_messages, count_lines_and_columns_of_long_bodies) {
  const std::string lines(600000, '\n'), spaces(600000, ' ');
  const auto place = [](const std::string& line, const std::string& column, const std::string& byte) {
    return testing::EndsWith("at line " + line + ", column " + column + " (byte " + byte + ")");
  };
  EXPECT_THAT(message("{" + lines + "  x}"), place("600001", "3", "600003"));
  EXPECT_THAT(message("{" + spaces + "x}"), place("1", "600002", "600001"));
  EXPECT_THAT(message("{\n" + spaces + "x}"), place("2", "600001", "600002"));
  EXPECT_THAT(message("{\n" + spaces + "\nx}"), place("3", "1", "600003"));
}

std::string place_of(std::string number, const std::string& before, const std::string& behind) {
  return refusal(before + std::move(number) + behind);
}

// A number that goes on as none does is blamed itself, not what would come next.
TEST(refusal_places, of_malformed_numbers_are_their_own) {
  for (const char* number : {"01", "1e5x", "-", "1.", "1.e5", "00.5", "1-", "1\"\"", "2[", "0x10", "1e5.5"}) {
    EXPECT_EQ(place_of(number, R"({"points":[[0,0,0],[1,0,0],[0,)", ",0]]}"), "malformed /points/2/1")
        << number;
    EXPECT_EQ(place_of(number, R"({"points":[0,)", "]}"), "malformed /points/1") << number;
    EXPECT_EQ(place_of(number, R"({"faceVertexIndices":[0,1,)", "]}"), "malformed /faceVertexIndices/2")
        << number;
    EXPECT_EQ(place_of(number, R"({"faceVertexIndices":[[0,)", ",2]]}"), "malformed /faceVertexIndices/0/1")
        << number;
    EXPECT_EQ(place_of(number, R"({"creaseSharpnesses":[)", "]}"), "malformed /creaseSharpnesses/0")
        << number;
    EXPECT_EQ(place_of(number, R"({"options":{"level":)", "}}"), "malformed /options/level") << number;
    EXPECT_EQ(place_of(number, R"({"statistics":{"a":[0,)", "]}}"), "malformed /statistics/a/1") << number;
    EXPECT_EQ(place_of(number, R"({"curves":[{"tension":)", "}]}"), "malformed /curves/0/tension") << number;
  }
}

TEST(refusal_messages, name_the_near_member) {
  EXPECT_THAT(message(R"({"point":[]})"), testing::HasSubstr("did you mean \"points\"?"));
}

TEST(refusal_messages, suggest_another_scheme_or_triangulate) {
  const std::string text = message(
      R"({"points":[0,0,0,1,0,0,1,1,0,0,1,0],"faceVertexIndices":[[0,1,2,3]],"subdivisionScheme":"loop"})");
  EXPECT_THAT(text, testing::HasSubstr("catmullClark"));
  EXPECT_THAT(text, testing::HasSubstr("triangulate"));
}

TEST(refusal_messages, tell_a_gltf_sent_as_json) {
  EXPECT_THAT(message(R"({"asset":{"version":"2.0"}})"), testing::HasSubstr("model/gltf+json"));
}

TEST(refusal_messages, tell_a_glb_sent_as_json) {
  EXPECT_THAT(message(std::string("glTF\2\0\0\0", 8)), testing::HasSubstr("model/gltf-binary"));
}

}  // namespace
}  // namespace subdivd::proto::test

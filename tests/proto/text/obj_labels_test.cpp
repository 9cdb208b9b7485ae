// Groups and materials: from an OBJ into primvars with names, and out again.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/proto/text/support.h"
#include "tests/proto/text/written.h"

namespace subdivd::proto::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

const std::string kFive = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\n";

std::vector<std::string> names_in(const RefineRequest& request, std::size_t mesh, std::size_t primvar) {
  std::vector<std::string> names;
  const NameList& list = names_of(request, mesh, primvar);
  for (Count k = 0; k < list.size(); ++k) names.emplace_back(list[k]);
  return names;
}

TEST(obj_labels, groups_and_materials_are_uniform_primvars_with_names) {
  const RefineRequest request = read_again(
      kFive +
      "g left arm\nusemtl skin\nf 1 2 3\nf 1 2 4\nusemtl cloth\nf 1 3 4\ng right\nusemtl skin\nf 2 3 5\n");
  const std::vector<Primvar>& primvars = request.meshes.at(0).primvars;
  ASSERT_THAT(primvars, SizeIs(2));
  EXPECT_EQ(primvars[0].name, "group");
  EXPECT_EQ(primvars[0].interpolation, Interpolation::uniform);
  EXPECT_THAT(primvars[0].values, ElementsAre(0, 0, 0, 1));
  EXPECT_THAT(names_in(request, 0, 0), ElementsAre("left arm", "right"));
  EXPECT_EQ(primvars[1].name, "material");
  EXPECT_THAT(primvars[1].values, ElementsAre(0, 0, 1, 0));
  EXPECT_THAT(names_in(request, 0, 1), ElementsAre("skin", "cloth"));
  EXPECT_THAT(request.warnings, IsEmpty());
}

TEST(obj_labels, faces_without_a_name_have_an_empty_one_where_others_have_one) {
  const RefineRequest request = read_again(kFive + "f 1 2 3\ng a\nf 1 2 4\ng\nf 1 3 4\n");
  EXPECT_THAT(request.meshes.at(0).primvars.at(0).values, ElementsAre(0, 1, 0));
  EXPECT_THAT(names_in(request, 0, 0), ElementsAre("", "a"));
  EXPECT_THAT(read_again(kFive + "g\nusemtl\nf 1 2 3\n").meshes.at(0).primvars, IsEmpty());
  EXPECT_THAT(read_again(kFive + "f 1 2 3\ng behind the last face\n").meshes.at(0).primvars, IsEmpty());
}

TEST(obj_labels, they_hold_until_the_next_over_objects_too) {
  const RefineRequest request = read_again(
      kFive + "usemtl m\no a\nf 1 2 3\no b\nf 1 2 4\nusemtl n\nf 1 3 4\no c\ng only here\nf 2 3 5\n");
  ASSERT_THAT(request.meshes, SizeIs(3));
  EXPECT_THAT(names_in(request, 0, 0), ElementsAre("m"));
  EXPECT_THAT(names_in(request, 1, 0), ElementsAre("m", "n"));
  EXPECT_THAT(request.meshes[1].primvars.at(0).values, ElementsAre(0, 1));
  EXPECT_EQ(request.meshes[2].primvars.at(0).name, "group");
  EXPECT_THAT(names_in(request, 2, 1), ElementsAre("n"));
}

// The first look at the file took a name for a comment and what continued it for lines: indices were compared with
// points that are not there.
TEST(obj_labels, a_name_may_have_a_number_sign_and_be_continued) {
  const RefineRequest request =
      read_again(kFive + "usemtl Material #25\ng a \\\r\n b \\\nv 9 9 9\nf 1 2 3\n");
  EXPECT_THAT(names_in(request, 0, 0), ElementsAre("a   b  v 9 9 9"));
  EXPECT_THAT(names_in(request, 0, 1), ElementsAre("Material #25"));
  for (const char* word : {"usemtl", "g", "mtllib", "o"}) {
    const std::string body = kFive + word + " #x \\\nv 9 9 9\nf 1 2 3\n";
    EXPECT_THAT(text_refusal(body + "f 1 2 6\n", BodyKind::obj),
                HasSubstr("line 9: face index 6 is past the 5 points"))
        << word;
    EXPECT_THAT(read_again(body).meshes.at(0).points, SizeIs(15)) << word;
  }
}

TEST(obj_labels, an_answer_as_obj_has_them_again) {
  const std::string body = "mtllib some file.mtl\n" + kFive +
                           "g a\nusemtl m\nf 1 2 3\nusemtl\nf 1 3 4\no second\ng b\nusemtl m\nf 2 3 5\n";
  RefineRequest request = read_again(body);
  request.options.format = Format::obj;
  request.options.level = 0;
  EXPECT_EQ(
      written(request),
      "mtllib some file.mtl\no\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng a\nusemtl m\nf 1 2 3\nusemtl\nf 1 3 4\n"
      "o second\nv 1 0 0\nv 0 1 0\nv 1 1 1\ng b\nusemtl m\nf 5 6 7\n");
  request.options.level = 2;
  const RefineRequest again = read_again(written(request));
  ASSERT_THAT(again.meshes, SizeIs(2));
  EXPECT_THAT(again.meshes[0].face_vertex_indices, SizeIs(3 * 32));
  EXPECT_THAT(names_in(again, 0, 1), ElementsAre("m", ""));
  std::vector<double> materials(16, 0);
  materials.resize(32, 1);
  EXPECT_EQ(again.meshes[0].primvars.at(1).values, materials);
  EXPECT_EQ(again.primvar_names, request.primvar_names);
}

TEST(obj_labels, a_mesh_without_names_ends_those_of_the_last) {
  RefineRequest request = read_again(kFive + "usemtl m\nf 1 2 3\nusemtl\no b\nf 1 2 4\n");
  request.options.format = Format::obj;
  request.options.level = 0;
  EXPECT_THAT(written(request), testing::EndsWith("v 0 0 1\nusemtl\nf 4 5 6\n"));
}

TEST(obj_labels, json_has_the_names_and_takes_them) {
  RefineRequest request = read_again(kFive + "g a\nf 1 2 3\ng \"b\"\nf 1 3 4\n");
  request.options.level = 1;
  const std::string json = written(request);
  EXPECT_THAT(
      json,
      HasSubstr(
          R"("group":{"interpolation":"uniform","elementSize":1,"values":[0,0,0,0,1,1,1,1],"names":["a","\"b\""]})"));
  const auto again = decode(json, {{"format", "obj"}, {"level", "0"}});
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_THAT(names_in(*again, 0, 0), ElementsAre("a", "\"b\""));
  EXPECT_THAT(written(*again), HasSubstr("f 8 7 3\ng \"b\"\nf 1 8 10\n"));
}

std::string json_with(const std::string& primvar) {
  return R"({"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2],"primvars":{"material":{)" +
         primvar + "}}}";
}

TEST(obj_labels, names_that_are_none_are_refused) {
  const std::string uniform = R"("interpolation":"uniform",)";
  EXPECT_EQ(refusal(json_with(uniform + R"("values":[0],"names":["a"])")), "accepted");
  EXPECT_EQ(refusal(json_with(uniform + R"("names":["a","b"],"values":[2])")),
            "out_of_range /primvars/material/values/0");
  EXPECT_EQ(refusal(json_with(uniform + R"("values":[-1],"names":["a"])")),
            "out_of_range /primvars/material/values/0");
  EXPECT_EQ(refusal(json_with(uniform + R"("values":[0.5],"names":["a"])")),
            "out_of_range /primvars/material/values/0");
  EXPECT_EQ(refusal(json_with(uniform + R"("values":[[7]],"names":["a"])")),
            "out_of_range /primvars/material/values/0/0");
  EXPECT_EQ(refusal(json_with(uniform + R"("values":[0],"names":[])")),
            "wrong_length /primvars/material/names");
  EXPECT_EQ(refusal(json_with(uniform + R"("values":[0],"names":["a",1])")),
            "wrong_type /primvars/material/names/1");
  EXPECT_EQ(refusal(json_with(uniform + R"("values":[0],"names":"a")")),
            "wrong_type /primvars/material/names");
  EXPECT_EQ(refusal(json_with(R"("interpolation":"vertex","values":[0,0,0],"names":["a"])")),
            "unsupported /primvars/material/names");
  EXPECT_EQ(refusal(json_with(uniform + R"("values":[[0,0]],"names":["a"])")),
            "unsupported /primvars/material/names");
}

TEST(obj_labels, no_name_begins_a_line) {
  const std::string text =
      written(json_with(R"("interpolation":"uniform","values":[0],"names":["a\nv 7 7 7\\"])"),
              {{"format", "obj"}, {"level", "0"}});
  EXPECT_THAT(text, HasSubstr("usemtl a_v 7 7 7_\nf 1 2 3\n"));
}

TEST(obj_labels, numbers_without_names_are_left_out_of_an_obj) {
  const std::string text =
      written(json_with(R"("interpolation":"uniform","values":[3])"), {{"format", "obj"}});
  EXPECT_THAT(text, HasSubstr("# primvar \"material\" is left out"));
  EXPECT_THAT(text, Not(HasSubstr("usemtl")));
}

// Long names that change at every face: the answer is as long as that makes it, and was predicted so (written()).
TEST(obj_labels, names_count_for_the_size_of_an_answer) {
  std::string values = "0", faces = "[0,1,2",
              names = "\"" + std::string(5000, 'a') + "\",\"" + std::string(5000, 'b') + "\"";
  for (int k = 1; k < 500; ++k) values += k % 2 == 0 ? ",0" : ",1", faces += ",0,1,2";
  const std::string body = R"({"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":)" + faces +
                           R"(],"primvars":{"group":{"interpolation":"uniform","values":[)" + values +
                           R"(],"names":[)" + names + "]}}}";
  const QueryParameters query{{"format", "obj"}, {"level", "1"}};
  EXPECT_GT(written(body, query).size(), 500u * 4096);
  Limits limits;
  limits.max_output_bytes = 1'000'000;
  const auto predicted = predict_refine(*decode(body, query), limits);
  ASSERT_FALSE(predicted.ok());
  EXPECT_EQ(predicted.error().code, ErrorCode::too_large);
}

struct Counter : MemoryGrant {
  Result<void> take(Count bytes) override {
    taken += bytes;
    if (taken > most) return Error{ErrorCode::overloaded, "no memory"};
    return {};
  }
  Count most = 1'000'000'000, taken = 0;
};

// A material of a hundred thousand objects stands in all of them.
TEST(obj_labels, names_of_many_objects_are_taken_from_the_budget) {
  std::string body = kFive + "usemtl " + std::string(4000, 'x') + '\n';
  for (int k = 0; k < 100'000; ++k) body += "o\nf 1 2 3\n";
  Counter counter;
  Budget budget;
  budget.memory = &counter;
  EXPECT_THAT(text_refusal(body, BodyKind::obj, {}, budget), HasSubstr("overloaded"));
  EXPECT_GT(counter.taken, 100'000u * 4000);
}

TEST(obj_labels, a_name_for_every_face_of_many_is_read_and_written) {
  constexpr int kFaces = 200'000;
  std::string body;
  for (int k = 0; k < kFaces + 2; ++k)
    body += "v " + std::to_string(k % 1000) + ' ' + std::to_string(k / 1000) + " 0\n";
  for (int k = 0; k < kFaces; ++k) {
    body += "g " + std::to_string(std::int64_t{k} * 7919 % 1'000'003) + "\nf";
    for (int c = 1; c <= 3; ++c) body += ' ' + std::to_string(k + c);
    body += '\n';
  }
  RefineRequest request = read_again(body);
  EXPECT_EQ(names_of(request, 0, 0).size(), Count{kFaces});
  request.options.level = 0;
  request.options.format = Format::obj;
  EXPECT_TRUE(written(request) == body);
}

TEST(obj_labels, every_beginning_is_answered) {
  decode_beginnings("mtllib a\n" + kFive + "g a \\\r\n b\nusemtl #m\nf 1 2 3\nusemtl\no b\ng\nf 1 2 4\n",
                    BodyKind::obj);
}

}  // namespace
}  // namespace subdivd::proto::test

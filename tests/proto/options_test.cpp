#include "proto/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

using testing::HasSubstr;

Options from_query(const QueryParameters& query) {
  Options options;
  const Result<void> done = set_parameters(options, query);
  EXPECT_TRUE(done.ok()) << (done.ok() ? "" : done.error().message);
  return options;
}

std::string refused(const std::string& name, const std::string& value) {
  Options options;
  const Result<void> done = set_parameter(options, name, value);
  return done ? "accepted" : std::string(name_of(done.error().code));
}

TEST(options, a_query_sets_every_option) {
  const Options options = from_query({{"level", "4"},
                                      {"limit", "true"},
                                      {"normals", "1"},
                                      {"verify", "true"},
                                      {"triangulate", "1"},
                                      {"loopWeights", "warren"},
                                      {"interpolateBoundary", "edgeOnly"},
                                      {"faceVaryingLinearInterpolation", "boundaries"},
                                      {"creaseMethod", "chaikin"},
                                      {"precision", "single"},
                                      {"weld", "none"},
                                      {"format", "gltf"}});
  EXPECT_EQ(options.level, 4u);
  EXPECT_TRUE(options.limit && options.normals && options.verify && options.triangulate);
  EXPECT_EQ(std::get<Loop>(options.schemes).weights, LoopWeights::warren);
  EXPECT_EQ(options.interpolate_boundary, BoundaryInterpolation::edge_only);
  EXPECT_EQ(options.face_varying_linear_interpolation, FaceVaryingInterpolation::boundaries);
  EXPECT_EQ(options.crease_method, CreaseMethod::chaikin);
  EXPECT_EQ(options.precision, Precision::single_precision);
  EXPECT_EQ(options.weld, Weld::none);
  EXPECT_EQ(options.format, Format::gltf);
}

TEST(options, defaults_of_the_table_are_those_of_the_struct) {
  for (const OptionSpec& spec : option_table()) {
    if (spec.default_value.empty()) {
      EXPECT_FALSE(spec.get(Options{}).has_value()) << spec.name;
      continue;
    }
    Options options;
    ASSERT_TRUE(set_parameter(options, spec.name, spec.default_value).ok()) << spec.name;
    EXPECT_EQ(spec.get(options), spec.get(Options{})) << spec.name;
  }
}

TEST(options, every_word_sets_its_own_value_and_comes_back) {
  for (const OptionSpec& spec : option_table()) {
    for (std::size_t i = 0; i < spec.words.size(); ++i) {
      Options options;
      ASSERT_TRUE(set_parameter(options, spec.name, spec.words[i]).ok());
      EXPECT_EQ(spec.get(options), i) << spec.name << ' ' << spec.words[i];
    }
  }
}

TEST(options, false_and_0_switch_off) {
  EXPECT_FALSE(from_query({{"limit", "true"}, {"normals", "false"}}).normals);
  EXPECT_FALSE(from_query({{"limit", "0"}}).limit);
}

TEST(options, refuses_other_spellings_of_booleans) {
  for (const char* text : {"", "yes", "on", "TRUE", "True", "2", "true ", "null"})
    EXPECT_EQ(refused("limit", text), "bad_enum") << text;
}

TEST(options, refuses_levels_that_are_no_whole_numbers) {
  for (const char* text :
       {"", "two", "2.0", "2.5", "1e1", "0x2", "+2", " 2", "2 ", "inf", "nan", "-", "1-2", "--1"})
    EXPECT_EQ(refused("level", text), "wrong_type") << text;
}

TEST(options, refuses_negative_levels) {
  EXPECT_EQ(refused("level", "-1"), "out_of_range");
  EXPECT_EQ(refused("level", "-" + std::string(400, '9')), "out_of_range");
}

TEST(options, refuses_levels_past_the_maximum) {
  EXPECT_EQ(refused("level", "16"), "too_large");
  EXPECT_EQ(refused("level", "4294967298"), "too_large");  // 2 after wrapping to 32 bits
  EXPECT_EQ(refused("level", std::string(400, '9')), "too_large");
}

TEST(options, a_level_past_the_maximum_names_both_numbers) {
  Options options;
  const Result<void> done = set_parameter(options, "level", "4294967298");
  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().predicted, 4294967298u);
  EXPECT_EQ(done.error().allowed, 15u);
}

TEST(options, an_unknown_name_brings_the_near_one_and_the_list) {
  const std::string text = message(kTriangle, {{"levle", "2"}});
  EXPECT_THAT(text, HasSubstr("did you mean \"level\"?"));
  for (const std::string_view name : option_names()) EXPECT_THAT(text, HasSubstr(std::string(name)));
}

TEST(options, a_misspelt_word_brings_the_near_one_and_the_list) {
  const std::string text = message(kTriangle, {{"interpolateBoundary", "edgeonly"}});
  EXPECT_THAT(text, HasSubstr("did you mean \"edgeOnly\"?"));
  EXPECT_THAT(text, HasSubstr("none, edgeOnly or edgeAndCorner"));
}

TEST(options, a_far_off_name_is_not_guessed_at) {
  EXPECT_THAT(message(kTriangle, {{"x", "2"}}), testing::Not(HasSubstr("did you mean")));
}

TEST(options, a_long_name_is_cut_in_the_message) {
  EXPECT_LT(message(kTriangle, {{std::string(1000000, 'a'), "2"}}).size(), 1000u);
}

TEST(options, refuses_a_repeated_parameter) {
  EXPECT_EQ(refusal(kTriangle, {{"level", "1"}, {"level", "1"}}), "duplicate_field ?level");
}

TEST(options, blames_the_parameter) {
  EXPECT_EQ(refusal(kTriangle, {{"level", "x"}}), "wrong_type ?level");
  EXPECT_EQ(refusal(kTriangle, {{"levle", "1"}}), "unknown_field ?levle");
  EXPECT_EQ(refusal(kTriangle, {{"weld", "all"}}), "bad_enum ?weld");
  EXPECT_EQ(refusal(kTriangle, {{"level", "9"}}), "too_large ?level");
}

std::string with_options(const std::string& options) {
  return R"({"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2],"options":)" + options + "}";
}

TEST(options, the_body_sets_options) {
  const auto request = decode(with_options(R"({"level":3,"limit":true,"weld":"none"})"));
  ASSERT_TRUE(request.ok());
  EXPECT_EQ(request->options.level, 3u);
  EXPECT_TRUE(request->options.limit);
  EXPECT_EQ(request->options.weld, Weld::none);
}

TEST(options, the_query_wins_over_the_body) {
  const auto request = decode(with_options(R"({"level":8,"limit":true})"), {{"level", "1"}});
  ASSERT_TRUE(request.ok());
  EXPECT_EQ(request->options.level, 1u);
  EXPECT_TRUE(request->options.limit);
}

TEST(options, a_level_too_high_in_the_body_is_forgiven_when_the_query_lowers_it) {
  EXPECT_EQ(refusal(with_options(R"({"level":9})")), "too_large /options/level");
  EXPECT_EQ(refusal(with_options(R"({"level":9})"), {{"level", "1"}}), "accepted");
}

TEST(options, the_servers_limit_on_levels_is_told) {
  Limits limits;
  limits.max_level = 3;
  const auto request = decode(with_options(R"({"level":4})"), {}, limits);
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().predicted, 4u);
  EXPECT_EQ(request.error().allowed, 3u);
}

TEST(options, the_body_refuses_wrong_types) {
  EXPECT_EQ(refusal(with_options(R"({"level":"2"})")), "wrong_type /options/level");
  EXPECT_EQ(refusal(with_options(R"({"level":2.5})")), "wrong_type /options/level");
  EXPECT_EQ(refusal(with_options(R"({"level":true})")), "wrong_type /options/level");
  EXPECT_EQ(refusal(with_options(R"({"level":null})")), "wrong_type /options/level");
  EXPECT_EQ(refusal(with_options(R"({"level":[2]})")), "wrong_type /options/level");
  EXPECT_EQ(refusal(with_options(R"({"limit":1})")), "wrong_type /options/limit");
  EXPECT_EQ(refusal(with_options(R"({"limit":"true"})")), "wrong_type /options/limit");
  EXPECT_EQ(refusal(with_options(R"({"weld":true})")), "wrong_type /options/weld");
  EXPECT_EQ(refusal(with_options(R"([])")), "wrong_type /options");
}

TEST(options, the_body_refuses_unknown_and_repeated_names) {
  EXPECT_EQ(refusal(with_options(R"({"levle":2})")), "unknown_field /options/levle");
  EXPECT_EQ(refusal(with_options(R"({"level":2,"level":2})")), "duplicate_field /options/level");
  EXPECT_EQ(refusal(with_options(R"({"precision":"half"})")), "bad_enum /options/precision");
  EXPECT_EQ(refusal(with_options(R"({"level":-1})")), "out_of_range /options/level");
  EXPECT_EQ(refusal(with_options(R"({"level":1e300})")), "too_large /options/level");
  EXPECT_EQ(refusal(with_options(R"({"level":1e999})")), "not_finite /options/level");
}

TEST(options, verification_knows_no_weights_but_loops) {
  EXPECT_EQ(refusal(kTriangle, {{"verify", "1"}, {"loopWeights", "warren"}}), "unsupported ?verify");
  EXPECT_EQ(refusal(with_options(R"({"verify":true})"), {{"loopWeights", "warren"}}),
            "unsupported /options/verify");
}

TEST(options, verification_is_judged_by_the_scheme_that_the_options_choose) {
  const std::string bilinear =
      R"({"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2],"subdivisionScheme":"bilinear"})";
  // Weights of Loop's that OpenSubdiv does not have.
  EXPECT_EQ(refusal(bilinear, {{"verify", "1"}, {"loopWeights", "warren"}}), "accepted");
  EXPECT_EQ(refusal(bilinear, {{"verify", "1"}, {"loopWeights", "warren"}, {"subdivisionScheme", "loop"}}),
            "unsupported ?verify");
}

TEST(options, the_echo_is_a_valid_options_member_with_the_same_values) {
  const auto request = decode(kTriangle, {{"level", "3"}, {"precision", "single"}, {"weld", "none"}});
  ASSERT_TRUE(request.ok());
  const auto again = decode(with_options(effective_options(*request)));
  ASSERT_TRUE(again.ok()) << again.error().message;
  for (const OptionSpec& spec : option_table()) {
    if (spec.name == "format") continue;  // the echo says what it came to
    EXPECT_EQ(spec.get(again->options), spec.get(request->options)) << spec.name;
  }
}

TEST(options, the_echo_tells_what_defaults_come_to) {
  const auto request = decode(kTriangle);
  ASSERT_TRUE(request.ok());
  const auto echo = nlohmann::json::parse(effective_options(*request));
  EXPECT_EQ(echo["precision"], "double");
  EXPECT_EQ(echo["format"], "json");
  EXPECT_FALSE(echo.contains("interpolateBoundary"));
}

TEST(options, gltf_answers_are_single_precision_unless_asked) {
  RefineRequest request;
  request.options.format = Format::glb;
  EXPECT_EQ(answer_precision(request), Precision::single_precision);
  request.options.precision = Precision::double_precision;
  EXPECT_EQ(answer_precision(request), Precision::double_precision);
}

}  // namespace
}  // namespace subdivd::proto::test

// The door: kinds of bodies, limits, predictions.

#include "proto/decode.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/proto/support.h"

namespace subdivd::proto::test {
namespace {

TEST(decode, json_is_recognised_without_a_content_type) {
  const auto request = decode_refine(kTriangle, BodyKind::unspecified, {}, {});
  ASSERT_TRUE(request.ok());
  EXPECT_EQ(request->input, Format::json);
}

TEST(decode, faults_of_json_are_told_without_a_content_type) {
  const auto request = decode_refine(R"({"points":1})", BodyKind::unspecified, {}, {});
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().code, ErrorCode::wrong_type);
}

TEST(decode, refuses_a_body_over_the_limit_with_both_numbers) {
  Limits limits;
  limits.max_body_bytes = 10;
  const auto request = decode(kTriangle, {}, limits);
  ASSERT_FALSE(request.ok());
  EXPECT_EQ(request.error().code, ErrorCode::too_large);
  EXPECT_EQ(request.error().predicted, kTriangle.size());
  EXPECT_EQ(request.error().allowed, 10u);
}

TEST(decode, every_good_request_has_passed_check) {
  const auto request = decode(kTriangle);
  ASSERT_TRUE(request.ok());
  EXPECT_TRUE(request->meshes[0].check().ok());
}

// The prediction is an upper bound of the text, and not a wild one.
void expect_bound(const std::string& body, const QueryParameters& query, double slack) {
  const auto request = decode(body, query);
  ASSERT_TRUE(request.ok()) << request.error().message;
  const auto prediction = predict_refine(*request, {});
  ASSERT_TRUE(prediction.ok());
  const auto text = answer(body, query);
  ASSERT_TRUE(text.ok());
  EXPECT_GE(prediction->answer_bytes, text->size());
  EXPECT_LE(static_cast<double>(prediction->answer_bytes), slack * static_cast<double>(text->size()));
}

// Coordinates whose texts are long.
const std::string kOdd = R"({"points":[[0.123456789012345678,-1e-200,3.3333333333333333],[1e-7,-1.1e-300,7],
    [-0.7777777777777777,1.2345e-250,0.1]],"faceVertexIndices":[0,1,2],
    "primvars":{"st":{"interpolation":"faceVarying","values":[[0.1,0.2],[0.3,0.7],[1e-9,-0.33]]},
                "t":{"values":[1e-300,-2e-300,3.3e-300]}, "u":{"interpolation":"uniform","values":[1]}}})";

TEST(decode, the_predicted_size_is_an_upper_bound_for_doubles) {
  expect_bound(kOdd, {{"level", "6"}, {"normals", "1"}}, 2.5);
}

TEST(decode, the_predicted_size_is_an_upper_bound_for_floats) {
  expect_bound(R"({"points":[[0.123456789,-1.2e-30,3.33333],[1e-7,-1.1e-30,7],[-0.777,1.23e-25,0.1]],
                   "faceVertexIndices":[[0,1,2]]})",
               {{"level", "6"}, {"precision", "single"}}, 2.5);
}

TEST(decode, the_predicted_size_is_an_upper_bound_for_curves) {
  expect_bound(R"({"curves":[{"points":[[0.123456789012345678,-1e-200],[1e-7,-1.1e-300],[1,2]]}]})",
               {{"level", "8"}, {"normals", "1"}}, 2.5);
}

TEST(decode, the_predicted_size_is_an_upper_bound_for_nothing_much) {
  expect_bound(std::string(kTriangle), {{"level", "0"}}, 40);
}

TEST(decode, refuses_an_answer_over_the_limit_before_any_work) {
  const auto request = decode(kTriangle, {{"level", "8"}});
  ASSERT_TRUE(request.ok());
  Limits limits;
  limits.max_output_bytes = 100000;
  const auto prediction = predict_refine(*request, limits);
  ASSERT_FALSE(prediction.ok());
  EXPECT_EQ(prediction.error().code, ErrorCode::too_large);
  EXPECT_GT(prediction.error().predicted, 100000u);
  EXPECT_EQ(prediction.error().allowed, 100000u);
}

TEST(decode, a_prediction_past_32_bit_indices_is_refused) {
  Limits limits;
  limits.max_level = 15;
  std::string faces, points;
  for (int i = 0; i < 100; ++i) {
    const std::string separator = i == 0 ? "" : ",";
    points +=
        separator + std::to_string(i) + ",0,0," + std::to_string(i) + ",1,0," + std::to_string(i) + ",0,1";
    for (int k = 0; k < 3; ++k) faces += (i + k == 0 ? "" : ",") + std::to_string(3 * i + k);
  }
  const auto request = decode(R"({"points":[)" + points + R"(],"faceVertexIndices":[)" + faces + "]}",
                              {{"level", "15"}}, limits);
  ASSERT_TRUE(request.ok()) << request.error().message;
  const auto prediction = predict_refine(*request, limits);
  ASSERT_FALSE(prediction.ok());
  EXPECT_EQ(prediction.error().code, ErrorCode::too_large);
}

}  // namespace
}  // namespace subdivd::proto::test

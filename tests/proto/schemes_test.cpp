#include "proto/schemes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

namespace subdivd::proto::test {
namespace {

using nlohmann::json;

json spectrum_of(std::string_view name, std::string_view valence, const QueryParameters& query = {}) {
  const auto choice = decode_scheme(name, valence, query);
  if (!choice) return {{"code", name_of(choice.error().code)}};
  const auto found = spectrum(*choice, {});
  return found ? json::parse(spectrum_json(*found)) : json{{"code", name_of(found.error().code)}};
}

TEST(Schemes, are_listed_with_what_they_take) {
  const json schemes = json::parse(schemes_json())["schemes"];
  ASSERT_EQ(schemes.size(), std::tuple_size_v<AllGridSchemes> +
                                2);  // those of surfaces whose masks see a ring, and two of curves
  EXPECT_EQ(schemes[0]["name"], "loop");
  for (const json& scheme : schemes) {
    EXPECT_FALSE(spectrum_of(scheme["name"].get<std::string>(), scheme["kind"] == "curve" ? "2" : "6")
                     .contains("code"));
    for (const json& parameter : scheme["parameters"])
      EXPECT_TRUE(parameter.contains("default")) << parameter;
  }
}

TEST(Schemes, the_tables_of_the_cubic_come_out) {
  const json cubic = spectrum_of("bspline", "2");
  const std::vector<double> expected{1, 0.5, 0.25, 0.125, 0.125};
  ASSERT_EQ(cubic["eigenvalues"].size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(cubic["eigenvalues"][k], expected[k], 1e-14);
  EXPECT_NEAR(cubic["limitMask"][2], 4.0 / 6, 1e-14);
  EXPECT_NEAR(cubic["tangentMasks"][0][3], 0.5, 1e-14);
  EXPECT_EQ(cubic["matrix"].size(), 5u);
}

TEST(Schemes, loop_has_its_subdominant_eigenvalue_at_any_valence) {
  for (const int n : {4, 5, 6, 9, 20})
    for (const char* weights : {"loop", "warren"})
      EXPECT_NEAR(spectrum_of("loop", std::to_string(n), {{"weights", weights}})["subdominant"],
                  3.0 / 8 + std::cos(2 * std::numbers::pi / n) / 4, 1e-13);
  EXPECT_FALSE(spectrum_of("loop", "4", {{"border", "true"}}).contains("code"));
}

TEST(Schemes, refuse_what_they_do_not_have) {
  EXPECT_EQ(spectrum_of("sqrt3", "6")["code"], "bad_enum");
  EXPECT_EQ(spectrum_of("loop", "six")["code"], "wrong_type");
  EXPECT_EQ(spectrum_of("loop", "6.5")["code"], "wrong_type");
  EXPECT_EQ(spectrum_of("loop", "2")["code"], "out_of_range");
  EXPECT_EQ(spectrum_of("loop", "4000000000")["code"], "out_of_range");
  EXPECT_EQ(spectrum_of("bspline", "3")["code"], "out_of_range");
  EXPECT_EQ(spectrum_of("bspline", "2", {{"degree", "16"}})["code"], "out_of_range");
  EXPECT_EQ(spectrum_of("bspline", "2", {{"tension", "0"}})["code"], "unknown_field");
  EXPECT_EQ(spectrum_of("bspline", "2", {{"degree", "2"}, {"degree", "3"}})["code"], "duplicate_field");
  EXPECT_EQ(spectrum_of("fourPoint", "2", {{"tension", "0.1"}})["code"], "unsupported");
  EXPECT_EQ(spectrum_of("fourPoint", "2", {{"tension", "nan"}})["code"], "not_finite");
  EXPECT_EQ(spectrum_of("loop", "6", {{"weights", "pixar"}})["code"], "bad_enum");
  EXPECT_EQ(spectrum_of("loop", "6", {{"border", "1"}})["code"], "bad_enum");
}

}  // namespace
}  // namespace subdivd::proto::test

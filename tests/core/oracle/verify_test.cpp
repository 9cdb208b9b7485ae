#include "core/oracle/verify.h"

#include <chrono>

#include "tests/core/oracle/fixtures.h"

namespace subdivd::oracle::testing {
namespace {

TEST(Verify, passes_a_mesh_that_has_everything) {
  const auto report = verify<double>(rich_mesh(), everything(3), Budget{});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->verdict, Verdict::passed);
  EXPECT_EQ(report->precision, "double");
  ASSERT_EQ(report->levels.size(), 3u);
  for (Index level = 1; level <= 3; ++level) {
    EXPECT_EQ(report->levels[level - 1].level, level);
    EXPECT_TRUE(report->levels[level - 1].connectivity_identical);
  }
}

TEST(Verify, passes_in_single_precision) {
  const auto report = verify<float>(rich_mesh(), everything(3), Budget{});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->verdict, Verdict::passed);
  EXPECT_EQ(report->precision, "single");
}

TEST(Verify, level_zero_compares_the_control_mesh_and_its_limits) {
  const auto report = verify<double>(rich_mesh(), everything(0), Budget{});
  ASSERT_TRUE(report.ok());
  ASSERT_EQ(report->levels.size(), 1u);
  EXPECT_EQ(report->levels[0].level, 0u);
  EXPECT_GT(find(report->levels[0], "limitPoints").compared, 0u);
  EXPECT_EQ(report->verdict, Verdict::passed);
}

// "passed": true, said the report, with 0 limits compared.
TEST(Verify, does_not_pass_limits_of_which_none_could_be_compared) {
  ControlMesh mesh = shapes::tetrahedron();
  for (const auto& [a, b] : shapes::edges_of(mesh)) shapes::crease(mesh, {a, b}, 9);
  RefineOptions options;
  options.level = 1;
  options.limit = true;
  const auto report = verify<double>(mesh, options, Budget{});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(find(report->levels[0], "points").verdict, Verdict::passed);
  EXPECT_EQ(find(report->levels[0], "limitPoints").compared, 0u);
  EXPECT_EQ(find(report->levels[0], "limitPoints").verdict, Verdict::nothing_compared);
  EXPECT_EQ(report->levels[0].verdict(), Verdict::nothing_compared);
  EXPECT_EQ(report->verdict, Verdict::nothing_compared);
  ASSERT_FALSE(report->remarks.empty());
  EXPECT_TRUE(report->remarks[0].starts_with("limitPoints: left out, all of them: ")) << report->remarks[0];
}

TEST(Verify, passes_when_the_limits_of_the_level_asked_for_were_compared) {
  ControlMesh mesh = shapes::tetrahedron();
  for (const auto& [a, b] : shapes::edges_of(mesh)) shapes::crease(mesh, {a, b}, 2);
  const auto report = verify<double>(mesh, everything(3), Budget{});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->levels[0].verdict(), Verdict::nothing_compared);
  EXPECT_EQ(report->verdict, Verdict::passed);
}

// Between any two allocations of Far's nobody can stop it; everywhere else the budget does.
TEST(Verify, stops_in_the_middle_of_its_work) {
  Budget budget;
  budget.deadline = Budget::Clock::now() + std::chrono::milliseconds(20);
  const auto report = verify<double>(shapes::big_torus(60, 60, 1), everything(4), budget);
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().code, ErrorCode::deadline_exceeded);
}

TEST(Verify, compares_limits_and_normals_only_when_asked) {
  RefineOptions options;
  options.level = 1;
  const auto report = verify<double>(shapes::icosahedron(), options, Budget{});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->levels[0].deviations.size(), 1u);
}

TEST(Verify, names_what_was_left_out_once) {
  const auto report = verify<double>(rich_mesh(), everything(3), Budget{});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(std::count_if(report->remarks.begin(), report->remarks.end(),
                          [](const std::string& remark) { return remark.starts_with("normals: left out"); }),
            1);
}

TEST(Verify, refuses_weights_that_far_does_not_know) {
  RefineOptions options = everything(1);
  options.loop_weights = LoopWeights::warren;
  const auto report = verify<double>(shapes::icosahedron(), options, Budget{});
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().code, ErrorCode::unsupported);
}

TEST(Verify, refuses_a_level_over_the_oracles_before_any_work) {
  Budget impatient;
  impatient.deadline = Budget::Clock::now();
  const auto report = verify<double>(shapes::icosahedron(), everything(kMaxFarLevel + 1), impatient);
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().code, ErrorCode::out_of_range);
}

TEST(Verify, refuses_too_much_memory_before_any_work) {
  Budget budget;
  budget.max_bytes = 10000000;
  const auto report = verify<double>(shapes::icosahedron(), everything(8), budget);
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().code, ErrorCode::too_large);
  EXPECT_GT(report.error().predicted, report.error().allowed);
}

TEST(Verify, says_whom_it_quotes) { EXPECT_EQ(oracle_name(), "OpenSubdiv 3.5.0 Far"); }

TEST(Verify, tells_of_a_mesh_far_from_the_origin) {
  ControlMesh mesh = shapes::icosahedron();
  for (double& x : mesh.points) x += 1e6;
  const auto report = verify<float>(mesh, everything(2), Budget{});
  ASSERT_TRUE(report.ok());
  ASSERT_FALSE(report->remarks.empty());
  EXPECT_NE(report->remarks.back().find("origin"), std::string::npos);
}

}  // namespace
}  // namespace subdivd::oracle::testing

#include "core/oracle/verify.h"

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

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

// Far's callbacks are the process's. Several at once say what each says alone, beside one that Far refuses
// (its crease runs along no edge).
TEST(Verify, says_the_same_on_many_threads_at_once) {
  const auto alone = verify<double>(rich_mesh(), everything(2), Budget{});
  ASSERT_TRUE(alone.ok());
  ControlMesh refused = shapes::icosahedron();
  shapes::crease(refused, {0, 11}, 2);
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 6; ++t)
    threads.emplace_back([&, t] {
      for (int k = 0; k < 10; ++k) {
        if (t == 0) {
          wrong += verify<double>(refused, everything(1), Budget{}).ok() ? 1 : 0;
          continue;
        }
        const auto report = verify<double>(rich_mesh(), everything(2), Budget{});
        if (!report || report->verdict != alone->verdict) {
          ++wrong;
          continue;
        }
        for (std::size_t d = 0; d < report->levels[1].deviations.size(); ++d)
          wrong += report->levels[1].deviations[d].max_relative == alone->levels[1].deviations[d].max_relative
                       ? 0
                       : 1;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
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
  std::get<Loop>(options.schemes).weights = LoopWeights::warren;
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

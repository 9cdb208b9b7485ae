// A verdict is no bool: what was not compared has not passed.

#include "core/oracle/report.h"

#include <gtest/gtest.h>

#include <type_traits>

namespace subdivd::oracle {
namespace {

constexpr Verdict kPassed = Verdict::passed, kFailed = Verdict::failed, kNothing = Verdict::nothing_compared;

static_assert(!std::is_convertible_v<Verdict, bool>);

LevelReport level_of(std::initializer_list<Verdict> verdicts) {
  LevelReport level;
  level.connectivity_identical = true;
  for (const Verdict verdict : verdicts) level.deviations.emplace_back().verdict = verdict;
  return level;
}

TEST(Verdict, of_two_is_the_worse) {
  EXPECT_EQ(both(kPassed, kPassed), kPassed);
  EXPECT_EQ(both(kPassed, kNothing), kNothing);
  EXPECT_EQ(both(kNothing, kFailed), kFailed);
  EXPECT_EQ(both(kFailed, kPassed), kFailed);
}

TEST(Verdict, of_a_level_is_that_of_all_its_quantities) {
  EXPECT_EQ(level_of({kPassed, kPassed}).verdict(), kPassed);
  EXPECT_EQ(level_of({kPassed, kNothing}).verdict(), kNothing);
  EXPECT_EQ(level_of({kNothing, kFailed}).verdict(), kFailed);
  EXPECT_EQ(level_of({}).verdict(), kNothing);
}

TEST(Verdict, of_another_connectivity_is_failed) {
  LevelReport level = level_of({kPassed});
  level.connectivity_identical = false;
  EXPECT_EQ(level.verdict(), kFailed);
}

TEST(Verdict, of_levels_is_the_last_ones_unless_one_has_failed) {
  EXPECT_EQ(verdict_of({level_of({kNothing}), level_of({kPassed})}), kPassed);
  EXPECT_EQ(verdict_of({level_of({kPassed}), level_of({kNothing})}), kNothing);
  EXPECT_EQ(verdict_of({level_of({kFailed}), level_of({kPassed})}), kFailed);
  EXPECT_EQ(verdict_of({}), kNothing);
}

TEST(Verdict, of_a_report_is_that_of_all_its_parts) {
  Report report;
  EXPECT_EQ(report.verdict(), kNothing);
  report.meshes.emplace_back().verdict = kPassed;
  report.curves.emplace_back().verdict = kPassed;
  report.surfaces.emplace_back().verdict = kPassed;
  EXPECT_EQ(report.verdict(), kPassed);
  report.curves[0].verdict = kNothing;
  EXPECT_EQ(report.verdict(), kNothing);
  report.surfaces[0].verdict = kFailed;
  EXPECT_EQ(report.verdict(), kFailed);
}

}  // namespace
}  // namespace subdivd::oracle

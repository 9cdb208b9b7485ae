// Rows of surfaces, flat over their scalars, against the taps of every point by themselves.
#include "core/surfaces/patch_rows.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "tests/shapes/random.h"

namespace subdivd::testing {
namespace {

template <class Real>
std::vector<Real> tapped(const std::vector<Real>& row, Index width, Count count, auto&& taps_of, Real scale) {
  std::vector<Real> out;
  for (Count i = 0; i < count; ++i) {
    const Taps taps = taps_of(i);
    for (Index k = 0; k < width; ++k) {
      const auto part = [&](int t) { return row[taps.at[t] * width + k] * Real(taps.weight[t]); };
      out.push_back(((part(0) + part(1)) + part(2)) * scale);
    }
  }
  return out;
}

template <class Real>
void expect_rows_by_taps() {
  const Pace pace;
  for (const CurveWrap wrap : {CurveWrap::nonperiodic, CurveWrap::periodic, CurveWrap::pinned})
    for (const Index degree : {2u, 3u})
      for (const Index width : {1u, 2u, 3u, 4u, 5u, 16u})
        for (const Count n : {4u, 5u, 6u, 7u, 12u, 9001u}) {
          SCOPED_TRACE("wrap " + std::to_string(static_cast<int>(wrap)) + " degree " +
                       std::to_string(degree) + " width " + std::to_string(width) + " n " +
                       std::to_string(n));
          const Direction d{wrap, degree, n};
          shapes::Random random(n * width);
          std::vector<Real> row(n * width);
          for (Real& x : row) x = static_cast<Real>(random.centred());
          const Count children = refined_grid_count(wrap, degree, n, 1);
          std::vector<Real> split(children * width);
          split_row(d, row.data(), width, split.data(), pace);
          ASSERT_EQ(split, tapped(
                               row, width, children, [&](Count i) { return step_taps(d, i); }, Real(1)));
          for (const RowRule rule : {limit_taps, tangent_taps}) {
            std::vector<Real> along(row.size());
            combine_along(d, row.data(), width, rule, Real(8), along.data(), pace);
            ASSERT_EQ(along, tapped(
                                 row, width, n, [&](Count i) { return rule(d, i); }, Real(8)));
          }
        }
}

TEST(PatchRows, are_those_of_the_taps_point_by_point_to_the_bit) {
  expect_rows_by_taps<float>();
  expect_rows_by_taps<double>();
}

TEST(PatchRows, stop_when_nobody_waits_any_more) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  const Direction d{CurveWrap::periodic, 3, 9001};
  const std::vector<double> row(9001);
  std::vector<double> out(2 * row.size());
  for (int loop = 0; loop < 3; ++loop) {
    const auto stopped = stoppable(budget, [&](const Pace& pace) {
      if (loop == 0) split_row(d, row.data(), 1, out.data(), pace);
      if (loop == 1) combine_along(d, row.data(), 1, limit_taps, 1.0, out.data(), pace);
      if (loop == 2) combine_rows(row.data(), 3000, limit_taps(d, 1), out.data(), pace);
    });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
  }
}

}  // namespace
}  // namespace subdivd::testing

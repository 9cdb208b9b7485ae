#include "core/splines/approximation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/core/splines/sample_splines.h"

namespace subdivd {
namespace {

// From one point of the plane to another.
Spline line(double x0, double y0, double x1, double y1) {
  Spline spline;
  spline.degree = 1;
  spline.width = 2;
  spline.points = {x0, y0, x1, y1};
  spline.knots = {0, 0, 1, 1};
  return spline;
}

TEST(JoinedCurve, of_one_is_that_one) {
  JoinedCurve joined;
  ASSERT_TRUE(append(joined, {line(0, 0, 1, 0), 0.25}, 0.5, {}));
  EXPECT_EQ(joined.whole->spline.points, line(0, 0, 1, 0).points);
  EXPECT_EQ(joined.whole->bound, 0.25);
  EXPECT_EQ(joined.tolerance, 0.5);
}

// The ends meet in the middle of the gap: either side moves by half of it, on top of what it lost before.
TEST(JoinedCurve, bounds_what_each_part_lost_and_moved) {
  JoinedCurve joined;
  ASSERT_TRUE(append(joined, {line(0, 0, 1, 0), 0.01}, 0.1, {}));
  ASSERT_TRUE(append(joined, {line(1, 0.2, 2, 0), 0.5}, 0.4, {}));
  EXPECT_EQ(joined.tolerance, 0.4);
  EXPECT_DOUBLE_EQ(joined.whole->bound, 0.7);
  const std::vector<double>& points = joined.whole->spline.points;
  ASSERT_EQ(points.size(), 6u);
  EXPECT_DOUBLE_EQ(points[2], 1);
  EXPECT_DOUBLE_EQ(points[3], 0.1);
  // The larger tolerance of all so far holds, and the larger bound of all so far stays.
  ASSERT_TRUE(append(joined, {line(2, 0.3, 3, 0), 0}, 0.01, {}));
  EXPECT_EQ(joined.tolerance, 0.4);
  EXPECT_DOUBLE_EQ(joined.whole->bound, 0.7);
}

// Both ends at a gap move, that of the part before, too, and a later gap may be larger.
TEST(JoinedCurve, bounds_what_the_end_of_an_earlier_part_moved) {
  JoinedCurve joined;
  ASSERT_TRUE(append(joined, {line(0, 0, 1, 0), 0.5}, 0.1, {}));
  ASSERT_TRUE(append(joined, {line(1, 0.2, 2, 0), 0.01}, 0.4, {}));
  EXPECT_DOUBLE_EQ(joined.whole->bound, 0.7);
  ASSERT_TRUE(append(joined, {line(2, 0, 3, 0), 0}, 0.8, {}));
  EXPECT_DOUBLE_EQ(joined.whole->bound, 0.9);
}

TEST(JoinedCurve, says_how_far_apart_the_ends_are_however_near) {
  JoinedCurve joined;
  ASSERT_TRUE(append(joined, {line(0, 0, 1, 0), 0}, 0, {}));
  const auto refused = append(joined, {line(1, 1e-9, 2, 0), 0}, 1e-10, {});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "the curves are 1e-09 apart where they should meet; 1e-10 are allowed");
}

TEST(JoinedCurve, refuses_ends_further_apart_than_both_tolerances) {
  JoinedCurve joined;
  ASSERT_TRUE(append(joined, {line(0, 0, 1, 0), 0}, 0.1, {}));
  const auto refused = append(joined, {line(1, 0.3, 2, 0), 0}, 0.2, {});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::out_of_range);
}

TEST(RoundingTolerance, grows_with_the_curve_and_covers_rounding) {
  for (const auto& [name, spline] : samples::all_splines()) {
    SCOPED_TRACE(name);
    Spline large = spline;
    for (std::size_t k = 0; k < large.points.size(); ++k)
      if (k % large.width < large.dimension()) large.points[k] *= 1024;
    const double tolerance = rounding_tolerance(spline);
    EXPECT_EQ(rounding_tolerance(large), 1024 * tolerance);
    double largest = 0;
    for (const double x : spline.points) largest = std::max(largest, std::abs(x));
    EXPECT_LT(tolerance, 1e-8 * largest);
  }
}

}  // namespace
}  // namespace subdivd

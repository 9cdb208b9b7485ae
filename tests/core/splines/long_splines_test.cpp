// Splines of a million points: what is done to one of them stops in its middle, and takes time by its length.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/pace.h"
#include "core/splines/arc_length.h"
#include "core/splines/bounds.h"
#include "core/splines/closest.h"
#include "core/splines/degree.h"
#include "core/splines/edit.h"
#include "core/splines/flatten.h"
#include "core/splines/knot_insertion.h"
#include "core/splines/knot_removal.h"
#include "tests/support/deadlines.h"

namespace subdivd {
namespace {

using testing::expect_stops_midway;
using testing::kLinear;
using testing::within;

// A wave of `count` points over whole knots.
Spline wave(Index degree, Index dimension, Count count, bool rational = false) {
  Spline spline{degree, dimension, false, false, {}, {}};
  for (Count i = 0; i < count + degree + 1; ++i) spline.knots.push_back(static_cast<double>(i));
  for (Count k = 0; k < count * dimension; ++k) spline.points.push_back(std::sin(static_cast<double>(k)));
  if (!rational) return spline;
  spline.points = to_homogeneous(spline.points, dimension, std::vector<double>(count, 1.5));
  spline.rational = true;
  ++spline.width;
  return spline;
}

TEST(LongSplines, stop_while_they_are_checked) {
  const Spline spline = wave(3, 3, 2'000'000, true);
  expect_stops_midway([&](const Budget& budget) { return spline.check(budget); });
}

TEST(LongSplines, stop_while_a_knot_is_inserted_or_removed) {
  const Spline spline = wave(3, 3, 1'000'000);
  const std::vector<double> few{4.5};
  expect_stops_midway([&](const Budget& budget) { return refine_knots(spline, few, budget); });
  expect_stops_midway([&](const Budget& budget) { return remove_knot(spline, 5, 1, 100, budget); });
  const std::vector<double> listed{5};
  expect_stops_midway([&](const Budget& budget) { return remove_knots(spline, listed, 100, budget); });
}

TEST(LongSplines, stop_while_they_are_edited) {
  const Spline spline = wave(3, 3, 1'000'000);
  expect_stops_midway([&](const Budget& budget) { return part(spline, 4.5, 999'000, budget); });
  expect_stops_midway([&](const Budget& budget) { return split(spline, 500'000, budget); });
  expect_stops_midway([&](const Budget& budget) { return reparametrize(spline, 0, 1, budget); });
  expect_stops_midway([&](const Budget& budget) {
    return stoppable(budget, [&](const Pace& pace) { return reverse(spline, pace); });
  });
  expect_stops_midway([&](const Budget& budget) { return join(spline, spline, 1000, budget); });
}

TEST(LongSplines, stop_while_their_degree_changes) {
  const Spline spline = wave(3, 1, 200'000);
  expect_stops_midway([&](const Budget& budget) { return elevate_degree(spline, 2, budget); });
  expect_stops_midway([&](const Budget& budget) { return reduce_degree(spline, budget); });
}

TEST(LongSplines, stop_while_they_are_measured) {
  const Spline spline = wave(1, 2, 300'000);
  const std::vector<double> far{100, 100};
  expect_stops_midway([&](const Budget& budget) { return to_local_coordinates(spline, budget); });
  expect_stops_midway([&](const Budget& budget) { return bounds(spline, budget); });
  expect_stops_midway([&](const Budget& budget) { return closest_point(spline, far, budget); });
  expect_stops_midway([&](const Budget& budget) {
    return flatten(spline, {.tolerance = 0.1, .max_points = 1'000'000}, budget);
  });
  expect_stops_midway([&](const Budget& budget) {
    return arc_length(spline, {.tolerance = 1e-3, .max_pieces = 1'000'000}, budget);
  });
}

// Every removal once made the whole curve anew: 100,000 of them took minutes.
TEST(LongSplines, lose_many_listed_knots_in_linear_time) {
  constexpr Count kPoints = 100'000;
  Spline spline = wave(3, 1, kPoints);
  for (Count i = 0; i < kPoints; ++i) spline.points[i] = static_cast<double>(i);  // a straight line
  std::vector<double> listed;
  for (Count k = kPoints - 1; k > 3; k -= 2) listed.push_back(static_cast<double>(k));  // last ones first
  const auto thinned = remove_knots(spline, listed, 1, within(kLinear));
  ASSERT_TRUE(thinned.ok()) << thinned.error().message;
  EXPECT_EQ(thinned->removed, listed.size());
}

// With every knot left out in turn, equal ones too, and all weights, 500 points took more than a minute.
TEST(LongSplines, are_lifted_to_the_highest_degree_in_time) {
  const auto lifted = elevate_degree(wave(3, 1, 500), kMaxDegree - 3, within(kLinear));
  ASSERT_TRUE(lifted.ok()) << lifted.error().message;
  EXPECT_EQ(lifted->point_count(), 500 + 60 * 497);
}

}  // namespace
}  // namespace subdivd

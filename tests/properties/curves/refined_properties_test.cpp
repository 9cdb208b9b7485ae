// What refining must obey, whatever the kind of the curve: of points, their limits and their tangents alike.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/overloaded.h"
#include "tests/properties/curves/kinds.h"

namespace subdivd::testing {
namespace {

class RefinedCurve : public ::testing::TestWithParam<CurveKind> {
 protected:
  const ControlCurves& rule() const { return GetParam().rule; }
  // Schemes promise bits: each works in an order that symmetry and steps keep. Pieces and knots promise
  // digits.
  bool to_the_bit() const { return is_subdivided(rule().basis); }
  void expect_same(const std::vector<double>& found, const std::vector<double>& expected, const char* what,
                   double tolerance) const {
    ASSERT_EQ(found.size(), expected.size()) << what;
    if (to_the_bit()) tolerance = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
      ASSERT_NEAR(found[k], expected[k], tolerance) << what << " at scalar " << k;
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Every, RefinedCurve, ::testing::ValuesIn(all_curve_kinds()), name_of);

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

// --- Counts -----------------------------------------------------------------------------------------------

// Nothing for curves that are not on knots.
Nurbs nurbs_of(const ControlCurves& curves) {
  const Nurbs* nurbs = std::get_if<Nurbs>(&curves.basis);
  return nurbs != nullptr ? *nurbs : Nurbs{};
}

// Written out once more: the closed forms of subdivision.h and piecewise.h.
Count count_by_formula(const ControlCurves& curves, Index level) {
  const Count n = curves.point_count(), parts = Count{1} << level;
  const bool closed = curves.wrap == CurveWrap::periodic, pinned = curves.wrap == CurveWrap::pinned;
  const auto by_scheme = [&](Count degree) {
    const Count kept = closed ? 0 : !pinned ? degree : degree % 2 == 0 ? 2 : 1;
    return (n - kept) * parts + kept;
  };
  return std::visit(Overloaded{
                        [&](const Bezier&) { return (closed ? n : n - 1) * parts + 1; },
                        [&](const Hermite&) { return 3 * (n / 2 - (closed ? 0 : 1)) * parts + 1; },
                        [&](const CatmullRom&) {
                          return 3 * (closed ? n : pinned ? n - 1 : n - 3) * parts + 1;
                        },
                        [&](const Nurbs& nurbs) {
                          const auto first = nurbs.knots.begin() + nurbs.orders[0] - 1;
                          const std::set<double> breaks(
                              first, nurbs.knots.begin() + static_cast<std::ptrdiff_t>(n) + 1);
                          return n + (breaks.size() - 1) * (parts - 1);
                        },
                        [&](const UniformBSpline& kind) { return by_scheme(kind.degree); },
                        [&](const FourPoint&) { return by_scheme(5); },
                        [&](const CornerCutting&) { return by_scheme(2); },
                    },
                    curves.basis);
}

TEST_P(RefinedCurve, counts_follow_the_closed_forms) {
  for (const Count more : {0u, 1u, 5u})
    for (Index level = 0; level <= 4; ++level) {
      const auto curves = random_curve(GetParam(), more, 2);
      const Count expected = count_by_formula(curves, level);
      EXPECT_EQ(total_point_count(curves, level), expected);
      const Answer fine = refined(curves, level);
      EXPECT_EQ(fine.points().size(), 2 * expected);
      EXPECT_EQ(fine.limits.size(), 2 * expected);
      EXPECT_EQ(fine.tangents.size(), 2 * expected);
      EXPECT_EQ(fine.curves.vertex_counts, std::vector<Index>{static_cast<Index>(expected)});
    }
}

// --- Maps -------------------------------------------------------------------------------------------------

// x -> A x + b in the plane.
struct Affine {
  double a[2][2], b[2];
  // Rows of `points`; `moved(i)`: whether b is added to row i. Tangents are not moved.
  template <class Moved>
  std::vector<double> of(const std::vector<double>& points, Moved moved) const {
    std::vector<double> image;
    for (std::size_t i = 0; i < points.size(); i += 2)
      for (int r = 0; r < 2; ++r)
        image.push_back(a[r][0] * points[i] + a[r][1] * points[i + 1] + (moved(i / 2) ? b[r] : 0));
    return image;
  }
};
constexpr Affine kShear{{{2, -0.5}, {0.25, 1}}, {3, -1}};
constexpr Affine kTurn{{{1.5, -2}, {2, 1.5}}, {3, -1}};  // keeps the proportion of distances

TEST_P(RefinedCurve, affine_maps_commute) {
  const Affine& map = measures_distances(rule()) ? kTurn : kShear;
  const bool hermite = std::holds_alternative<Hermite>(rule().basis);
  const auto all = [](std::size_t) { return true; };
  const auto none = [](std::size_t) { return false; };
  const auto curves = random_curve(GetParam(), 4, 2);
  auto mapped = curves;
  mapped.points = map.of(curves.points, [&](std::size_t i) { return !hermite || i % 2 == 0; });
  const Index level = 3;
  const Answer plain = refined(curves, level), found = refined(mapped, level);
  const auto points = map.of(plain.points(), all), limits = map.of(plain.limits, all),
             tangents = map.of(plain.tangents, none);
  ASSERT_EQ(found.points().size(), points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    ASSERT_NEAR(found.points()[k], points[k], 1e-13);
    ASSERT_NEAR(found.limits[k], limits[k], 1e-13);
    ASSERT_NEAR(found.tangents[k], tangents[k], 1e-11);
  }
}

// Weights of points sum to 1, those of tangents to 0.
TEST_P(RefinedCurve, points_that_coincide_stay_one_point_without_a_tangent) {
  auto curves = random_curve(GetParam(), 3, 2);
  for (std::size_t k = 0; k < curves.points.size(); ++k)
    curves.points[k] = std::holds_alternative<Hermite>(rule().basis) && k / 2 % 2 == 1 ? 0
                       : k % 2 == 0                                                    ? 0.7
                                                                                       : -0.3;
  const Answer fine = refined(curves, 4);
  ASSERT_FALSE(fine.points().empty());
  for (std::size_t k = 0; k < fine.points().size(); ++k) {
    const double value = k % 2 == 0 ? 0.7 : -0.3;
    ASSERT_NEAR(fine.points()[k], value, 4e-15);
    ASSERT_NEAR(fine.limits[k], value, 4e-15);
    ASSERT_NEAR(fine.tangents[k], 0, 1e-13);
  }
}

TEST_P(RefinedCurve, points_on_a_line_stay_on_it) {
  auto curves = random_curve(GetParam(), 4, 2);
  const double begin = std::holds_alternative<Hermite>(rule().basis) ? 0 : 1;  // tangents are not moved
  for (std::size_t i = 0; i < curves.points.size(); i += 2)
    curves.points[i + 1] = 3 * curves.points[i] - begin;
  const Answer fine = refined(curves, 4);
  ASSERT_FALSE(fine.points().empty());
  for (std::size_t i = 0; i < fine.points().size(); i += 2) {
    ASSERT_NEAR(fine.points()[i + 1], 3 * fine.points()[i] - begin, 1e-13);
    ASSERT_NEAR(fine.limits[i + 1], 3 * fine.limits[i] - begin, 1e-13);
    ASSERT_NEAR(fine.tangents[i + 1], 3 * fine.tangents[i], 1e-11);
  }
}

// --- Symmetry ---------------------------------------------------------------------------------------------

// Refined rows of the curve that runs back, in the order of the one that runs forth. A closed curve of a dual
// scheme has 2^level points around its first point: half of them before it.
std::vector<double> run_back(const ControlCurves& curves, Index level, const std::vector<double>& values) {
  const Count rows = values.size() / curves.width;
  const bool around = curves.wrap == CurveWrap::periodic && is_subdivided(curves.basis);
  const Count last = !around ? rows - 1 : split_of(curves).dual ? (Count{1} << level) - 1 + rows : rows;
  std::vector<double> back;
  for (Count i = 0; i < rows; ++i)
    for (Index k = 0; k < curves.width; ++k)
      back.push_back(values[(last - i + rows) % rows * curves.width + k]);
  return back;
}

// Where a tangent jumps, the one behind the place is given: before it, when run through backwards. Those of
// Bezier curves' joints are put aside.
std::vector<double> between_joints(const ControlCurves& curves, std::vector<double> tangents) {
  if (is_subdivided(curves.basis)) return tangents;
  for (Count i = 0; i < tangents.size(); ++i)
    if (i / curves.width % 3 == 0) tangents[i] = 0;
  return tangents;
}

TEST_P(RefinedCurve, running_back_gives_the_same_points) {
  for (const Count more : {0u, 7u}) {
    const auto curves = random_curve(GetParam(), more, 2);
    const Index level = 3;
    const Answer forth = refined(curves, level), back = refined(reverse(curves), level);
    expect_same(run_back(curves, level, back.points()), forth.points(), "points", 1e-13);
    expect_same(run_back(curves, level, back.limits), forth.limits, "limits", 1e-13);
    if (std::holds_alternative<Nurbs>(rule().basis))
      continue;  // knots of any multiplicity: joints are anywhere
    const auto tangents = scaled(run_back(curves, level, back.tangents), -1);
    expect_same(between_joints(curves, tangents), between_joints(curves, forth.tangents), "tangents", 1e-11);
  }
}

TEST_P(RefinedCurve, a_closed_curve_may_begin_anywhere) {
  if (rule().wrap != CurveWrap::periodic) return;
  const Count step = std::holds_alternative<Bezier>(rule().basis)    ? 3
                     : std::holds_alternative<Hermite>(rule().basis) ? 2
                                                                     : 1;
  const Index level = 3;
  auto curves = random_curve(GetParam(), 4, 2);
  Answer first = refined(curves, level);
  std::ranges::rotate(curves.points, curves.points.begin() + static_cast<std::ptrdiff_t>(2 * step));
  Answer second = refined(curves, level);
  const bool pieces = !is_subdivided(rule().basis);  // they end with their first point
  const std::ptrdiff_t shift = 2 * (pieces ? 3 : 1) * (1 << level);
  for (Answer* answer : {&first, &second})
    for (auto* values : {&answer->curves.points, &answer->limits, &answer->tangents}) {
      if (pieces) values->resize(values->size() - 2);
      if (answer == &first) std::ranges::rotate(*values, values->begin() + shift);
    }
  expect_same(second.points(), first.points(), "points", 1e-14);
  expect_same(second.limits, first.limits, "limits", 1e-14);
  expect_same(second.tangents, first.tangents, "tangents", 1e-13);
}

// --- Independence -----------------------------------------------------------------------------------------

TEST_P(RefinedCurve, curves_of_one_body_do_not_touch_one_another) {
  const auto one = random_curve(GetParam(), 1, 2, 5), two = random_curve(GetParam(), 8, 2, 6);
  const auto both = together(one, two);
  ASSERT_TRUE(both.check().ok());
  const Answer first = refined(one, 3), second = refined(two, 3), all = refined(both, 3);
  const auto joined = [](std::vector<double> a, const std::vector<double>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  EXPECT_EQ(all.points(), joined(first.points(), second.points()));
  EXPECT_EQ(all.limits, joined(first.limits, second.limits));
  EXPECT_EQ(all.tangents, joined(first.tangents, second.tangents));
  const Nurbs knots = nurbs_of(all.curves), before = nurbs_of(first.curves), after = nurbs_of(second.curves);
  EXPECT_EQ(knots.knots, joined(before.knots, after.knots));
  EXPECT_EQ(knots.weights, joined(before.weights, after.weights));
}

TEST_P(RefinedCurve, coordinates_do_not_touch_one_another) {
  if (measures_distances(rule())) return;
  for (const Index width : {2u, 4u, 700u}) {
    const auto wide = random_curve(GetParam(), 4, width);
    const Answer all = refined(wide, 2);
    for (const Index k : {0u, width / 2, width - 1}) {
      const Answer one = refined(coordinate(wide, k), 2);
      ASSERT_EQ(all.points().size(), one.points().size() * width);
      for (std::size_t i = 0; i < one.points().size(); ++i) {
        ASSERT_EQ(all.points()[i * width + k], one.points()[i]) << width << ", " << k;
        ASSERT_EQ(all.limits[i * width + k], one.limits[i]) << width << ", " << k;
        ASSERT_EQ(all.tangents[i * width + k], one.tangents[i]) << width << ", " << k;
      }
    }
  }
}

// --- Steps ------------------------------------------------------------------------------------------------

TEST_P(RefinedCurve, two_steps_and_three_steps_are_five_steps) {
  for (const Count more : {0u, 9u}) {
    const auto curves = random_curve(GetParam(), more, 2);
    const Answer at_once = refined(curves, 5), in_two = refined(refined(curves, 2).curves, 3);
    // A step leaves spans of the same length, which the parameter counts; knots stay where they are.
    const double slower = std::holds_alternative<Nurbs>(rule().basis) ? 1 : 4;
    expect_same(in_two.points(), at_once.points(), "points", 1e-13);
    expect_same(in_two.limits, at_once.limits, "limits", 1e-13);
    expect_same(scaled(in_two.tangents, slower), at_once.tangents, "tangents", 1e-10);
    expect_same(nurbs_of(in_two.curves).knots, nurbs_of(at_once.curves).knots, "knots", 1e-14);
    expect_same(nurbs_of(in_two.curves).weights, nurbs_of(at_once.curves).weights, "weights", 1e-13);
  }
}

// --- Scales -----------------------------------------------------------------------------------------------

// Powers of two change no digit: but of the lengths of vectors, in Catmull-Rom's distances.
TEST_P(RefinedCurve, huge_and_tiny_curves_are_the_same_curve) {
  const auto curves = random_curve(GetParam(), 3, 2);
  const Answer plain = refined(curves, 3);
  for (const int exponent : {-500, 500, 1000}) {
    auto large = curves;
    for (double& value : large.points) value = std::ldexp(value, exponent);
    const Answer found = refined(large, 3);
    const auto back = [&](std::vector<double> values) {
      for (double& value : values) value = std::ldexp(value, -exponent);
      return values;
    };
    expect_same(back(found.points()), plain.points(), "points", 1e-14);
    expect_same(back(found.limits), plain.limits, "limits", 1e-14);
    expect_same(back(found.tangents), plain.tangents, "tangents", 1e-12);
  }
}

TEST_P(RefinedCurve, the_largest_numbers_give_finite_answers_or_an_error) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  auto curves = random_curve(GetParam(), 4, 1);
  for (const bool spread : {false, true}) {
    for (std::size_t k = 0; k < curves.points.size(); ++k)
      curves.points[k] = spread && k % 3 == 1 ? -kLargest : kLargest;
    const auto result = refine<double>(curves, {.level = 3, .limit = true, .tangents = true}, Budget{});
    if (!result) {
      EXPECT_EQ(result.error().code, ErrorCode::out_of_range);
      continue;
    }
    for (const auto* values : {&result->points, &result->limit_points, &result->tangents})
      EXPECT_TRUE(std::ranges::all_of(*values, [](double x) { return std::isfinite(x); }));
  }
}

}  // namespace
}  // namespace subdivd::testing

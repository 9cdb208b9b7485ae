#include "core/splines/edit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/splines/bezier.h"
#include "core/splines/knot_removal.h"
#include "tests/core/splines/sample_splines.h"

namespace subdivd {
namespace {

double worst_between(const Spline& whole, const Spline& piece) {
  double worst = 0;
  for (const double t : samples::parameters(piece))
    worst = std::max(worst, samples::distance(samples::point_at(whole, t), samples::point_at(piece, t)));
  return worst;
}

TEST(Part, is_the_curve_between_two_parameters) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const double length = spline.end() - spline.begin();
    for (const auto& [a, b] : {std::pair{0.0, 1.0}, {0.0, 0.3}, {0.2, 0.9}, {0.5, 1.0}}) {
      const double from = spline.begin() + a * length,
                   to = b == 1 ? spline.end() : spline.begin() + b * length;
      const auto piece = part(spline, from, to);
      ASSERT_TRUE(piece) << name;
      ASSERT_TRUE(piece->check()) << name << ' ' << piece->check().error().message;
      EXPECT_EQ(piece->begin(), from);
      EXPECT_EQ(piece->end(), to);
      EXPECT_EQ(multiplicity(piece->knots, from), spline.degree + 1);
      EXPECT_LT(worst_between(spline, *piece), 1e-12) << name;
    }
  }
}

TEST(Part, at_knots_of_any_multiplicity_is_sound) {
  for (const auto& [name, spline] : samples::all_splines())
    for (const double t : spline.knots)
      if (t > spline.begin() && t < spline.end()) {
        const auto halves = split(spline, t);
        ASSERT_TRUE(halves) << name;
        for (const Spline& half : *halves) {
          ASSERT_TRUE(half.check()) << name << ' ' << half.check().error().message;
          EXPECT_LT(worst_between(spline, half), 1e-12) << name;
        }
      }
}

TEST(Part, refuses_what_lies_outside) {
  const Spline circle = samples::circle();
  EXPECT_EQ(part(circle, -1, 2).error().where, Path{"from"});
  EXPECT_EQ(part(circle, 1, 5).error().where, Path{"to"});
  EXPECT_EQ(part(circle, 2, 1).error().where, Path{"to"});
  EXPECT_EQ(part(circle, std::nan(""), 1).error().where, Path{"from"});
  EXPECT_FALSE(split(circle, 0).ok());
  EXPECT_FALSE(split(circle, 4).ok());
}

TEST(Join, takes_back_a_split) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const double t = (spline.begin() + 2 * spline.end()) / 3;
    const auto halves = split(spline, t);
    ASSERT_TRUE(halves);
    const auto joined = join((*halves)[0], (*halves)[1], 1e-9, {});
    ASSERT_TRUE(joined) << name;
    EXPECT_LT(samples::deviation(spline, *joined), 1e-12 * extent(spline)) << name;
    // And the knot that the cut has left can be removed again.
    const auto removal = remove_knot(*joined, t, spline.degree, 1e-9);
    EXPECT_EQ(removal->times, spline.degree) << name;
    EXPECT_LT(samples::deviation(spline, removal->result.spline), 1e-10) << name;
  }
}

TEST(Join, brings_curves_of_different_kinds_together) {
  const Spline circle = samples::circle();  // ends at (1, 0)
  const Spline line{1, 2, false, false, {10, 10, 12, 12}, {1, 0, 3, 0}};
  const auto joined = join(circle, line, 0, {});
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->degree, 2);
  EXPECT_EQ(joined->begin(), 0);
  EXPECT_EQ(joined->end(), 6);
  EXPECT_LT(samples::distance(samples::point_at(*joined, 5), {2, 0}), 1e-14);
  EXPECT_LT(samples::distance(samples::point_at(*joined, 2), {-1, 0}), 1e-14);
}

TEST(Join, refuses_a_gap_and_tells_how_wide_it_is) {
  const Spline line{1, 2, false, false, {0, 0, 1, 1}, {1, 0, 3, 0}};
  const auto refused = join(line, line, 0.5, {});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "the curves are 2 apart where they should meet; 0.5 are allowed");
  EXPECT_TRUE(join(line, line, 2, {}));
  EXPECT_FALSE(join(line, line, std::nan(""), {}).ok());
  const Spline space{1, 3, false, false, {0, 0, 1, 1}, {1, 0, 0, 3, 0, 0}};
  EXPECT_EQ(join(line, space, 1e9, {}).error().code, ErrorCode::wrong_length);
}

TEST(Reversed, runs_backwards_and_twice_is_the_same) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const Spline back = reverse(spline);
    ASSERT_TRUE(back.check()) << name;
    for (const double t : samples::parameters(spline, 100)) {
      const double mirrored = std::clamp(spline.begin() + (spline.end() - t), spline.begin(), spline.end());
      EXPECT_LT(samples::distance(samples::point_at(spline, t), samples::point_at(back, mirrored)), 1e-12)
          << name;
    }
    EXPECT_EQ(reverse(back).points, spline.points);
  }
}

TEST(Reparametrized, goes_through_the_same_points) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const auto moved = reparametrize(spline, -5, 20);
    ASSERT_TRUE(moved) << name;
    EXPECT_EQ(moved->begin(), -5);
    EXPECT_EQ(moved->end(), 20);
    for (int k = 0; k <= 100; ++k) {
      const double share = k / 100.0, t = spline.begin() + share * (spline.end() - spline.begin());
      EXPECT_LT(samples::distance(samples::point_at(spline, std::min(t, spline.end())),
                                  samples::point_at(*moved, -5 + 25 * share)),
                1e-12)
          << name;
    }
  }
  EXPECT_FALSE(reparametrize(samples::circle(), 1, 1).ok());
  EXPECT_FALSE(reparametrize(samples::circle(), 0, INFINITY).ok());
  // So short that knots fall together.
  EXPECT_FALSE(reparametrize(samples::circle(), 1, std::nextafter(1.0, 2.0)).ok());
}

TEST(BezierPieces, are_the_curve) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const std::vector<BezierPiece> pieces = bezier_pieces(spline);
    EXPECT_EQ(pieces.front().begin, spline.begin());
    EXPECT_EQ(pieces.back().end, spline.end());
    std::vector<double> stored(spline.width), point(spline.dimension());
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      EXPECT_EQ(pieces[k].begin, k == 0 ? spline.begin() : pieces[k - 1].end);
      for (const BezierPiece& half : halves(pieces[k], spline.width))
        for (int step = 0; step <= 10; ++step) {
          const double t = std::min(half.end, half.begin + (half.end - half.begin) * step / 10);
          evaluate(half, spline.width, t, stored);
          project(stored, spline.rational, point);
          EXPECT_LT(samples::distance(point, samples::point_at(spline, t)), 1e-12) << name << ' ' << t;
        }
    }
    const Spline again = spline_of(pieces, spline.degree, spline.width, spline.rational);
    ASSERT_TRUE(again.check()) << name;
    EXPECT_LT(samples::deviation(spline, again), 1e-12) << name;
  }
}

}  // namespace
}  // namespace subdivd

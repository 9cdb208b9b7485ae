#include "core/curves/bases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/splines/edit.h"
#include "tests/core/splines/sample_splines.h"

namespace subdivd {
namespace {

std::vector<double> random_points(Count count, Index width, unsigned seed) {
  samples::Random random(seed);
  std::vector<double> points(count * width);
  for (double& x : points) x = random.centred();
  return points;
}

std::vector<double> point(const std::vector<double>& points, Count i, Index width = 2) {
  const auto first = points.begin() + static_cast<std::ptrdiff_t>(i * width);
  return {first, first + width};
}

constexpr CurveWrap kWraps[] = {CurveWrap::nonperiodic, CurveWrap::periodic, CurveWrap::pinned};

TEST(Bases, make_sound_splines_over_the_domains_they_name) {
  for (const CurveWrap wrap : kWraps) {
    for (Index degree = 1; degree <= 15; ++degree)
      for (const Count n : {Count{degree} + 1, Count{degree} + 4}) {
        if (n < 3) continue;
        const Spline spline = spline_of_bspline(random_points(n, 2, 1), 2, wrap, degree);
        ASSERT_TRUE(spline.check()) << degree << ' ' << spline.check().error().message;
        const double half = degree % 2 == 0 ? 0.5 : 0, m = degree / 2;
        const double first = wrap == CurveWrap::nonperiodic ? m - half
                             : wrap == CurveWrap::periodic  ? -half
                                                            : 0;
        const auto points = static_cast<double>(n);
        const double length = wrap == CurveWrap::nonperiodic ? points - degree
                              : wrap == CurveWrap::periodic  ? points
                                                             : points - (degree % 2 == 0 ? 2.0 : 1.0);
        EXPECT_EQ(spline.begin(), first) << degree;
        EXPECT_EQ(spline.end(), first + length) << degree;
      }
    const Spline rom = spline_of_catmull_rom(random_points(6, 2, 9), 2, wrap, Spacing::centripetal);
    ASSERT_TRUE(rom.check());
    EXPECT_EQ(rom.begin(), wrap == CurveWrap::nonperiodic ? 1 : 0);
    EXPECT_EQ(rom.end(), wrap == CurveWrap::nonperiodic ? 4 : wrap == CurveWrap::periodic ? 6 : 5);
  }
}

TEST(Bspline, pinned_starts_and_ends_at_its_ends) {
  for (Index degree = 1; degree <= 15; ++degree)
    for (const Count n : {Count{3}, Count{4}, Count{9}, Count{20}}) {
      const std::vector<double> points = random_points(n, 2, degree);
      const Spline spline = spline_of_bspline(points, 2, CurveWrap::pinned, degree);
      EXPECT_LT(samples::distance(samples::point_at(spline, spline.begin()), point(points, 0)), 1e-12)
          << degree;
      EXPECT_LT(samples::distance(samples::point_at(spline, spline.end()), point(points, n - 1)), 1e-11)
          << degree;
    }
}

// Degree 2, pinned: knots 0 0 0 1 2 ... and the points as they are.
TEST(Bspline, pinned_of_degree_two_is_the_clamped_one) {
  const std::vector<double> points = random_points(7, 3, 4);
  const Spline clamped{2, 3, false, false, {0, 0, 0, 1, 2, 3, 4, 5, 5, 5}, points};
  EXPECT_LT(samples::deviation(clamped, spline_of_bspline(points, 3, CurveWrap::pinned, 2)), 1e-14);
}

TEST(Bspline, periodic_closes_as_smoothly_as_it_can) {
  for (Index degree = 1; degree <= 7; ++degree) {
    const Spline spline = spline_of_bspline(random_points(9, 2, degree), 2, CurveWrap::periodic, degree);
    std::vector<double> begin(2 * degree), end(2 * degree);
    ASSERT_TRUE(derivatives(spline, spline.begin(), degree - 1, begin));
    ASSERT_TRUE(derivatives(spline, spline.end(), degree - 1, end));
    for (std::size_t k = 0; k < begin.size(); ++k) EXPECT_NEAR(begin[k], end[k], 1e-10) << degree << ' ' << k;
  }
}

TEST(CatmullRom, goes_through_its_points) {
  const std::vector<double> points = random_points(8, 2, 7);
  for (const CurveWrap wrap : kWraps)
    for (const Spacing spacing : {Spacing::uniform, Spacing::centripetal, Spacing::chordal}) {
      const Spline spline = spline_of_catmull_rom(points, 2, wrap, spacing);
      for (double t = spline.begin(); t <= spline.end(); t += 1)
        EXPECT_LT(samples::distance(samples::point_at(spline, t), point(points, static_cast<Count>(t) % 8)),
                  1e-14);
    }
}

// The uniform rule, written out.
TEST(CatmullRom, uniform_has_the_tangents_of_its_neighbours) {
  const std::vector<double> points = random_points(8, 2, 8);
  const Spline spline = spline_of_catmull_rom(points, 2, CurveWrap::periodic, Spacing::uniform);
  for (int i = 0; i < 8; ++i) {
    std::vector<double> rows(4);
    ASSERT_TRUE(derivatives(spline, i, 1, rows));
    for (Index k = 0; k < 2; ++k)
      EXPECT_NEAR(rows[2 + k], (point(points, (i + 1) % 8)[k] - point(points, (i + 7) % 8)[k]) / 2, 1e-14);
  }
}

// Barry and Goldman's pyramid of linear interpolations is the same curve.
TEST(CatmullRom, is_the_pyramid_of_Barry_and_Goldman) {
  const std::vector<double> points = random_points(4, 2, 21);
  for (const double power : {0.0, 0.5, 1.0}) {
    const Spacing spacing = power == 0   ? Spacing::uniform
                            : power == 1 ? Spacing::chordal
                                         : Spacing::centripetal;
    const Spline spline = spline_of_catmull_rom(points, 2, CurveWrap::nonperiodic, spacing);
    double knots[4] = {0};
    for (Count i = 1; i < 4; ++i)
      knots[i] = knots[i - 1] + std::pow(samples::distance(point(points, i), point(points, i - 1)), power);
    for (int step = 0; step <= 20; ++step) {
      const double share = step / 20.0, t = knots[1] + share * (knots[2] - knots[1]);
      std::vector<std::vector<double>> net;
      for (Count i = 0; i < 4; ++i) net.push_back(point(points, i));
      const auto mix = [&](Count i, Count low, Count high) {
        for (std::size_t k = 0; k < 2; ++k)
          net[i][k] =
              ((knots[high] - t) * net[i][k] + (t - knots[low]) * net[i + 1][k]) / (knots[high] - knots[low]);
      };
      for (Count i = 0; i < 3; ++i) mix(i, i, i + 1);
      for (Count i = 0; i < 2; ++i) mix(i, i, i + 2);
      mix(0, 1, 2);
      EXPECT_LT(samples::distance(samples::point_at(spline, 1 + share), net[0]), 1e-13)
          << power << ' ' << share;
    }
  }
}

TEST(CatmullRom, has_no_trouble_with_points_that_coincide) {
  const std::vector<double> points{0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 2, 0};
  for (const CurveWrap wrap : kWraps)
    for (const Spacing spacing : {Spacing::uniform, Spacing::centripetal, Spacing::chordal}) {
      const Spline spline = spline_of_catmull_rom(points, 2, wrap, spacing);
      ASSERT_TRUE(spline.check());
      for (const double t : samples::parameters(spline, 50))
        EXPECT_TRUE(std::isfinite(samples::point_at(spline, t)[0]));
    }
}

TEST(Hermite, has_the_points_and_tangents_it_was_given) {
  const std::vector<double> points = random_points(10, 2, 12);
  for (const CurveWrap wrap : {CurveWrap::nonperiodic, CurveWrap::periodic}) {
    const Spline spline = spline_of_hermite(points, 2, wrap);
    for (Count i = 0; i < 5; ++i) {
      std::vector<double> rows(4);
      ASSERT_TRUE(derivatives(spline, static_cast<double>(i), 1, rows));
      for (Index k = 0; k < 2; ++k) {
        EXPECT_NEAR(rows[k], point(points, 2 * i)[k], 1e-14);
        EXPECT_NEAR(rows[2 + k], point(points, 2 * i + 1)[k], 1e-14);
      }
    }
  }
}

TEST(Bezier, is_what_its_polynomials_say) {
  const std::vector<double> points{0, 0, 1, 2, 3, 2, 4, 0, 5, -2, 6, 0};
  const Spline closed = spline_of_bezier(points, 2, CurveWrap::periodic);
  EXPECT_EQ(closed.end(), 2);
  EXPECT_EQ(samples::point_at(closed, 0.5), (std::vector<double>{2, 1.5}));
  EXPECT_EQ(samples::point_at(closed, 2), (std::vector<double>{0, 0}));
  EXPECT_EQ(samples::point_at(closed, 2.5), (std::vector<double>{2, 1.5}));
}

// --- Back -------------------------------------------------------------------------------------------------

// Where each basis is asked for what it made itself, and for the others where they exist.
TEST(Conversion, takes_every_basis_back) {
  const std::vector<double> points = random_points(10, 3, 33);
  const auto near = [&](const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-12) << k;
  };
  near(*bezier_points(spline_of_bezier(points, 3, CurveWrap::nonperiodic), {}), points);
  near(*bspline_points(spline_of_bspline(points, 3, CurveWrap::nonperiodic, 3), 1e-9, {}), points);
  near(*catmull_rom_points(spline_of_catmull_rom(points, 3, CurveWrap::nonperiodic, Spacing::uniform), 1e-9,
                           {}),
       points);
  near(*hermite_points(spline_of_hermite(points, 3, CurveWrap::nonperiodic), 1e-9, {}), points);
}

TEST(Conversion, keeps_the_points_of_the_curve) {
  const std::vector<double> points = random_points(10, 3, 35);
  for (const CurveWrap wrap : kWraps)
    for (const Spline& spline :
         {spline_of_bspline(points, 3, wrap, 3), spline_of_catmull_rom(points, 3, wrap, Spacing::uniform)}) {
      const Spline at_zero = *reparametrize(spline, 0, spline.end() - spline.begin());
      EXPECT_LT(samples::deviation(at_zero,
                                   spline_of_bezier(*bezier_points(spline, {}), 3, CurveWrap::nonperiodic)),
                1e-12);
      EXPECT_LT(samples::deviation(
                    at_zero, spline_of_hermite(*hermite_points(spline, 1e-9, {}), 3, CurveWrap::nonperiodic)),
                1e-12);
    }
  // Degrees 1 and 2 are cubic, too.
  for (const Index degree : {1u, 2u}) {
    const Spline spline = spline_of_bspline(points, 3, CurveWrap::nonperiodic, degree);
    const Spline at_zero = *reparametrize(spline, 0, spline.end() - spline.begin());
    EXPECT_LT(
        samples::deviation(at_zero, spline_of_bezier(*bezier_points(spline, {}), 3, CurveWrap::nonperiodic)),
        1e-12);
  }
}

TEST(Conversion, refuses_what_does_not_exist) {
  const std::vector<double> points = random_points(10, 3, 36);
  const Spline bspline = spline_of_bspline(points, 3, CurveWrap::nonperiodic, 3);
  const Spline bezier = spline_of_bezier(points, 3, CurveWrap::nonperiodic);
  const Spline quartic = spline_of_bspline(points, 3, CurveWrap::nonperiodic, 4);
  for (const auto& refused :
       {catmull_rom_points(bspline, 1e-9, {}), bspline_points(bezier, 1e-9, {}),
        hermite_points(bezier, 1e-9, {}), bezier_points(quartic, {}), bezier_points(samples::circle(), {})}) {
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
  }
}

}  // namespace
}  // namespace subdivd

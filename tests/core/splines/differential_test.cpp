#include "core/splines/differential.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/splines/bspline.h"
#include "tests/core/splines/sample_splines.h"

namespace subdivd {
namespace {

using samples::bezier;

std::vector<double> rows_of(const Spline& spline, double t, Index order = 3) {
  std::vector<double> rows((order + 1) * spline.dimension());
  EXPECT_TRUE(derivatives(spline, t, order, rows).ok());
  return rows;
}

std::vector<double> noise_of(const Spline& spline, double t, Index order = 3) {
  const auto noise = derivative_noise(spline, t, order);
  EXPECT_TRUE(noise.ok());
  return noise ? *noise : std::vector<double>{};
}

// (r cos t, r sin t, c t): curvature r / (r^2 + c^2), torsion c / (r^2 + c^2).
std::vector<double> helix(double r, double c, double t) {
  const double x = r * std::cos(t), y = r * std::sin(t);
  return {x, y, c * t, -y, x, c, -x, -y, 0, y, -x, 0};
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

TEST(Differential, a_helix_has_its_curvature_and_torsion) {
  for (const double c : {0.5, -2.0, 0.0})
    for (const double t : {0.0, 0.8, 3.0}) {
      const auto rows = helix(1.5, c, t);
      const double square = 1.5 * 1.5 + c * c;
      EXPECT_NEAR(*speed(rows, 3), std::sqrt(square), 1e-15);
      EXPECT_NEAR(*curvature(rows, 3), 1.5 / square, 1e-15);
      EXPECT_NEAR(*torsion(rows), c / square, 1e-15);
      const auto frame = frenet_frame(rows, 3);
      ASSERT_TRUE(frame.has_value());
      // The normal points to the axis.
      EXPECT_NEAR(frame->normal[0], -std::cos(t), 1e-15);
      EXPECT_NEAR(frame->normal[1], -std::sin(t), 1e-15);
      EXPECT_NEAR(frame->normal[2], 0, 1e-15);
      EXPECT_NEAR(frame->binormal[2], 1.5 / std::sqrt(square), 1e-15);
    }
}

TEST(Differential, a_circle_has_curvature_one_whichever_way_it_is_parametrized) {
  const Spline circle = samples::circle();
  for (const double t : samples::parameters(circle, 100))
    EXPECT_NEAR(*curvature(rows_of(circle, t), 2), 1, 1e-13);
}

TEST(Differential, clockwise_curves_have_negative_curvature_in_the_plane) {
  EXPECT_GT(*curvature(rows_of(bezier(2, {0, 0, 1, 0, 1, 1}), 0.4, 2), 2), 0);
  EXPECT_LT(*curvature(rows_of(bezier(2, {1, 1, 1, 0, 0, 0}), 0.4, 2), 2), 0);
}

TEST(Differential, a_parabola_has_its_curvature_in_any_dimension) {
  // y = x^2 in the last two of `dimension` coordinates.
  for (Index dimension = 2; dimension <= 7; ++dimension)
    for (const double u : {0.0, 0.3, 1.0}) {
      std::vector<double> rows(3 * dimension, 0.0);
      rows[2 * dimension - 2] = 1, rows[2 * dimension - 1] = 2 * u, rows[3 * dimension - 1] = 2;
      EXPECT_NEAR(*curvature(rows, dimension), 2 / std::pow(1 + 4 * u * u, 1.5), 1e-15) << dimension;
    }
}

// T' = v k N,  N' = v (-k T + t B),  B' = -v t N, by central differences.   [Frenet, Serret]
TEST(Differential, frames_turn_as_the_equations_of_frenet_say) {
  for (unsigned seed = 1; seed < 9; ++seed) {
    const Spline spline = samples::random_spline(seed, 5, 3, seed % 2 == 0, true, 1);
    const double span = spline.end() - spline.begin(), step = 1e-6 * span;
    for (const double share : {0.21, 0.52, 0.83}) {
      const double t = spline.begin() + share * span;
      const auto rows = rows_of(spline, t);
      const auto here = frenet_frame(rows, 3);
      const auto before = frenet_frame(rows_of(spline, t - step), 3);
      const auto after = frenet_frame(rows_of(spline, t + step), 3);
      ASSERT_TRUE(here && before && after);
      const double v = *speed(rows, 3), k = *curvature(rows, 3), w = *torsion(rows);
      const double allowed = 1e-6 * (1 + v * (k + std::abs(w))) * (1 + v * (k + std::abs(w)));
      for (std::size_t x = 0; x < 3; ++x) {
        const auto slope = [&](auto part) { return ((*after).*part)[x] - ((*before).*part)[x]; };
        EXPECT_NEAR(slope(&FrenetFrame::tangent) / (2 * step), v * k * here->normal[x], allowed);
        EXPECT_NEAR(slope(&FrenetFrame::normal) / (2 * step),
                    v * (w * here->binormal[x] - k * here->tangent[x]), allowed);
        EXPECT_NEAR(slope(&FrenetFrame::binormal) / (2 * step), -v * w * here->normal[x], allowed);
      }
    }
  }
}

TEST(Differential, frames_are_orthonormal_and_right_handed) {
  for (const auto& [name, spline] : samples::all_splines())
    for (const double t : samples::parameters(spline, 7)) {
      const auto frame = frenet_frame(rows_of(spline, t), spline.dimension());
      if (!frame) continue;
      EXPECT_NEAR(dot(frame->tangent, frame->tangent), 1, 1e-14) << name;
      EXPECT_NEAR(dot(frame->normal, frame->normal), 1, 1e-14) << name;
      EXPECT_NEAR(dot(frame->tangent, frame->normal), 0, 1e-14) << name;
      if (spline.dimension() != 3) continue;
      const auto &a = frame->tangent, &b = frame->normal, &c = frame->binormal;
      EXPECT_NEAR(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                      a[2] * (b[0] * c[1] - b[1] * c[0]),
                  1, 1e-14)
          << name;
    }
}

// An almost straight curve: what is across is 1e-12 of what is along.
TEST(Differential, stays_orthogonal_where_the_curve_hardly_bends) {
  const auto frame = frenet_frame(std::vector<double>{0, 0, 0, 1, 2, 3, 1, 2 + 1e-12, 3}, 3);
  ASSERT_TRUE(frame.has_value());
  EXPECT_NEAR(dot(frame->tangent, frame->normal), 0, 1e-15);
}

TEST(Differential, does_not_depend_on_the_units_of_length_and_parameter) {
  const auto rows = helix(1.5, 0.5, 1.1);
  for (const int length : {-500, -332, 0, 332, 500})
    for (const int time : {-60, 0, 60}) {
      std::vector<double> scaled = rows;
      for (Index d = 0; d <= 3; ++d)
        for (Index k = 0; k < 3; ++k)
          scaled[d * 3 + k] = std::ldexp(rows[d * 3 + k], length + static_cast<int>(d) * time);
      EXPECT_EQ(*curvature(scaled, 3), std::ldexp(*curvature(rows, 3), -length));
      EXPECT_EQ(*torsion(scaled), std::ldexp(*torsion(rows), -length));
      EXPECT_EQ(*unit_tangent(scaled, 3), *unit_tangent(rows, 3));
      EXPECT_EQ(frenet_frame(scaled, 3)->binormal, frenet_frame(rows, 3)->binormal);
    }
}

TEST(Differential, without_a_derivative_nothing_exists_but_the_speed) {
  const std::vector<double> stop{1, 2, 3, 0, 0, 0, 1, 2, 0, 0, 0, 1};
  EXPECT_EQ(speed(stop, 3), 0.0);
  EXPECT_FALSE(unit_tangent(stop, 3).has_value());
  EXPECT_FALSE(curvature(stop, 3).has_value());
  EXPECT_FALSE(torsion(stop).has_value());
  EXPECT_FALSE(frenet_frame(stop, 3).has_value());
}

TEST(Differential, a_straight_line_has_curvature_zero_and_no_normal_in_space) {
  const std::vector<double> line{0, 0, 0, 1, 2, 3, 2, 4, 6, 0, 0, 0};
  EXPECT_EQ(curvature(line, 3), 0.0);
  EXPECT_TRUE(unit_tangent(line, 3).has_value());
  EXPECT_FALSE(torsion(line).has_value());
  EXPECT_FALSE(frenet_frame(line, 3).has_value());
  // Parallel but for the last bits.
  EXPECT_FALSE(
      frenet_frame(std::vector<double>{0, 0, 0, 0.1, 0.7, -0.3, 0.1 / 3, 0.7 / 3, -0.3 / 3}, 3).has_value());
  const auto plane = frenet_frame(std::vector<double>{0, 0, 3, 4, 0, 0}, 2);
  ASSERT_TRUE(plane.has_value());
  EXPECT_EQ(plane->normal, (std::vector<double>{-4.0 / 5, 3.0 / 5}));
}

TEST(Differential, in_one_dimension_the_tangent_is_a_sign) {
  EXPECT_EQ(*unit_tangent(std::vector<double>{7, -3, 5}, 1), (std::vector<double>{-1}));
  EXPECT_EQ(curvature(std::vector<double>{7, -3, 5}, 1), 0.0);
  EXPECT_FALSE(frenet_frame(std::vector<double>{7, -3, 5}, 1).has_value());
}

TEST(Differential, what_outgrows_doubles_is_absent) {
  constexpr double kMax = std::numeric_limits<double>::max();
  EXPECT_FALSE(speed(std::vector<double>{0, 0, kMax, kMax}, 2).has_value());
  EXPECT_FALSE(curvature(std::vector<double>{0, 0, 1e-200, 0, 0, 1}, 2).has_value());
  EXPECT_TRUE(unit_tangent(std::vector<double>{0, 0, kMax, kMax}, 2).has_value());
}

// --- Noise ------------------------------------------------------------------------------------------------

// Straight, but for the last bits of its points.
TEST(DerivativeNoise, tells_a_straight_line_from_its_rounding) {
  for (const double offset : {0.0, 1.0, 1e8}) {
    std::vector<double> points;
    for (int i = 0; i < 6; ++i)
      for (const double slope : {0.1, 0.7, -0.3}) points.push_back(offset + slope * i / 3);
    const Spline line = bezier(3, points);
    for (const double t : {0.0, 0.3, 0.9}) {
      const auto rows = rows_of(line, t), noise = noise_of(line, t);
      EXPECT_EQ(curvature(rows, 3, noise), 0.0) << offset;
      EXPECT_FALSE(frenet_frame(rows, 3, noise).has_value()) << offset;
      EXPECT_TRUE(unit_tangent(rows, 3, noise).has_value()) << offset;
    }
  }
}

TEST(DerivativeNoise, tells_a_line_of_changing_speed_from_its_rounding) {
  for (const double offset : {0.0, 1.0, 1e8}) {
    std::vector<double> points;
    for (int i = 0; i < 6; ++i)
      for (const double slope : {0.1, 0.7, -0.3}) points.push_back(offset + slope * (i * i + i) / 3);
    const Spline line = bezier(3, points);
    for (const double t : {0.1, 0.3, 0.9}) {
      const auto rows = rows_of(line, t), noise = noise_of(line, t);
      EXPECT_GT(rows[7], 1) << offset;
      EXPECT_EQ(curvature(rows, 3, noise), 0.0) << offset;
      EXPECT_FALSE(torsion(rows, noise).has_value()) << offset;
      EXPECT_FALSE(frenet_frame(rows, 3, noise).has_value()) << offset;
    }
  }
}

TEST(DerivativeNoise, tells_a_cusp_from_its_rounding) {
  for (const double offset : {0.0, 0.1, 1e8}) {
    Spline cusp = bezier(2, {1, -1, -1.0 / 3, 1, -1.0 / 3, -1, 1, 1});
    for (double& x : cusp.points) x += offset;
    EXPECT_FALSE(unit_tangent(rows_of(cusp, 0.5), 2, noise_of(cusp, 0.5)).has_value()) << offset;
    EXPECT_TRUE(unit_tangent(rows_of(cusp, 0.501), 2, noise_of(cusp, 0.501)).has_value()) << offset;
  }
}

TEST(DerivativeNoise, leaves_curves_that_bend_as_they_are) {
  for (const auto& [name, spline] : samples::all_splines())
    for (const double t : samples::parameters(spline, 11)) {
      const auto rows = rows_of(spline, t);
      EXPECT_EQ(curvature(rows, spline.dimension(), noise_of(spline, t)), curvature(rows, spline.dimension()))
          << name;
    }
}

// sum_i N_i^(d) x_i by the recurrence for derivatives of splines, every step in long double.
std::vector<long double> naive_derivative(const Spline& spline, double t, Index order) {
  const Count span = find_span(spline, t);
  Index p = spline.degree;
  const Index width = spline.width;
  std::vector<long double> net;
  for (Count i = 0; i < Count{p + 1} * width; ++i) net.push_back(spline.points[(span - p) * width + i]);
  const auto knot = [&](Count i) { return static_cast<long double>(spline.knots[i]); };
  for (Index d = 0; d < order; ++d, --p)
    for (Count j = 0; j < p; ++j) {
      const long double gap = knot(span + 1 + j) - knot(span + 1 + j - p);
      for (Index k = 0; k < width; ++k)
        net[j * width + k] = p * (net[(j + 1) * width + k] - net[j * width + k]) / gap;
    }
  for (; p > 0; --p)
    for (Count j = 0; j < p; ++j) {
      const long double low = knot(span + 1 + j - p), gap = knot(span + 1 + j) - low;
      for (Index k = 0; k < width; ++k) {
        const long double share = (static_cast<long double>(t) - low) / gap;
        net[j * width + k] = (1 - share) * net[j * width + k] + share * net[(j + 1) * width + k];
      }
    }
  net.resize(width);
  return net;
}

TEST(DerivativeNoise, bounds_the_error_of_derivatives_and_not_by_much_more) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const Index dimension = spline.dimension(), order = std::min<Index>(spline.degree, 3);
    for (const double t : samples::parameters(spline, 29)) {
      const auto rows = rows_of(spline, t, order), noise = noise_of(spline, t, order);
      std::vector<std::vector<long double>> stored, exact;
      for (Index d = 0; d <= order; ++d) {
        stored.push_back(naive_derivative(spline, t, d));
        exact.push_back(stored[d]);
        double largest = 1, square = 0;
        for (Index k = 0; k < dimension; ++k) {
          long double binomial = 1;
          for (Index i = 1; spline.rational && i <= d; ++i) {
            binomial = binomial * (d - i + 1) / i;
            exact[d][k] -= binomial * stored[i][dimension] * exact[d - i][k];
          }
          if (spline.rational) exact[d][k] /= stored[0][dimension];
          const auto off =
              static_cast<double>(exact[d][k] - static_cast<long double>(rows[d * dimension + k]));
          square += off * off;
          largest = std::max(largest, std::abs(rows[d * dimension + k]));
        }
        EXPECT_LE(std::sqrt(square), noise[d]) << name << " at " << t << " order " << d;
        // Factors of basis functions and weights that almost cancel can be large; hundreds of thousands they
        // are not.
        EXPECT_LE(noise[d], 1e-9 * largest * std::pow(10.0, d)) << name << " at " << t << " order " << d;
      }
    }
  }
}

TEST(DerivativeNoise, follows_the_units) {
  Spline spline = samples::random_spline(3, 3, 3, true, true, 1);
  const auto plain = noise_of(spline, (spline.begin() + spline.end()) / 2, 2);
  for (Count i = 0; i < spline.points.size(); ++i)
    if (i % 4 != 3) spline.points[i] = std::ldexp(spline.points[i], 300);
  const auto scaled = noise_of(spline, (spline.begin() + spline.end()) / 2, 2);
  for (Index d = 0; d <= 2; ++d) EXPECT_EQ(scaled[d], std::ldexp(plain[d], 300));
}

TEST(DerivativeNoise, refuses_what_derivatives_refuses) {
  EXPECT_EQ(derivative_noise(samples::circle(), 5, 2).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(derivative_noise(samples::circle(), std::nan(""), 2).error().code, ErrorCode::not_finite);
}

}  // namespace
}  // namespace subdivd

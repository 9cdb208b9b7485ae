#include "core/analysis/spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace subdivd::testing {
namespace {

constexpr LoopWeights kBoth[] = {LoopWeights::loop, LoopWeights::warren};

Spectrum value_of(Result<Spectrum> result) {
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return result.ok() ? std::move(result).value() : Spectrum{};
}

Spectrum loop_at(LoopWeights weights, Index n) {
  return value_of(smooth_spectrum(Loop{weights}, n, Budget{}));
}
Spectrum border_at(Index n) { return value_of(border_spectrum(Loop{}, n, Budget{})); }
Spectrum bspline(Index degree) { return value_of(lane_riesenfeld_spectrum(degree, Budget{})); }
Spectrum four_point(double tension) { return value_of(four_point_spectrum(tension, Budget{})); }

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x;
  return sum;
}

// Largest entry of mask S - value mask.
double residual(const Spectrum& s, const std::vector<double>& mask, double value) {
  double worst = 0;
  for (std::size_t j = 0; j < mask.size(); ++j) {
    double sum = -value * mask[j];
    for (std::size_t i = 0; i < mask.size(); ++i) sum += mask[i] * s.matrix[i * mask.size() + j];
    worst = std::max(worst, std::abs(sum));
  }
  return worst;
}

std::vector<Spectrum> samples() {
  std::vector<Spectrum> all;
  for (const LoopWeights weights : kBoth)
    for (Index n = 3; n <= 12; ++n) all.push_back(loop_at(weights, n));
  for (Index n = 2; n <= 9; ++n) all.push_back(border_at(n));
  for (Index p = 1; p <= 15; ++p) all.push_back(bspline(p));
  for (const double w : {0.0, 0.03, 1.0 / 16}) all.push_back(four_point(w));
  return all;
}

TEST(Spectrum, has_one_eigenvalue_per_row_descending_from_one) {
  for (const Spectrum& s : samples()) {
    ASSERT_EQ(s.eigenvalues.size(), s.labels.size());
    ASSERT_EQ(s.matrix.size(), s.labels.size() * s.labels.size());
    EXPECT_NEAR(s.eigenvalues[0], 1, 1e-14);
    for (std::size_t k = 1; k < s.eigenvalues.size(); ++k)
      EXPECT_LE(std::abs(s.eigenvalues[k]), std::abs(s.eigenvalues[k - 1]));
    EXPECT_EQ(s.subdominant, s.eigenvalues[1]);
    EXPECT_LT(s.subsubdominant, s.subdominant);
  }
}

TEST(Spectrum, rows_sum_to_one_and_the_eigenvalues_to_the_trace) {
  for (const Spectrum& s : samples()) {
    const std::size_t n = s.labels.size();
    double trace = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < n; ++j) sum += s.matrix[i * n + j];
      EXPECT_NEAR(sum, 1, 1e-15);
      trace += s.matrix[i * n + i];
    }
    EXPECT_NEAR(sum_of(s.eigenvalues), trace, 1e-13) << s.scheme;
  }
}

TEST(Spectrum, limit_masks_sum_to_one_and_tangent_masks_to_zero) {
  for (const Spectrum& s : samples()) {
    EXPECT_NEAR(sum_of(s.limit_mask), 1, 1e-15);
    EXPECT_EQ(s.tangent_masks.size(), s.scheme == "loop" ? 2u : 1u);
    for (const auto& mask : s.tangent_masks)
      EXPECT_NEAR(sum_of(mask), 0, 1e-13) << s.scheme << s.labels.size();
  }
}

TEST(Spectrum, masks_are_left_eigenvectors) {
  for (const Spectrum& s : samples()) {
    EXPECT_LT(residual(s, s.limit_mask, 1), 1e-14);
    const bool border = s.scheme == "loop" && (s.valence == 2 || s.matrix[2] == 0);
    if (border) continue;  // two values: see LoopBorderSpectrum
    for (const auto& mask : s.tangent_masks) EXPECT_LT(residual(s, mask, s.subdominant), 1e-14) << s.scheme;
  }
}

// --- Loop
// ---------------------------------------------------------------------------------------------------

TEST(LoopSpectrum, has_the_eigenvalues_of_the_closed_forms) {
  for (const LoopWeights weights : kBoth)
    for (Index n = 3; n <= 40; ++n) {
      const Spectrum s = loop_at(weights, n);
      std::vector<double> expected = {1, 5.0 / 8 - n * Loop{weights}.beta(n)};
      for (Index k = 1; k < n; ++k) expected.push_back(3.0 / 8 + std::cos(2 * std::numbers::pi * k / n) / 4);
      std::sort(expected.rbegin(), expected.rend());
      ASSERT_EQ(s.eigenvalues.size(), expected.size());
      for (std::size_t k = 0; k < expected.size(); ++k)
        EXPECT_NEAR(s.eigenvalues[k], expected[k], 1e-14) << n;
      EXPECT_EQ(s.defect, 0u);
    }
}

TEST(LoopSpectrum, has_the_masks_that_the_scheme_returns) {
  for (const LoopWeights weights : kBoth)
    for (Index n = 3; n <= 40; ++n) {
      const Spectrum s = loop_at(weights, n);
      const Loop loop{weights};
      const VertexMask limit = loop.smooth_limit_mask(n);
      const RingMask u = loop.smooth_tangent_u(n), v = loop.smooth_tangent_v(n);
      EXPECT_NEAR(s.limit_mask[0], limit.self, 1e-14) << n;
      EXPECT_NEAR(s.tangent_masks[0][0], 0, 1e-13);
      EXPECT_NEAR(s.tangent_masks[1][0], 0, 1e-13);
      for (Index k = 0; k < n; ++k) {
        EXPECT_NEAR(s.limit_mask[k + 1], limit.each, 1e-14) << n;
        EXPECT_NEAR(s.tangent_masks[0][k + 1], u.edges[k], 1e-13) << n;
        EXPECT_NEAR(s.tangent_masks[1][k + 1], v.edges[k], 1e-13) << n;
      }
    }
}

TEST(LoopSpectrum, reaches_the_highest_valence) {
  for (const LoopWeights weights : kBoth) {
    const Spectrum s = loop_at(weights, kMaxSpectrumValence);
    EXPECT_NEAR(s.subdominant, 3.0 / 8 + std::cos(2 * std::numbers::pi / 128) / 4, 1e-14);
    const RingMask v = Loop{weights}.smooth_tangent_v(128);
    for (Index k = 0; k < 128; ++k) EXPECT_NEAR(s.tangent_masks[1][k + 1], v.edges[k], 1e-11);
  }
}

TEST(LoopSpectrum, curvature_is_bounded_at_valence_6) {
  const Spectrum s = loop_at(LoopWeights::loop, 6);
  EXPECT_NEAR(s.subdominant, 0.5, 1e-15);
  EXPECT_NEAR(s.subsubdominant, 0.25, 1e-15);
  EXPECT_NEAR(s.curvature_ratio, 1, 1e-14);
  EXPECT_NEAR(s.steps_per_digit, std::log2(10.0), 1e-14);
  EXPECT_GT(loop_at(LoopWeights::loop, 7).curvature_ratio, 1);
}

TEST(LoopSpectrum, labels_v_and_its_neighbours) {
  EXPECT_EQ(loop_at(LoopWeights::loop, 3).labels, (std::vector<std::string>{"v", "e0", "e1", "e2"}));
}

TEST(LoopBorderSpectrum, has_the_masks_that_the_scheme_returns) {
  for (Index n = 2; n <= 40; ++n) {
    const Spectrum s = border_at(n);
    const Index faces = n - 1;
    const VertexMask limit = Loop{}.crease_limit_mask(0, n - 1);
    const RingMask across = Loop{}.crease_tangent_across(faces);
    double inner = 0;
    for (Index k = 1; k < faces; ++k) inner += across.edges[k];
    if (n == 2) inner = sum_of(across.edges);
    EXPECT_NEAR(s.limit_mask[0], limit.self, 1e-14);
    EXPECT_NEAR(s.tangent_masks[1][0], across.self / inner, 1e-12) << n;
    for (Index k = 0; k < n; ++k) {
      const bool end = k == 0 || k == faces;
      EXPECT_NEAR(s.limit_mask[k + 1], end ? limit.crease : 0, 1e-14);
      EXPECT_NEAR(s.tangent_masks[0][k + 1], k == 0 ? 0.5 : end ? -0.5 : 0, 1e-15);
      EXPECT_NEAR(s.tangent_masks[1][k + 1], across.edges[k] / inner, 1e-12) << n;
    }
    EXPECT_LT(residual(s, s.tangent_masks[0], 0.5), 1e-15);
    const double value = n == 2 ? 0.25 : 3.0 / 8 + std::cos(std::numbers::pi / faces) / 4;
    EXPECT_LT(residual(s, s.tangent_masks[1], value), 1e-12);
  }
}

// --- Curves
// -------------------------------------------------------------------------------------------------

TEST(LaneRiesenfeldSpectrum, has_powers_of_one_half_and_the_last_of_them_twice) {
  for (Index p = 1; p <= kMaxSpectrumDegree; ++p) {
    const Spectrum s = bspline(p);
    ASSERT_EQ(s.eigenvalues.size(), p + 2);
    for (Index k = 0; k <= p + 1; ++k) {
      const double expected = std::ldexp(1.0, -static_cast<int>(std::min(k, p)));
      EXPECT_NEAR(s.eigenvalues[k], expected, 1e-10 * expected) << p << " " << k;
    }
    EXPECT_EQ(s.defect, 0u);
  }
}

// 2^p N(x) at the points' places by Cox's recursion in integers: degree p, knots at the (half) integers.
double cardinal(int p, double x) {
  if (p == 0) return x >= -0.5 && x < 0.5 ? 1 : 0;
  const double h = (p + 1) / 2.0;
  return ((h + x) * cardinal(p - 1, x + 0.5) + (h - x) * cardinal(p - 1, x - 0.5)) / p;
}

TEST(LaneRiesenfeldSpectrum, has_the_values_and_slopes_of_the_spline_itself_as_masks) {
  for (Index p = 1; p <= kMaxSpectrumDegree; ++p) {
    const Spectrum s = bspline(p);
    for (Index k = 0; k < p + 2; ++k) {
      const double place = k - (p + 1) / 2.0;  // of the point; its basis function is seen from the other side
      EXPECT_NEAR(s.limit_mask[k], cardinal(static_cast<int>(p), -place), 1e-14) << p;
      if (p == 1) continue;  // the polygon has a corner here
      const double slope =
          cardinal(static_cast<int>(p) - 1, -place + 0.5) - cardinal(static_cast<int>(p) - 1, -place - 0.5);
      EXPECT_NEAR(s.tangent_masks[0][k], slope, 1e-13) << p;
    }
  }
}

TEST(LaneRiesenfeldSpectrum, of_degree_3_is_the_cubic_of_the_books) {
  const Spectrum s = bspline(3);
  EXPECT_EQ(s.labels, (std::vector<std::string>{"c[-2]", "c[-1]", "c[0]", "c[1]", "c[2]"}));
  const double values[] = {1, 1.0 / 2, 1.0 / 4, 1.0 / 8, 1.0 / 8};
  const double limit[] = {0, 1.0 / 6, 4.0 / 6, 1.0 / 6, 0}, tangent[] = {0, -0.5, 0, 0.5, 0};
  for (int k = 0; k < 5; ++k) {
    EXPECT_NEAR(s.eigenvalues[k], values[k], 1e-15);
    EXPECT_NEAR(s.limit_mask[k], limit[k], 1e-15);
    EXPECT_NEAR(s.tangent_masks[0][k], tangent[k], 1e-15);
  }
}

TEST(LaneRiesenfeldSpectrum, of_even_degree_lies_around_the_middle_of_a_span) {
  const Spectrum s = bspline(2);
  EXPECT_EQ(s.labels, (std::vector<std::string>{"c[-1]", "c[0]", "c[1]", "c[2]"}));
  EXPECT_EQ(s.matrix,
            (std::vector<double>{0.25, 0.75, 0, 0, 0, 0.75, 0.25, 0, 0, 0.25, 0.75, 0, 0, 0, 0.75, 0.25}));
  EXPECT_NEAR(s.limit_mask[1], 0.5, 1e-15);
  EXPECT_NEAR(s.tangent_masks[0][2], 1, 1e-15);
}

TEST(LaneRiesenfeldSpectrum, of_degree_1_takes_the_tangent_through_both_neighbours) {
  const Spectrum s = bspline(1);
  EXPECT_NEAR(s.tangent_masks[0][0], -0.5, 1e-15);
  EXPECT_NEAR(s.tangent_masks[0][1], 0, 1e-15);
  EXPECT_EQ(s.subsubdominant, 0);
}

TEST(FourPointSpectrum, has_the_eigenvalues_of_the_closed_forms) {
  for (const double w : {0.0, 0.001, 0.02, 0.05, 0.06, 0.0624}) {
    const Spectrum s = four_point(w);
    std::vector<double> expected = {1, 0.5, 2 * w, 0.25 + std::sqrt(1.0 / 16 - w),
                                    0.25 - std::sqrt(1.0 / 16 - w)};
    std::sort(expected.rbegin(), expected.rend());
    for (int k = 0; k < 5; ++k) EXPECT_NEAR(s.eigenvalues[k], expected[k], 1e-13) << w;
    EXPECT_EQ(s.defect, 0u);
  }
}

TEST(FourPointSpectrum, interpolates_and_has_the_tangent_of_its_closed_form) {
  for (const double w : {0.0, 0.02, 0.05, 1.0 / 16}) {
    const Spectrum s = four_point(w);
    const double a = 1 / (2 * (1 - 4 * w));
    const double limit[] = {0, 0, 1, 0, 0}, tangent[] = {2 * w * a, -a, 0, a, -2 * w * a};
    for (int k = 0; k < 5; ++k) {
      EXPECT_NEAR(s.limit_mask[k], limit[k], 1e-15);
      EXPECT_NEAR(s.tangent_masks[0][k], tangent[k], 1e-14) << w;
    }
  }
}

TEST(FourPointSpectrum, of_one_sixteenth_has_a_jordan_block) {
  const Spectrum s = four_point(1.0 / 16);
  const double values[] = {1, 0.5, 0.25, 0.25, 0.125};
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(s.eigenvalues[k], values[k], 1e-14);
  EXPECT_EQ(s.defect, 1u);
}

// --- The door
// -----------------------------------------------------------------------------------------------

TEST(Spectrum, refuses_parameters_out_of_range_at_their_place) {
  const Budget budget;
  for (const Index n : {0u, 2u, 129u, 0xffffffffu}) {
    const auto refused = smooth_spectrum(Loop{}, n, budget);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::out_of_range);
    EXPECT_EQ(refused.error().where, (Path{"valence"}));
  }
  EXPECT_EQ(border_spectrum(Loop{}, 1, budget).error().code, ErrorCode::out_of_range);
  for (const Index p : {0u, 16u, 0xffffffffu})
    EXPECT_EQ(lane_riesenfeld_spectrum(p, budget).error().where, (Path{"degree"}));
  EXPECT_EQ(four_point_spectrum(NAN, budget).error().code, ErrorCode::not_finite);
  EXPECT_EQ(four_point_spectrum(-1e-9, budget).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(four_point_spectrum(0.0626, budget).error().code, ErrorCode::unsupported);
  EXPECT_EQ(spectrum({.name = "catmullclark"}, budget).error().code, ErrorCode::bad_enum);
}

TEST(Spectrum, of_every_scheme_of_the_list_exists_at_the_ends_of_its_parameters) {
  for (const SchemeInfo& scheme : list_of_schemes()) {
    EXPECT_TRUE(scheme.kind == "surface" || scheme.kind == "curve");
    EXPECT_EQ(value_of(spectrum({.name = scheme.name}, Budget{})).scheme, scheme.name);
    for (const SchemeParameter& parameter : scheme.parameters)
      for (const bool most : {false, true}) {
        SchemeChoice choice{.name = scheme.name};
        const double value = most ? parameter.most : parameter.least;
        if (parameter.name == "valence") choice.valence = static_cast<Index>(value);
        if (parameter.name == "degree") choice.degree = static_cast<Index>(value);
        if (parameter.name == "tension") choice.tension = value;
        if (parameter.name == "border") choice.border = most;
        if (parameter.type == "word") set_word(choice, parameter.name, most ? parameter.words.size() - 1 : 0);
        EXPECT_TRUE(spectrum(choice, Budget{}).ok()) << scheme.name << " " << parameter.name;
      }
  }
}

TEST(Spectrum, by_name_is_that_of_the_function) {
  AllSchemes schemes;
  std::get<Loop>(schemes).weights = LoopWeights::warren;
  const auto named = value_of(spectrum({.name = "loop", .schemes = schemes, .valence = 5}, Budget{}));
  EXPECT_EQ(named.matrix, loop_at(LoopWeights::warren, 5).matrix);
  EXPECT_NE(named.matrix, loop_at(LoopWeights::loop, 5).matrix);
  EXPECT_EQ(value_of(spectrum({.name = "loop", .valence = 5, .border = true}, Budget{})).matrix,
            border_at(5).matrix);
}

TEST(Spectrum, stops_when_nobody_waits_any_more) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_EQ(smooth_spectrum(Loop{}, 6, budget).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace subdivd::testing

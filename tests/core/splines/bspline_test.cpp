#include "core/splines/bspline.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "tests/core/splines/fraction.h"
#include "tests/core/splines/sample_splines.h"

namespace subdivd {
namespace {

// The definition, with all its divisions by nothing taken as 0: the function of index i, everywhere.
//   [Cox72; deBoor72]
Fraction naive_basis(const std::vector<Fraction>& u, Index p, Count i, Fraction t) {
  if (p == 0) return !(t < u[i]) && t < u[i + 1] ? 1 : 0;
  Fraction sum = 0;
  if (u[i] < u[i + p]) sum = sum + (t - u[i]) / (u[i + p] - u[i]) * naive_basis(u, p - 1, i, t);
  if (u[i + 1] < u[i + p + 1])
    sum = sum + (u[i + p + 1] - t) / (u[i + p + 1] - u[i + 1]) * naive_basis(u, p - 1, i + 1, t);
  return sum;
}
// N' = p (N_{i,p-1} / (u_{i+p} - u_i) - N_{i+1,p-1} / (u_{i+p+1} - u_{i+1}))
Fraction naive_derivative(const std::vector<Fraction>& u, Index p, Count i, Fraction t, Index order) {
  if (order == 0) return naive_basis(u, p, i, t);
  if (p == 0) return 0;
  Fraction sum = 0;
  if (u[i] < u[i + p]) sum = sum + naive_derivative(u, p - 1, i, t, order - 1) / (u[i + p] - u[i]);
  if (u[i + 1] < u[i + p + 1])
    sum = sum - naive_derivative(u, p - 1, i + 1, t, order - 1) / (u[i + p + 1] - u[i + 1]);
  return sum * Fraction(p);
}

const std::vector<std::vector<int>>& knot_vectors() {
  static const std::vector<std::vector<int>> all{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11},
                                                 {0, 0, 0, 0, 1, 3, 4, 8, 9, 9, 9, 9},
                                                 {-3, -1, 0, 0, 2, 2, 3, 7, 8, 8, 10, 12}};
  return all;
}

// A spline that only lends its knots.
Spline with_knots(const std::vector<int>& knots, Index degree) {
  Spline spline{degree, 1, false, false, {knots.begin(), knots.end()}, {}};
  spline.points.assign(knots.size() - degree - 1, 0.0);
  return spline;
}

TEST(Basis, is_its_definition_in_exact_numbers) {
  for (const auto& knots : knot_vectors())
    for (const Index degree : {1u, 2u, 3u, 4u}) {
      const Spline spline = with_knots(knots, degree);
      const std::vector<Fraction> exact(knots.begin(), knots.end());
      const int last = 4 * (knots[spline.point_count()] - knots[degree]);
      for (int step = 0; step < last; ++step) {
        const Fraction t = Fraction(knots[degree]) + Fraction(step, 4);
        const Count span = find_span(spline, static_cast<double>(t));
        std::vector<double> rows(4 * (degree + 1)), values(degree + 1);
        basis_functions(spline.knots, degree, span, static_cast<double>(t), values);
        basis_derivatives(spline.knots, degree, span, static_cast<double>(t), 3, rows);
        for (Index j = 0; j <= degree; ++j) {
          const Count i = span - degree + j;
          EXPECT_NEAR(values[j], static_cast<double>(naive_basis(exact, degree, i, t)), 1e-15);
          for (Index order = 0; order <= 3; ++order)
            EXPECT_NEAR(rows[order * (degree + 1) + j],
                        static_cast<double>(naive_derivative(exact, degree, i, t, order)), 2e-13)
                << degree << ' ' << order << ' ' << static_cast<double>(t);
        }
      }
    }
}

TEST(Basis, sums_to_one_and_its_derivatives_to_nothing) {
  for (const auto& [name, spline] : samples::all_splines())
    for (const double t : samples::parameters(spline, 50)) {
      const Count span = find_span(spline, t);
      const Index functions = spline.degree + 1;
      std::vector<double> rows(3 * functions);
      basis_derivatives(spline.knots, spline.degree, span, t, 2, rows);
      double largest = 1;
      for (const double x : rows) largest = std::max(largest, std::abs(x));
      for (Index order = 0; order < 3; ++order)
        EXPECT_NEAR(
            std::accumulate(rows.begin() + order * functions, rows.begin() + (order + 1) * functions, 0.0),
            order == 0 ? 1 : 0, 1e-14 * largest)
            << name << ' ' << t;
      for (Index j = 0; j < functions; ++j) EXPECT_GE(rows[j], 0) << name << ' ' << t;
    }
}

TEST(Basis, exists_at_the_very_last_parameter) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const Count span = find_span(spline, spline.end());
    EXPECT_LT(spline.knots[span], spline.knots[span + 1]) << name;
    EXPECT_LT(span, spline.point_count()) << name;
    const std::vector<double> point = samples::point_at(spline, spline.end());
    EXPECT_LT(
        samples::distance(point, samples::point_at(spline, std::nextafter(spline.end(), spline.begin()))),
        1e-12)
        << name;
  }
}

TEST(Spline, ends_at_its_last_point_where_it_is_clamped) {
  const Spline spline = samples::random_spline(3, 4, 3, false, true, 2);
  const auto last = spline.point(spline.point_count() - 1);
  EXPECT_EQ(samples::point_at(spline, spline.end()), std::vector<double>(last.begin(), last.end()));
}

// Their differences on both sides of a parameter converge to the derivative one order up.
TEST(Derivatives, are_what_differences_converge_to) {
  for (const auto& [name, spline] : samples::all_splines()) {
    if (spline.degree < 4) continue;
    const double t = (spline.knots[spline.degree + 1] + spline.knots[spline.degree]) / 2;
    constexpr double kStep = 1e-4;
    const Index dimension = spline.dimension();
    std::vector<double> here(4 * dimension), before = here, behind = here;
    ASSERT_TRUE(derivatives(spline, t, 3, here));
    ASSERT_TRUE(derivatives(spline, t - kStep, 3, before));
    ASSERT_TRUE(derivatives(spline, t + kStep, 3, behind));
    for (Index k = dimension; k < 4 * dimension; ++k) {
      const double difference = (behind[k - dimension] - before[k - dimension]) / (2 * kStep);
      EXPECT_NEAR(here[k], difference, 2e-4 * (1 + std::abs(here[k]))) << name << ' ' << k;
    }
  }
}

TEST(Derivatives, of_a_circle_stand_on_one_another) {
  const Spline circle = samples::circle();
  for (const double t : samples::parameters(circle)) {
    std::vector<double> rows(6);
    ASSERT_TRUE(derivatives(circle, t, 2, rows));
    EXPECT_NEAR(std::hypot(rows[0], rows[1]), 1, 1e-14) << t;
    EXPECT_NEAR(rows[0] * rows[2] + rows[1] * rows[3], 0, 1e-14) << t;
    // (|C|^2)'' = 0: C C'' = -|C'|^2
    EXPECT_NEAR(rows[0] * rows[4] + rows[1] * rows[5], -(rows[2] * rows[2] + rows[3] * rows[3]), 1e-13) << t;
  }
}

TEST(Derivatives, above_the_degree_vanish_without_weights) {
  const Spline spline = samples::random_spline(5, 2, 3, false, true, 1);
  std::vector<double> rows(5 * 3);
  ASSERT_TRUE(derivatives(spline, spline.begin() + 0.3, 4, rows));
  for (Index k = 9; k < 15; ++k) EXPECT_EQ(rows[k], 0);
}

TEST(Evaluate, refuses_parameters_outside_the_domain_and_wraps_periodic_ones) {
  Spline spline = samples::circle();
  std::vector<double> point(2);
  for (const double t : {-0.001, 4.001, 1e300})
    EXPECT_EQ(evaluate(spline, t, point).error().code, ErrorCode::out_of_range) << t;
  for (const double t : {std::nan(""), static_cast<double>(INFINITY)})
    EXPECT_EQ(evaluate(spline, t, point).error().code, ErrorCode::not_finite);
  spline.periodic = true;
  for (const double t : {-3.25, 4.75, 8.75, -400003.25}) {
    ASSERT_TRUE(evaluate(spline, t, point));
    EXPECT_LT(samples::distance(point, samples::point_at(spline, 0.75)), 1e-9) << t;
  }
  EXPECT_EQ(evaluate(spline, std::nan(""), point).error().code, ErrorCode::not_finite);
}

TEST(Evaluate, finds_that_a_number_outgrows_its_type) {
  Spline spline = samples::random_spline(2, 3, 2, false, true, 1);
  for (double& x : spline.points) x = x > 0 ? 1.7e308 : -1.7e308;
  std::vector<double> rows(4);
  EXPECT_EQ(derivatives(spline, spline.begin(), 1, rows).error().code, ErrorCode::out_of_range);
}

TEST(Blossom, is_the_curve_on_its_diagonal_and_the_control_points_on_the_knots) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const Index p = spline.degree;
    std::vector<double> weights(p + 1), basis(p + 1);
    for (const double t : samples::parameters(spline, 20)) {
      const Count span = find_span(spline, t);
      blossom_weights(spline.knots, p, span, std::vector<double>(p, t), weights);
      basis_functions(spline.knots, p, span, t, basis);
      for (Index j = 0; j <= p; ++j) EXPECT_NEAR(weights[j], basis[j], 1e-14) << name << ' ' << t;
      // The control points that the span's piece has. Arguments away from the span make shares as large as
      // they are far, and rounding grows with their product.
      for (Index j = 0; j <= p; ++j) {
        const Count i = span - p + j;
        blossom_weights(spline.knots, p, span, std::span(spline.knots).subspan(i + 1, p), weights);
        double growth = 1;
        for (const double knot : std::span(spline.knots).subspan(i + 1, p))
          growth *= 1 + 2 * std::abs(knot - t) / (spline.knots[span + 1] - spline.knots[span]);
        for (Index k = 0; k <= p; ++k)
          EXPECT_NEAR(weights[k], k == j ? 1 : 0, 1e-15 * growth) << name << ' ' << t;
      }
    }
  }
}

TEST(SplineEvaluator, gives_what_evaluate_gives) {
  for (const auto& [name, spline] : samples::all_splines()) {
    const SplineEvaluator evaluator(spline);
    const std::vector<double> ts = samples::parameters(spline);
    std::vector<double> points(ts.size() * spline.dimension());
    evaluator.evaluate(ts, points);
    for (std::size_t k = 0; k < ts.size(); ++k) {
      const std::vector<double> expected = samples::point_at(spline, ts[k]);
      for (Index x = 0; x < spline.dimension(); ++x)
        EXPECT_NEAR(points[k * spline.dimension() + x], expected[x], 1e-14) << name << ' ' << ts[k];
    }
  }
}

// Knots that crowd together at one end of the domain.
TEST(SplineEvaluator, finds_spans_of_every_size) {
  Spline spline{3, 3, false, false, std::vector<double>(4, 0.0), {}};
  for (int k = 200; k > 0; --k) spline.knots.push_back(std::pow(0.9, k));
  spline.knots.insert(spline.knots.end(), 4, 1.0);
  samples::Random random(200);
  for (Count k = 0; k < 3 * (spline.knots.size() - 4); ++k) spline.points.push_back(random.centred());
  ASSERT_TRUE(spline.check());
  const SplineEvaluator evaluator(spline);
  std::vector<double> ts = spline.knots, point(3);
  for (int k = 0; k < 300; ++k) ts.push_back(std::pow(0.93, k));
  for (const double t : ts)
    for (const double near : {t, std::nextafter(t, 0.0), std::min(1.0, std::nextafter(t, 2.0))}) {
      evaluator.evaluate(std::vector<double>{near}, point);
      EXPECT_LT(samples::distance(point, samples::point_at(spline, near)), 1e-14) << near;
    }
}

TEST(Spline, check_names_the_first_fault) {
  const Spline good = samples::circle();
  ASSERT_TRUE(good.check());
  const auto fault = [&](auto change) {
    Spline bad = good;
    change(bad);
    const auto checked = bad.check();
    EXPECT_FALSE(checked.ok());
    return checked.ok() ? Error{} : checked.error();
  };
  const auto at = [](const char* name, std::uint64_t i) { return Path{name, i}; };
  EXPECT_EQ(fault([](Spline& s) { s.degree = 0; }).where, Path{"degree"});
  EXPECT_EQ(fault([](Spline& s) { s.degree = 64; }).where, Path{"degree"});
  EXPECT_EQ(fault([](Spline& s) { s.width = 0; }).where, Path{"points"});
  EXPECT_EQ(fault([](Spline& s) { s.width = 1; }).where, Path{"points"});  // a weight and no coordinate
  EXPECT_EQ(fault([](Spline& s) { s.points.pop_back(); }).code, ErrorCode::wrong_length);
  EXPECT_EQ(fault([](Spline& s) { s.points.resize(6); }).code, ErrorCode::too_few_points);
  EXPECT_EQ(fault([](Spline& s) { s.points[4] = std::nan(""); }).where, at("points", 4));
  EXPECT_EQ(fault([](Spline& s) { s.points[5] = 0; }).where, at("pointWeights", 1));
  EXPECT_EQ(fault([](Spline& s) { s.points[8] = -1; }).where, at("pointWeights", 2));
  EXPECT_EQ(fault([](Spline& s) { s.knots.pop_back(); }).code, ErrorCode::wrong_length);
  EXPECT_EQ(fault([](Spline& s) { s.knots[5] = 0.5; }).where, at("knots", 5));
  EXPECT_EQ(fault([](Spline& s) { s.knots[5] = INFINITY; }).code, ErrorCode::not_finite);
  EXPECT_EQ(fault([](Spline& s) { s.knots[5] = 1; }).where, at("knots", 5));  // 1 stands three times
  EXPECT_EQ(fault([](Spline& s) { s.knots.assign(12, 1.0); }).where, Path{"knots"});
  EXPECT_EQ(fault([](Spline& s) { s.knots.back() = 1.7e308, s.knots[0] = -1.7e308; }).where, Path{"knots"});
}

}  // namespace
}  // namespace subdivd

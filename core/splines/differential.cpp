#include "core/splines/differential.h"

#include <algorithm>
#include <cmath>

#include "core/base/all_finite.h"
#include "core/base/precision.h"
#include "core/splines/bounds.h"
#include "core/splines/bspline.h"

namespace subdivd {
namespace {

// A row as value * 2^exponent with every number in [-1, 1], so that its squares are safe. `noise` is in the
// same unit.
struct Vector {
  std::vector<double> value;
  int exponent = 0;
  double noise = 0;
  double length = 0;
};

double length_of(std::span<const double> v) {
  double square = 0;
  for (const double x : v) square += x * x;
  return std::sqrt(square);
}

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (Count k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

std::vector<double> cross(std::span<const double> a, std::span<const double> b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Row d; zero, with length 0, where it is not longer than its noise.
Vector vector_of(std::span<const double> rows, Index dimension, std::span<const double> noise, Index d) {
  Vector v;
  const std::span<const double> row = rows.subspan(Count{d} * dimension, dimension);
  double largest = 0;
  for (const double x : row) largest = std::max(largest, std::abs(x));
  v.value.assign(row.begin(), row.end());
  if (largest > 0) v.exponent = std::ilogb(largest) + 1;
  for (double& x : v.value) x = std::ldexp(x, -v.exponent);
  v.length = length_of(v.value);
  v.noise = 4 * kRoundoff * v.length;
  if (d < noise.size()) v.noise = std::max(v.noise, std::ldexp(noise[d], -v.exponent));
  if (v.length <= v.noise) v.length = 0;
  return v;
}

std::optional<double> scaled(double value, int exponent) {
  const double result = std::ldexp(value, exponent);
  if (!std::isfinite(result)) return std::nullopt;
  return result;
}

std::vector<double> divided(std::vector<double> v, double divisor) {
  for (double& x : v) x /= divisor;
  return v;
}

// What is left of `b` across the direction of `a`: b - (b.t) t; length 0 where that is no more than what the
// noise of either could have made of nothing (a's noise turns t by noise / length).
Vector across(const Vector& a, const Vector& b) {
  Vector rest = b;
  const std::vector<double> t = divided(a.value, a.length);
  // Twice: what the first pass leaves along t by rounding, the second removes.
  for (int pass = 0; pass < 2; ++pass) {
    const double along = dot(rest.value, t);
    for (Count k = 0; k < t.size(); ++k) rest.value[k] -= along * t[k];
  }
  rest.length = length_of(rest.value);
  rest.noise = b.noise + 2 * length_of(b.value) * a.noise / a.length;
  if (rest.length <= rest.noise) rest.length = 0;
  return rest;
}

// |error of the d-th row| of sum_i N_i^(d) x_i for one scalar row of control values per coordinate: each of
// the p + 1 products has been through about 4 p operations of the basis and 2 of the sum.
std::vector<double> noise_of_sums(const Spline& spline, double t, Index order, Index first, Index count) {
  const Index p = spline.degree;
  const Count span = find_span(spline, t), functions = Count{p} + 1;
  std::vector<double> basis((Count{order} + 1) * functions), noise;
  basis_derivatives(spline.knots, p, span, t, order, basis);
  for (Index d = 0; d <= order; ++d) {
    double sum = 0;
    for (Index j = 0; j <= p; ++j) {
      double largest = 0;
      for (const double x : spline.point(span - p + j).subspan(first, count))
        largest = std::max(largest, std::abs(x));
      sum += std::abs(basis[d * functions + j]) * largest;
    }
    noise.push_back(sum * (6 * p + 4) * kRoundoff * std::sqrt(count));
  }
  return noise;
}

// Row lengths that go into the errors of the quotient rule.
double row_length(std::span<const double> rows, Index dimension, Index d) {
  double largest = 0;
  for (const double x : rows.subspan(Count{d} * dimension, dimension))
    largest = std::max(largest, std::abs(x));
  return largest * std::sqrt(dimension);
}

// C^(d) = (A^(d) - sum_i binom(d, i) w^(i) C^(d-i)) / w: every factor brings its own error along.
void divide_noise(const Spline& spline, double t, std::span<const double> rows, std::span<double> noise) {
  const Index dimension = spline.dimension(), order = static_cast<Index>(noise.size()) - 1;
  const std::vector<double> weight_noise = noise_of_sums(spline, t, order, dimension, 1);
  // The weight's own derivatives, by the same sums.
  const Spline near = window(spline, find_span(spline, t));
  const Spline weight{spline.degree, 1, false, false, near.knots, weights(near)};
  std::vector<double> w(Count{order} + 1);
  if (!derivatives(weight, t, order, w).ok()) w.assign(w.size(), HUGE_VAL);
  for (Index d = 0; d <= order; ++d) {
    double sum = noise[d] + weight_noise[0] * row_length(rows, dimension, d), binomial = 1;
    for (Index i = 1; i <= d; ++i) {
      binomial = binomial * (d - i + 1) / i;
      const double row = row_length(rows, dimension, d - i);
      sum += binomial * (std::abs(w[i]) * (noise[d - i] + 4 * kRoundoff * row) + weight_noise[i] * row);
    }
    noise[d] = sum / w[0];
  }
}

}  // namespace

Result<std::vector<double>> derivative_noise(const Spline& spline, double t, Index order) {
  std::vector<double> rows((Count{order} + 1) * spline.dimension());
  if (auto done = derivatives(spline, t, order, rows); !done) return done.error();
  t = *check_parameter(spline, t);
  std::vector<double> noise = noise_of_sums(spline, t, order, 0, spline.dimension());
  if (spline.rational) divide_noise(spline, t, rows, noise);
  if (!all_finite(std::span<const double>(noise))) return does_not_fit();
  return noise;
}

std::optional<double> speed(std::span<const double> rows, Index dimension) {
  const Vector first = vector_of(rows, dimension, {}, 1);
  return scaled(first.length, first.exponent);
}

std::optional<std::vector<double>> unit_tangent(std::span<const double> rows, Index dimension,
                                                std::span<const double> noise) {
  const Vector first = vector_of(rows, dimension, noise, 1);
  if (first.length == 0) return std::nullopt;
  return divided(first.value, first.length);
}

std::optional<double> curvature(std::span<const double> rows, Index dimension,
                                std::span<const double> noise) {
  const Vector first = vector_of(rows, dimension, noise, 1);
  if (first.length == 0) return std::nullopt;
  const Vector second = vector_of(rows, dimension, noise, 2);
  if (second.length == 0) return 0;
  const Vector bend = across(first, second);
  double value = bend.length / (first.length * first.length);
  if (dimension == 2 && first.value[0] * bend.value[1] < first.value[1] * bend.value[0]) value = -value;
  return scaled(value, second.exponent - 2 * first.exponent);
}

std::optional<double> torsion(std::span<const double> rows, std::span<const double> noise) {
  const Vector first = vector_of(rows, 3, noise, 1);
  const Vector second = vector_of(rows, 3, noise, 2);
  if (first.length == 0 || second.length == 0) return std::nullopt;
  const Vector bend = across(first, second);
  if (bend.length == 0) return std::nullopt;
  const Vector third = vector_of(rows, 3, noise, 3);
  if (third.length == 0) return 0;
  // C' x C'' = C' x bend, the two being at right angles.
  const std::vector<double> normal = cross(first.value, bend.value);
  const double length = first.length * bend.length;
  return scaled(dot(normal, third.value) / length / length,
                third.exponent - first.exponent - second.exponent);
}

std::optional<FrenetFrame> frenet_frame(std::span<const double> rows, Index dimension,
                                        std::span<const double> noise) {
  if (dimension != 2 && dimension != 3) return std::nullopt;
  const Vector first = vector_of(rows, dimension, noise, 1);
  if (first.length == 0) return std::nullopt;
  FrenetFrame frame;
  frame.tangent = divided(first.value, first.length);
  if (dimension == 2) {
    frame.normal = {-frame.tangent[1], frame.tangent[0]};
    return frame;
  }
  const Vector second = vector_of(rows, dimension, noise, 2);
  if (second.length == 0) return std::nullopt;
  const Vector bend = across(first, second);
  if (bend.length == 0) return std::nullopt;
  frame.normal = divided(bend.value, bend.length);
  frame.binormal = cross(frame.tangent, frame.normal);
  return frame;
}

}  // namespace subdivd

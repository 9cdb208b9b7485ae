#include "core/analysis/eigen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace subdivd::testing {
namespace {

using Matrix = std::vector<double>;  // row major

EigenSystem solved(const Matrix& matrix, Index n) {
  auto system = eigen_system(matrix, n, Budget{});
  EXPECT_TRUE(system.ok()) << (system.ok() ? "" : system.error().message);
  return system.ok() ? std::move(system).value() : EigenSystem{};
}

Matrix transposed(const Matrix& a, Index n) {
  Matrix t(a.size());
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) t[j * n + i] = a[i * n + j];
  return t;
}

Matrix product(const Matrix& a, const Matrix& b, Index n) {
  Matrix c(a.size());
  for (Index i = 0; i < n; ++i)
    for (Index k = 0; k < n; ++k)
      for (Index j = 0; j < n; ++j) c[i * n + j] += a[i * n + k] * b[k * n + j];
  return c;
}

Matrix diagonal(const std::vector<double>& values) {
  const std::size_t n = values.size();
  Matrix m(n * n);
  for (std::size_t i = 0; i < n; ++i) m[i * n + i] = values[i];
  return m;
}

// X J X^-1 with X a product of integer triangles, so that X^-1 is exact: eigenvalues are known.
Matrix similar(const Matrix& j, Index n, unsigned seed) {
  std::mt19937 random(seed);
  Matrix x = diagonal(std::vector<double>(n, 1)), inverse = x;
  for (int step = 0; step < 2 * static_cast<int>(n); ++step) {
    const Index a = static_cast<Index>(random() % n), b = static_cast<Index>(random() % n);
    if (a == b) continue;
    for (Index k = 0; k < n; ++k) x[k * n + b] += x[k * n + a];              // X E, E = I + e_a e_b^T
    for (Index k = 0; k < n; ++k) inverse[a * n + k] -= inverse[b * n + k];  // E^-1 X^-1
  }
  return product(product(x, j, n), inverse, n);
}

double length(const double* x, Index n) {
  double sum = 0;
  for (Index i = 0; i < n; ++i) sum += x[i] * x[i];
  return std::sqrt(sum);
}

// Longest |A x - value x| / |x| of all vectors, right and left, over the largest entry of A.
double worst_residual(const Matrix& a, const EigenSystem& system) {
  const Index n = system.size;
  const Matrix t = transposed(a, n);
  double worst = 0, size = 1e-300;
  for (const double x : a) size = std::max(size, std::abs(x));
  for (const EigenSpace& space : system.spaces)
    for (Index d = 0; d < space.dimension; ++d)
      for (const bool left : {false, true}) {
        const double* x = &(left ? space.left : space.right)[d * n];
        const Matrix& m = left ? t : a;
        std::vector<double> r(n);
        for (Index i = 0; i < n; ++i) {
          r[i] = -space.value / size * x[i];
          for (Index j = 0; j < n; ++j) r[i] += m[i * n + j] / size * x[j];
        }
        worst = std::max(worst, length(r.data(), n) / length(x, n));
      }
  return worst;
}

// Farthest that products of left and right vectors, of all spaces together, are from 1 and 0.
double worst_product(const EigenSystem& system) {
  const Index n = system.size;
  double worst = 0;
  for (std::size_t s = 0; s < system.spaces.size(); ++s)
    for (std::size_t t = 0; t < system.spaces.size(); ++t)
      for (Index i = 0; i < system.spaces[s].dimension; ++i)
        for (Index j = 0; j < system.spaces[t].dimension; ++j) {
          double sum = s == t && i == j ? -1 : 0;
          for (Index k = 0; k < n; ++k)
            sum += system.spaces[s].left[i * n + k] * system.spaces[t].right[j * n + k];
          worst = std::max(worst, std::abs(sum));
        }
  return worst;
}

Index total(const EigenSystem& system) {
  Index sum = 0;
  for (const EigenSpace& space : system.spaces) sum += space.multiplicity;
  return sum;
}

TEST(Eigen, finds_the_values_a_matrix_was_made_of_and_vectors_without_residual) {
  for (unsigned seed = 1; seed < 20; ++seed) {
    const std::vector<double> values = {7, -5, 3, 2, 1, 0.5, -0.25, 0};
    const Matrix a = similar(diagonal(values), 8, seed);
    const EigenSystem system = solved(a, 8);
    ASSERT_EQ(system.spaces.size(), 8u) << seed;
    double condition = 1;  // product of lengths of left and right: what rounding is multiplied by
    for (const EigenSpace& space : system.spaces)
      condition = std::max(condition, length(space.left.data(), 8));
    for (std::size_t k = 0; k < 8; ++k)
      EXPECT_NEAR(system.spaces[k].value, values[k], 1e-14 * condition) << seed;
    EXPECT_LT(worst_residual(a, system), 1e-13) << seed;
    EXPECT_LT(worst_product(system), 1e-13 * condition) << seed;
  }
}

TEST(Eigen, repeated_values_have_as_many_independent_vectors) {
  for (unsigned seed = 1; seed < 20; ++seed) {
    const Matrix a = similar(diagonal({2, 2, 2, 1, 1, -0.75, 0, 0}), 8, seed);
    const EigenSystem system = solved(a, 8);
    ASSERT_EQ(system.spaces.size(), 4u) << seed;
    const Index expected[] = {3, 2, 1, 2};
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(system.spaces[k].multiplicity, expected[k]) << seed;
      EXPECT_EQ(system.spaces[k].dimension, expected[k]) << seed;
      EXPECT_EQ(system.spaces[k].right.size(), expected[k] * 8u);
    }
    EXPECT_LT(worst_residual(a, system), 1e-13) << seed;
    EXPECT_LT(worst_product(system), 1e-11)
        << seed;  // dual vectors exist only where both sides are independent
  }
}

TEST(Eigen, second_differences_have_their_cosines_and_sines) {
  const Index n = 60;
  Matrix a(n * n);
  for (Index i = 0; i < n; ++i) {
    a[i * n + i] = 2;
    if (i > 0) a[i * n + i - 1] = a[(i - 1) * n + i] = -1;
  }
  const EigenSystem system = solved(a, n);
  ASSERT_EQ(system.spaces.size(), n);
  for (Index k = 0; k < n; ++k) {
    const double angle = std::numbers::pi * (n - k) / (n + 1);
    EXPECT_NEAR(system.spaces[k].value, 2 - 2 * std::cos(angle), 1e-14);
    const double unit = system.spaces[k].right[0] / std::sin(angle);
    for (Index i = 0; i < n; ++i)
      EXPECT_NEAR(system.spaces[k].right[i], unit * std::sin((i + 1) * angle), 1e-12);
  }
}

TEST(Eigen, a_cyclic_matrix_has_pairs_of_equal_values) {
  const Index n = 128;
  Matrix a(n * n);
  for (Index i = 0; i < n; ++i) {
    a[i * n + i] = 3.0 / 8;
    a[i * n + (i + 1) % n] = a[i * n + (i + n - 1) % n] = 1.0 / 8;
  }
  const EigenSystem system = solved(a, n);
  ASSERT_EQ(system.spaces.size(), n / 2 + 1);
  for (Index k = 0; k <= n / 2; ++k) {
    EXPECT_NEAR(system.spaces[k].value, 3.0 / 8 + std::cos(2 * std::numbers::pi * k / n) / 4, 1e-14);
    EXPECT_EQ(system.spaces[k].dimension, k == 0 || k == n / 2 ? 1u : 2u);
  }
  EXPECT_LT(worst_residual(a, system), 1e-12);
  EXPECT_LT(worst_product(system), 1e-11);
}

TEST(Eigen, tells_apart_values_that_differ_by_a_billionth) {
  const EigenSystem system = solved(diagonal({1, 1 + 1e-9, 1 + 3e-9, 1 + 4e-9}), 4);
  ASSERT_EQ(system.spaces.size(), 4u);
  for (const EigenSpace& space : system.spaces) EXPECT_EQ(space.multiplicity, 1u);
  EXPECT_EQ(system.spaces[0].value, 1 + 4e-9);
}

// Written out by products instead of differences, Francis' first column is nothing but rounding errors here
// and the steps never end.
TEST(Eigen, steps_converge_where_many_values_nearly_coincide) {
  const Index n = 40;
  std::vector<double> values, v(n);
  for (Index k = 0; k < n; ++k) values.push_back(k < 30 ? 37 + 1e-7 * std::sin(k) : 0.5 * k);
  for (Index k = 0; k < n; ++k) v[k] = std::cos(3.0 * k * k);
  Matrix q = diagonal(std::vector<double>(n, 1));
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      q[i * n + j] -= 2 * v[i] * v[j] / (length(v.data(), n) * length(v.data(), n));
  const Matrix a = product(product(q, diagonal(values), n), q, n);
  const EigenSystem system = solved(a, n);
  EXPECT_EQ(total(system), n);
  EXPECT_LT(worst_residual(a, system), 1e-12);
}

TEST(Eigen, a_jordan_block_of_two_rows_has_one_vector) {
  for (unsigned seed = 1; seed < 10; ++seed) {
    const Matrix a = similar({3, 0, 0, 0, 0,  //
                              0, 1, 1, 0, 0,  //
                              0, 0, 1, 0, 0,  //
                              0, 0, 0, 0, 0,  //
                              0, 0, 0, 0, -2},
                             5, seed);
    const EigenSystem system = solved(a, 5);
    ASSERT_EQ(system.spaces.size(), 4u) << seed;
    EXPECT_NEAR(system.spaces[2].value, 1, 1e-12);
    EXPECT_EQ(system.spaces[2].multiplicity, 2u);
    EXPECT_EQ(system.spaces[2].dimension, 1u);
    EXPECT_EQ(system.spaces[0].dimension, 1u);
    EXPECT_LT(worst_residual(a, system), 1e-12) << seed;
  }
}

TEST(Eigen, a_jordan_block_beside_vectors_of_the_same_value_hides_none_of_them) {
  for (unsigned seed = 1; seed < 10; ++seed) {
    const Matrix a = similar({2, 1, 0, 0, 0,  //
                              0, 2, 0, 0, 0,  //
                              0, 0, 2, 0, 0,  //
                              0, 0, 0, 2, 0,  //
                              0, 0, 0, 0, 1},
                             5, seed);
    const EigenSystem system = solved(a, 5);
    ASSERT_EQ(system.spaces.size(), 2u) << seed;
    EXPECT_EQ(system.spaces[0].multiplicity, 4u);
    EXPECT_EQ(system.spaces[0].dimension, 3u);
    EXPECT_LT(worst_residual(a, system), 1e-12) << seed;
  }
}

// The values are known to 1e-10 only, and vectors of one value are no vectors of another one.
TEST(Eigen, vectors_fit_to_their_values_close_to_a_jordan_block) {
  for (const double distance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    const Matrix a = similar({1, 1, 0, 0,                    //
                              distance * distance, 1, 0, 0,  //
                              0, 0, 2, 0,                    //
                              0, 0, 0, 0.5},
                             4, 3);
    const EigenSystem system = solved(a, 4);
    ASSERT_EQ(system.spaces.size(), 4u) << distance;
    EXPECT_LT(worst_residual(a, system), 1e-14) << distance;
    EXPECT_NEAR(system.spaces[1].value - system.spaces[2].value, 2 * distance, 1e-3 * distance);
  }
}

TEST(Eigen, refuses_longer_jordan_blocks) {
  const auto refused = eigen_system(Matrix{1, 1, 0, 0, 1, 1, 0, 0, 1}, 3, Budget{});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
}

TEST(Eigen, refuses_complex_values_and_names_one) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  const auto refused = eigen_system(Matrix{c, -s, 0, s, c, 0, 0, 0, 0.5}, 3, Budget{});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
  EXPECT_NE(refused.error().message.find("0.955336 + 0.295520 i"), std::string::npos)
      << refused.error().message;
  // Half of the four are real and equal to the mean of all: no reason to take the others for rounding errors.
  const Matrix mixed{1, -0.5, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_EQ(eigen_system(mixed, 4, Budget{}).error().code, ErrorCode::unsupported);
  Matrix shift(25);  // fifth roots of unity
  for (Index i = 0; i < 5; ++i) shift[i * 5 + (i + 1) % 5] = 1;
  EXPECT_EQ(eigen_system(shift, 5, Budget{}).error().code, ErrorCode::unsupported);
}

TEST(Eigen, transposing_exchanges_left_and_right) {
  const Matrix a = similar(diagonal({4, 3, 1, -0.5}), 4, 5);
  const EigenSystem one = solved(a, 4), other = solved(transposed(a, 4), 4);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(one.spaces[k].value, other.spaces[k].value, 1e-13);
    const double* right = one.spaces[k].right.data();
    const auto top =
        std::max_element(right, right + 4, [](double x, double y) { return std::abs(x) < std::abs(y); });
    const double factor = *top / other.spaces[k].left[static_cast<std::size_t>(top - right)];
    for (Index i = 0; i < 4; ++i)
      EXPECT_NEAR(one.spaces[k].right[i], factor * other.spaces[k].left[i], 1e-13);
  }
}

TEST(Eigen, scale_does_not_matter) {
  const Matrix a = similar(diagonal({4, 3, 3, 1, -0.5}), 5, 3);
  const EigenSystem one = solved(a, 5);
  for (const double scale : {0x1p-500, 0x1p500, 0x1p1010}) {
    Matrix scaled = a;
    for (double& x : scaled) x *= scale;
    const EigenSystem other = solved(scaled, 5);
    ASSERT_EQ(other.spaces.size(), one.spaces.size());
    for (std::size_t k = 0; k < one.spaces.size(); ++k) {
      EXPECT_EQ(other.spaces[k].value, one.spaces[k].value * scale);
      EXPECT_EQ(other.spaces[k].right, one.spaces[k].right);
    }
  }
}

// Without balancing the small values would drown: entries reach from 2^-80 to 2^80.
TEST(Eigen, survives_rows_and_columns_of_very_different_sizes) {
  Matrix a = similar(diagonal({4, 3, 1, -0.5, 0.25}), 5, 7);
  for (Index i = 0; i < 5; ++i)
    for (Index j = 0; j < 5; ++j)
      a[i * 5 + j] = std::ldexp(a[i * 5 + j], 20 * static_cast<int>(i) - 20 * static_cast<int>(j));
  const EigenSystem system = solved(a, 5);
  ASSERT_EQ(system.spaces.size(), 5u);
  const double values[] = {4, 3, 1, -0.5, 0.25};
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(system.spaces[k].value, values[k], 1e-12);
}

TEST(Eigen, knows_the_matrices_that_are_none) {
  const EigenSystem zero = solved(Matrix(16), 4);
  ASSERT_EQ(zero.spaces.size(), 1u);
  EXPECT_EQ(zero.spaces[0].value, 0);
  EXPECT_EQ(zero.spaces[0].dimension, 4u);
  EXPECT_LT(worst_product(zero), 1e-14);
  const EigenSystem one = solved({-3}, 1);
  EXPECT_EQ(one.spaces[0].value, -3);
  EXPECT_EQ(std::abs(one.spaces[0].right[0]), 1);
  const EigenSystem identity = solved(diagonal(std::vector<double>(30, 1)), 30);
  ASSERT_EQ(identity.spaces.size(), 1u);
  EXPECT_EQ(identity.spaces[0].dimension, 30u);
}

TEST(Eigen, orders_by_magnitude_and_the_positive_first) {
  const EigenSystem system = solved(diagonal({-2, 1, 2, -3}), 4);
  ASSERT_EQ(system.spaces.size(), 4u);
  const double values[] = {-3, 2, -2, 1};
  for (int k = 0; k < 4; ++k) EXPECT_EQ(system.spaces[k].value, values[k]);
}

TEST(Eigen, two_calls_give_the_same_bits) {
  const Matrix a = similar(diagonal({2, 2, 2, 1, 1, -0.75, 0, 0}), 8, 4);
  const EigenSystem one = solved(a, 8), other = solved(a, 8);
  for (std::size_t k = 0; k < one.spaces.size(); ++k) {
    EXPECT_EQ(one.spaces[k].left, other.spaces[k].left);
    EXPECT_EQ(one.spaces[k].right, other.spaces[k].right);
  }
}

TEST(Eigen, refuses_what_is_no_matrix) {
  const Budget budget;
  EXPECT_EQ(eigen_system({}, 0, budget).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(eigen_system(Matrix(5), 2, budget).error().code, ErrorCode::wrong_length);
  EXPECT_EQ(eigen_system({}, 0xffffffff, budget).error().code, ErrorCode::too_large);
  EXPECT_EQ(eigen_system(Matrix{1, NAN, 0, 1}, 2, budget).error().code, ErrorCode::not_finite);
  EXPECT_EQ(eigen_system(Matrix{1, INFINITY, 0, 1}, 2, budget).error().where, (Path{std::uint64_t{1}}));
  EXPECT_EQ(eigen_system(Matrix(4, 1.7e308), 2, budget).error().code, ErrorCode::out_of_range);  // 3.4e308
}

TEST(Eigen, stops_when_nobody_waits_any_more) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_EQ(eigen_system(diagonal({1, 2, 3}), 3, budget).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace subdivd::testing

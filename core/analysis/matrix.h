#pragma once
// Small dense matrices and vectors, no more of them than looking for eigenvalues takes.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/base/index.h"

namespace subdivd {

using Vector = std::vector<double>;
using Block = std::vector<Vector>;  // some vectors of one length

inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

struct Matrix {
  Index n;
  Vector a;  // row major

  double& operator()(Index i, Index j) { return a[std::size_t{i} * n + j]; }
  double operator()(Index i, Index j) const { return a[std::size_t{i} * n + j]; }
};

// Largest sum of absolute values in a row.
inline double norm_of(const Matrix& m) {
  double largest = 0;
  for (Index i = 0; i < m.n; ++i) {
    double sum = 0;
    for (Index j = 0; j < m.n; ++j) sum += std::abs(m(i, j));
    largest = std::max(largest, sum);
  }
  return largest;
}

inline double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

}  // namespace subdivd

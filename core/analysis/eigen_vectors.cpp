#include "core/analysis/eigen_vectors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/analysis/eigen_values.h"

namespace subdivd {
namespace {

// H - shift I = L U with exchange of neighbouring rows, for a Hessenberg matrix H.
class ShiftedHessenberg {
 public:
  ShiftedHessenberg(const Matrix& h, double shift, double norm) : u_(h), factor_(h.n), exchanged_(h.n) {
    for (Index i = 0; i < h.n; ++i) u_(i, i) -= shift;
    for (Index i = 0; i + 1 < h.n; ++i) {
      exchanged_[i] = std::abs(u_(i + 1, i)) > std::abs(u_(i, i));
      if (exchanged_[i])
        for (Index j = i; j < h.n; ++j) std::swap(u_(i, j), u_(i + 1, j));
      factor_[i] = u_(i, i) == 0 ? 0 : u_(i + 1, i) / u_(i, i);
      for (Index j = i; j < h.n; ++j) u_(i + 1, j) -= factor_[i] * u_(i, j);
    }
    // The shift is an eigenvalue: some pivot is as good as 0, and one just as small does as well.
    // [PetersWilkinson79]
    for (Index i = 0; i < h.n; ++i)
      if (std::abs(u_(i, i)) < kEpsilon * norm) u_(i, i) = kEpsilon * norm;
  }

  void solve(Vector& x) const {
    const Index n = u_.n;
    for (Index i = 0; i + 1 < n; ++i) {
      if (exchanged_[i]) std::swap(x[i], x[i + 1]);
      x[i + 1] -= factor_[i] * x[i];
    }
    for (Index i = n; i-- > 0;) {
      for (Index j = i + 1; j < n; ++j) x[i] -= u_(i, j) * x[j];
      x[i] /= u_(i, i);
    }
  }

  void solve_transposed(Vector& x) const {
    const Index n = u_.n;
    for (Index i = 0; i < n; ++i) {
      x[i] /= u_(i, i);
      for (Index j = i + 1; j < n; ++j) x[j] -= u_(i, j) * x[i];
    }
    for (Index i = n - 1; i-- > 0;) {
      x[i] -= factor_[i] * x[i + 1];
      if (exchanged_[i]) std::swap(x[i], x[i + 1]);
    }
  }

 private:
  Matrix u_;
  Vector factor_;
  std::vector<bool> exchanged_;
};

// The vectors made orthogonal to those before them and of length 1; twice, since once is not enough for
// nearly parallel ones.
void orthonormalise(Block& block) {
  for (std::size_t k = 0; k < block.size(); ++k)
    for (int pass = 0; pass < 2; ++pass) {
      double size = 0;
      for (const double x : block[k]) size = std::max(size, std::abs(x));
      for (double& x : block[k]) x /= size;
      for (std::size_t j = 0; j < k; ++j) {
        const double part = dot(block[k], block[j]);
        for (std::size_t i = 0; i < block[k].size(); ++i) block[k][i] -= part * block[j][i];
      }
      const double length = std::sqrt(dot(block[k], block[k]));
      // Nothing left: any direction will do, the next step turns it where it belongs.
      if (length == 0) block[k][k] = 1;
      for (double& x : block[k]) x /= length == 0 ? 1 : length;
    }
}

// Numbers between -1 and 1 without any pattern that a matrix could share.
Block start_vectors(Index count, Index n) {
  Block block(count, Vector(n));
  std::uint32_t state = 1;
  for (Vector& vector : block)
    for (double& x : vector) {
      state = state * 1664525u + 1013904223u;
      x = static_cast<double>(state >> 8) / 0x1p23 - 1;
    }
  return block;
}

// (H - value I) x, or its transpose.
Vector residual(const Matrix& h, double value, const Vector& x, bool transposed) {
  Vector r(h.n);
  for (Index i = 0; i < h.n; ++i)
    for (Index j = 0; j < h.n; ++j) (transposed ? r[j] : r[i]) += h(i, j) * (transposed ? x[i] : x[j]);
  for (Index i = 0; i < h.n; ++i) r[i] -= value * x[i];
  return r;
}

// Orthonormal vectors that H - value I (or its transpose) takes to 0 as far as rounding allows: at most
// `count`. Inverse iteration of the singular vectors, not of the eigenvectors: those leave a residual as
// large as the error of the value, which is far above rounding where left and right vectors are nearly
// orthogonal.
Result<Block> null_space(const Reduced& m, double value, Index count, bool transposed) {
  const ShiftedHessenberg shifted(m.h, value, m.norm);
  Block vectors = start_vectors(count, m.h.n);
  for (int half = 0; half < 6; ++half) {
    if (auto stop = m.budget.poll()) return *stop;
    for (Vector& x : vectors) (half % 2 == 0) == transposed ? shifted.solve(x) : shifted.solve_transposed(x);
    orthonormalise(vectors);
  }
  // Ordered as the singular values are: orthonormalising one after the other has sorted them.
  Block found;
  for (Vector& x : vectors) {
    const Vector rest = residual(m.h, value, x, transposed);
    if (std::sqrt(dot(rest, rest)) <= m.tolerance) found.push_back(std::move(x));
  }
  return found;
}

// From vectors of H to vectors of the balanced matrix.
void times_q(const Matrix& q, Block& block) {
  for (Vector& x : block) {
    Vector y(q.n);
    for (Index i = 0; i < q.n; ++i)
      for (Index j = 0; j < q.n; ++j) y[i] += q(i, j) * x[j];
    x = std::move(y);
  }
}

// From there to the caller's matrix: right vectors D x, of length 1; left ones D^-1 x, times the length that
// their right ones had, so that products stay, or of length 1 where there are no products to keep.
void times_diagonal(const Vector& diagonal, Block& right, Block& left, bool dual) {
  auto size_of = [](const Vector& x) {
    double size = 0;
    for (const double value : x) size = std::max(size, std::abs(value));
    return size;
  };
  auto divide = [](Vector& x, double by) {
    for (double& value : x) value /= by;
  };
  for (std::size_t k = 0; k < right.size(); ++k) {
    for (std::size_t i = 0; i < diagonal.size(); ++i) right[k][i] *= diagonal[i], left[k][i] /= diagonal[i];
    // In two steps: squares of numbers that D has made small could vanish.
    for (const bool first : {true, false}) {
      const double length = first ? size_of(right[k]) : std::sqrt(dot(right[k], right[k]));
      divide(right[k], length);
      divide(left[k], dual ? 1 / length : first ? size_of(left[k]) : std::sqrt(dot(left[k], left[k])));
    }
  }
}

// Combines the left vectors so that each has product 1 with the right vector of its number and 0 with the
// others (Gauss and Jordan on the matrix of products). False when they cannot be combined so.
bool make_dual(Block& left, const Block& right) {
  const std::size_t m = left.size();
  Block products(m, Vector(m));
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < m; ++j) products[i][j] = dot(left[i], right[j]);
  for (std::size_t k = 0; k < m; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < m; ++i)
      if (std::abs(products[i][k]) > std::abs(products[pivot][k])) pivot = i;
    if (std::abs(products[pivot][k]) < 64 * kEpsilon) return false;
    std::swap(products[k], products[pivot]);
    std::swap(left[k], left[pivot]);
    const double inverse = 1 / products[k][k];
    for (double& x : products[k]) x *= inverse;
    for (double& x : left[k]) x *= inverse;
    for (std::size_t i = 0; i < m; ++i) {
      if (i == k) continue;
      const double factor = products[i][k];
      for (std::size_t j = 0; j < m; ++j) products[i][j] -= factor * products[k][j];
      for (std::size_t j = 0; j < left[i].size(); ++j) left[i][j] -= factor * left[k][j];
    }
  }
  return true;
}

Vector joined(const Block& block) {
  Vector all;
  for (const Vector& vector : block) all.insert(all.end(), vector.begin(), vector.end());
  return all;
}

// The vectors of an eigenvalue at `value` that stands `count` times; nullopt when no single one does.
Result<std::optional<EigenSpace>> vectors_at(const Reduced& m, double value, Index count) {
  Result<Block> right = null_space(m, value, count, false);
  if (!right) return right.error();
  Result<Block> left = null_space(m, value, count, true);
  if (!left) return left.error();
  // Pairs of rows in a Jordan block make half as many vectors as the eigenvalue stands times.
  if (left->size() != right->size() || 2 * right->size() < count) return std::optional<EigenSpace>{};
  times_q(m.q, *right);
  times_q(m.q, *left);
  EigenSpace space{value, count, static_cast<Index>(right->size()), {}, {}};
  if (space.dimension == count) {
    if (!make_dual(*left, *right)) return std::optional<EigenSpace>{};
    // Rayleigh's quotient on both sides: the error left is the product of the vectors' errors.
    double correction = 0;
    for (Index k = 0; k < count; ++k)
      correction += dot((*left)[k], residual(m.balanced, value, (*right)[k], false));
    space.value += correction / count;
  }
  times_diagonal(m.diagonal, *right, *left, space.dimension == count);
  space.right = joined(*right);
  space.left = joined(*left);
  return std::optional<EigenSpace>{std::move(space)};
}

}  // namespace

Result<std::optional<EigenSpace>> space_at(const Reduced& m, double value, Index count) {
  Result<std::optional<EigenSpace>> first = vectors_at(m, value, count);
  if (!first || !*first || std::abs((*first)->value - value) <= m.tolerance / 16) return first;
  const double better = (*first)->value;
  Result<std::optional<EigenSpace>> second = vectors_at(m, better, count);
  if (!second || !*second) return second;
  (*second)->value = better;
  return second;
}

}  // namespace subdivd

#include "core/analysis/eigen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

namespace subdivd {
namespace {

using Vector = std::vector<double>;
using Block = std::vector<Vector>;  // some vectors of one length

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

struct Matrix {
  Index n;
  Vector a;  // row major

  double& operator()(Index i, Index j) { return a[std::size_t{i} * n + j]; }
  double operator()(Index i, Index j) const { return a[std::size_t{i} * n + j]; }
};

// Largest sum of absolute values in a row.
double norm_of(const Matrix& m) {
  double largest = 0;
  for (Index i = 0; i < m.n; ++i) {
    double sum = 0;
    for (Index j = 0; j < m.n; ++j) sum += std::abs(m(i, j));
    largest = std::max(largest, sum);
  }
  return largest;
}

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

// --- To Hessenberg form -----------------------------------------------------------------------------------

// Makes D^-1 A D of A, D being a diagonal of powers of 2, so that rows and columns are about equally large.
// Returns D.   [ParlettReinsch69]
Vector balance(Matrix& m) {
  constexpr double kMaxScale = 0x1p200;  // far beyond what helps; D and its inverse stay finite
  Vector scale(m.n, 1);
  for (bool again = true; again;) {
    again = false;
    for (Index i = 0; i < m.n; ++i) {
      double column = 0, row = 0, f = 1;
      for (Index j = 0; j < m.n; ++j) {
        if (j == i) continue;
        column += std::abs(m(j, i)), row += std::abs(m(i, j));
      }
      if (column == 0 || row == 0) continue;
      const double sum = column + row;
      while (column * f < row / f / 2 && f < kMaxScale) f *= 2;
      while (column * f > row / f * 2 && f > 1 / kMaxScale) f /= 2;
      const double scaled = scale[i] * f;
      if (column * f + row / f >= 0.95 * sum || scaled > kMaxScale || scaled < 1 / kMaxScale) continue;
      again = true;
      scale[i] = scaled;
      for (Index j = 0; j < m.n; ++j) m(i, j) /= f;
      for (Index j = 0; j < m.n; ++j) m(j, i) *= f;
    }
  }
  return scale;
}

// The reflection I - beta v v^T that takes x to a multiple of the first unit vector; beta = 0 where x is one.
struct Reflection {
  Vector v;
  double beta = 0;
};

Reflection reflection_of(Vector x) {
  double tail = 0;
  for (std::size_t k = 1; k < x.size(); ++k) tail = std::max(tail, std::abs(x[k]));
  // A tail far below the head must go too, though it does not change the length any more.
  if (tail == 0) return {std::move(x), 0};
  const double size = std::max(tail, std::abs(x[0]));
  for (double& value : x) value /= size;
  const double length = std::sqrt(dot(x, x));
  x[0] += x[0] < 0 ? -length : length;
  const double beta = 2 / dot(x, x);
  return {std::move(x), beta};
}

// Reflects rows first, first + 1, ... of m, in its columns [begin, end).
void reflect_rows(Matrix& m, const Reflection& r, Index first, Index begin, Index end) {
  for (Index j = begin; j < end; ++j) {
    double sum = 0;
    for (Index k = 0; k < r.v.size(); ++k) sum += r.v[k] * m(first + k, j);
    sum *= r.beta;
    for (Index k = 0; k < r.v.size(); ++k) m(first + k, j) -= sum * r.v[k];
  }
}

// The same for columns, in rows [begin, end).
void reflect_columns(Matrix& m, const Reflection& r, Index first, Index begin, Index end) {
  for (Index i = begin; i < end; ++i) {
    double sum = 0;
    for (Index k = 0; k < r.v.size(); ++k) sum += m(i, first + k) * r.v[k];
    sum *= r.beta;
    for (Index k = 0; k < r.v.size(); ++k) m(i, first + k) -= sum * r.v[k];
  }
}

// Makes H = Q^T A Q of A, 0 below the first subdiagonal; returns Q in `q`.   [GolubVanLoan13, 7.4.2]
std::optional<Error> to_hessenberg(Matrix& m, Matrix& q, const Budget& budget) {
  q = {m.n, Vector(m.a.size())};
  for (Index i = 0; i < m.n; ++i) q(i, i) = 1;
  for (Index k = 0; k + 2 < m.n; ++k) {
    if (auto stop = budget.poll()) return stop;
    Vector column;
    for (Index i = k + 1; i < m.n; ++i) column.push_back(m(i, k));
    const Reflection r = reflection_of(std::move(column));
    reflect_rows(m, r, k + 1, k, m.n);
    reflect_columns(m, r, k + 1, 0, m.n);
    reflect_columns(q, r, k + 1, 0, m.n);
    if (r.beta != 0)
      for (Index i = k + 2; i < m.n; ++i) m(i, k) = 0;
  }
  return std::nullopt;
}

// --- Eigenvalues ------------------------------------------------------------------------------------------

// One step on the window [low, high] of H, with both eigenvalues of its last two rows as shifts; `odd` shifts
// now and then break a cycle.   [Francis61; GolubVanLoan13, 7.5.1]
void francis_step(Matrix& h, Index low, Index high, bool odd) {
  const Index l = low, e = high;
  double x = h(e, e), y = h(e - 1, e - 1), w = h(e, e - 1) * h(e - 1, e);
  if (odd) {
    const double size = std::abs(h(e, e - 1)) + std::abs(h(e - 1, e - 2));
    x = y = h(e, e) + 0.75 * size, w = -0.4375 * size * size;
  }
  // First column of (H - a)(H - b), a + b = x + y and a b = x y - w, over h(l+1, l): written in differences,
  // or nearly equal eigenvalues would leave only rounding errors of it.
  const double r = x - h(l, l), s = y - h(l, l);
  Vector bulge = {(r * s - w) / h(l + 1, l) + h(l, l + 1), h(l + 1, l + 1) - h(l, l) - r - s,
                  h(l + 2, l + 1)};
  for (Index k = l; k < e; ++k) {
    const Reflection turn = reflection_of(bulge);
    const Index size = static_cast<Index>(turn.v.size());
    reflect_rows(h, turn, k, k > l ? k - 1 : l, e + 1);
    reflect_columns(h, turn, k, l, std::min(k + size + 1, e + 1));
    if (k > l)
      for (Index i = 1; i < size; ++i) h(k + i, k - 1) = 0;
    bulge = {h(k + 1, k)};
    if (k + 2 <= e) bulge.push_back(h(k + 2, k));
    if (k + 3 <= e) bulge.push_back(h(k + 3, k));
  }
}

// Both eigenvalues of (a b; c d).
std::array<std::complex<double>, 2> eigenvalues_of_two(double a, double b, double c, double d) {
  const double p = (a - d) / 2, q = p * p + b * c;
  if (q < 0) return {std::complex<double>{d + p, std::sqrt(-q)}, {d + p, -std::sqrt(-q)}};
  const double z = p + (p < 0 ? -std::sqrt(q) : std::sqrt(q));
  return {d + z, z == 0 ? d : d - b * c / z};
}

Error no_convergence() {
  return Error{
      ErrorCode::internal, "the eigenvalues of the matrix were not found in the steps allowed", {}, 0, 0};
}

Result<std::vector<std::complex<double>>> eigenvalues(Matrix h, const Budget& budget) {
  constexpr int kPatience = 30, kMaxSteps = 100;  // for one eigenvalue; two to four is what it takes
  std::vector<std::complex<double>> values;
  const double norm = norm_of(h);
  int steps = 0;
  for (Index rest = h.n; rest > 0;) {
    const Index high = rest - 1;
    Index low = high;
    for (; low > 0; --low) {
      // Measured by its neighbours, so that small eigenvalues beside large ones keep their digits. Where the
      // neighbours are nothing but rounding errors themselves this never ends: then by the norm.
      double size = std::abs(h(low - 1, low - 1)) + std::abs(h(low, low));
      if (size == 0 || steps > kPatience) size = norm;
      if (std::abs(h(low, low - 1)) <= kEpsilon * size) break;
    }
    if (low == high) {
      values.push_back(h(high, high));
      rest -= 1, steps = 0;
    } else if (low + 1 == high) {
      for (const auto& value : eigenvalues_of_two(h(low, low), h(low, high), h(high, low), h(high, high)))
        values.push_back(value);
      rest -= 2, steps = 0;
    } else {
      if (auto stop = budget.poll()) return *stop;
      if (++steps > kMaxSteps) return no_convergence();
      francis_step(h, low, high, steps % 10 == 0);
    }
  }
  return values;
}

// --- Vectors ----------------------------------------------------------------------------------------------

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

// What is known of the matrix when vectors are looked for.
struct Reduced {
  const Matrix& balanced;
  const Vector& diagonal;  // balanced = diagonal^-1 matrix diagonal / scale
  const Matrix& q;
  const Matrix& h;  // = q^T balanced q
  double scale;
  double norm;       // of h
  double tolerance;  // of a residual that counts as 0
  const Budget& budget;
};

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

// The same, with the value as exact as its vectors make it, and vectors that fit to it.
Result<std::optional<EigenSpace>> space_at(const Reduced& m, double value, Index count) {
  Result<std::optional<EigenSpace>> first = vectors_at(m, value, count);
  if (!first || !*first || std::abs((*first)->value - value) <= m.tolerance / 16) return first;
  const double better = (*first)->value;
  Result<std::optional<EigenSpace>> second = vectors_at(m, better, count);
  if (!second || !*second) return second;
  (*second)->value = better;
  return second;
}

Error not_real(std::complex<double> value) {
  return Error{ErrorCode::unsupported,
               "the matrix has complex eigenvalues, such as " + std::to_string(value.real()) + " + " +
                   std::to_string(std::abs(value.imag())) + " i; only real ones are supported",
               {},
               0,
               0};
}

Error not_separable(double value) {
  return Error{
      ErrorCode::unsupported,
      "the eigenvalue " + std::to_string(value) +
          " has fewer than half as many eigenvectors as it stands times: Jordan blocks of more than two "
          "rows are not supported",
      {},
      0,
      0};
}

// Appends the spaces of values[begin, end), which are sorted by their real parts and closer to each other
// than `apart`. A Jordan block of two rows scatters its eigenvalue by the root of the rounding errors, also
// into complex pairs; simple eigenvalues may lie closer to each other than that. So first all of them are
// tried as one, and where that is none they are divided at their widest gaps.
std::optional<Error> append_spaces(const Reduced& m, std::span<const std::complex<double>> values,
                                   double apart, std::vector<EigenSpace>& spaces) {
  const Index count = static_cast<Index>(values.size());
  double mean = 0, imaginary = 0;
  std::complex<double> worst;
  for (const auto& value : values) {
    mean += value.real() / count;
    if (std::abs(value.imag()) > imaginary) worst = value, imaginary = std::abs(value.imag());
  }
  if (imaginary <= apart) {
    Result<std::optional<EigenSpace>> space = space_at(m, mean, count);
    if (!space) return space.error();
    if (*space) return spaces.push_back(std::move(**space)), std::nullopt;
  }
  const double closer = apart / 8;
  if (count == 1 || closer < kEpsilon * m.norm)
    return imaginary > 0 ? not_real(worst * m.scale) : not_separable(mean * m.scale);
  for (std::size_t begin = 0; begin < values.size();) {
    std::size_t end = begin + 1;
    while (end < values.size() && values[end].real() - values[end - 1].real() <= closer) ++end;
    if (auto fault = append_spaces(m, values.subspan(begin, end - begin), closer, spaces)) return fault;
    begin = end;
  }
  return std::nullopt;
}

Result<void> check(std::span<const double> matrix, Index size) {
  if (size == 0) return Error{ErrorCode::out_of_range, "a matrix needs at least one row", {}, 0, 0};
  if (size > kMaxEigenSize)
    return Error{ErrorCode::too_large,
                 "a matrix of " + std::to_string(size) + " rows is too large; " +
                     std::to_string(kMaxEigenSize) + " are allowed",
                 {},
                 size,
                 kMaxEigenSize};
  if (matrix.size() != std::size_t{size} * size)
    return Error{ErrorCode::wrong_length,
                 "a matrix of " + std::to_string(size) + " rows has as many columns; there are " +
                     std::to_string(matrix.size()) + " numbers",
                 {},
                 0,
                 0};
  for (std::size_t k = 0; k < matrix.size(); ++k)
    if (!std::isfinite(matrix[k]))
      return Error{ErrorCode::not_finite, "an entry of the matrix is not a finite number", {k}, 0, 0};
  return {};
}

}  // namespace

Result<EigenSystem> eigen_system(std::span<const double> matrix, Index size, const Budget& budget) {
  if (auto checked = check(matrix, size); !checked) return checked.error();
  double largest = 0;
  for (const double x : matrix) largest = std::max(largest, std::abs(x));
  const double scale = largest == 0 ? 1 : std::exp2(std::floor(std::log2(largest)));
  Matrix balanced{size, Vector(matrix.begin(), matrix.end())};
  for (double& x : balanced.a) x /= scale;
  const Vector diagonal = balance(balanced);
  Matrix h = balanced, q;
  if (auto stop = to_hessenberg(h, q, budget)) return *stop;
  auto values = eigenvalues(h, budget);
  if (!values) return values.error();
  std::sort(values->begin(), values->end(), [](const auto& a, const auto& b) {
    return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag();
  });
  const double norm = norm_of(h) == 0 ? 1 : norm_of(h);
  const Reduced reduced{balanced, diagonal, q, h, scale, norm, (64 + size) * kEpsilon * norm, budget};
  EigenSystem system{size, {}};
  // Roots of rounding errors are about 1e-8; what is farther apart than 64 times that is distinct.
  const double apart = 1e-6 * norm;
  for (std::size_t begin = 0; begin < values->size();) {
    std::size_t end = begin + 1;
    while (end < values->size() && (*values)[end].real() - (*values)[end - 1].real() <= apart) ++end;
    const auto group = std::span(*values).subspan(begin, end - begin);
    if (auto fault = append_spaces(reduced, group, apart, system.spaces)) return *fault;
    begin = end;
  }
  for (EigenSpace& space : system.spaces) {
    space.value *= scale;
    if (!std::isfinite(space.value))
      return Error{ErrorCode::out_of_range, "an eigenvalue is too large for a double", {}, 0, 0};
  }
  std::stable_sort(system.spaces.begin(), system.spaces.end(), [](const EigenSpace& a, const EigenSpace& b) {
    return std::abs(a.value) != std::abs(b.value) ? std::abs(a.value) > std::abs(b.value) : a.value > b.value;
  });
  return system;
}

}  // namespace subdivd

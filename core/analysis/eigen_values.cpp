#include "core/analysis/eigen_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace subdivd {
namespace {

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
  return Error{ErrorCode::internal, "the eigenvalues of the matrix were not found in the steps allowed"};
}

}  // namespace

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

}  // namespace subdivd

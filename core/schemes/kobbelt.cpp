#include "core/schemes/kobbelt.h"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace subdivd {
namespace {

using Complex = std::complex<double>;
// Of the points of a sector, those of mask.h's TwoRingMask in its order.
enum Point : std::size_t { kEnd, kFace, kBehind, kBeside, kBeyond, kAcross, kCount };
using Row = std::array<Complex, kCount>;

Row operator*(Complex factor, Row row) {
  for (Complex& x : row) x *= factor;
  return row;
}
Row operator+(Row a, const Row& b) {
  for (std::size_t k = 0; k < kCount; ++k) a[k] += b[k];
  return a;
}
Row unit(Point point) {
  Row row{};
  row[point] = 1;
  return row;
}

// How the points of the next level's sector come from this one's when those of sector j are z^j times those of sector 0:
// the first wave around the vertex, whose own part in it is 0.
std::array<Row, kCount> step(Complex z) {
  constexpr double w = Kobbelt::tension, c = w / (1.0 / 2 + w);
  const Complex back = std::conj(z);
  const Row l = unit(kEnd), k = unit(kFace), m = unit(kBehind), a = unit(kBeside), far = unit(kBeyond),
            b = unit(kAcross);
  // The point between two of a line, and those before and behind them.
  const auto between = [](const Row& before, const Row& p, const Row& q, const Row& behind) {
    return (1.0 / 2 + w) * (p + q) + -w * (before + behind);
  };
  const Row extension = -(back + 1.0 + z) * l + c * (back * back + back + 1.0 + z) * k;
  const Row on_edge = between(extension, Row{}, l, m);    // (v, l_j)
  const Row first = between(back * k, l, k, b);           // (l_j, k_j)
  const Row second = between(z * k, z * l, k, a);         // (l_{j+1}, k_j)
  const Row behind_first = between(back * b, m, a, far);  // (m_j, a_j)
  const Row behind_second = between(z * a, z * m, b, far);
  // In both directions; see core/engine/plain/line_rows.h.
  const Row across_l = between(back * first, on_edge, second, behind_second);
  const Row across_k = between(z * second, z * on_edge, first, behind_first);
  return {on_edge, 0.5 * (across_l + across_k), l, first, k, second};
}

}  // namespace

TwoRingMask Kobbelt::tangent_mask(Index n) const {
  const auto rows = step(std::polar(1.0, 2 * std::numbers::pi / n));
  // The other eigenvalues of the first wave are some half of the largest or less.
  constexpr int kSteps = 120;
  Row left = unit(kEnd);
  for (int pass = 0; pass < kSteps; ++pass) {
    Row next{};
    for (std::size_t k = 0; k < kCount; ++k) next = next + left[k] * rows[k];
    left = (1.0 / next[kEnd]) * next;
  }
  return {left[kEnd], left[kFace], left[kBehind], left[kBeside], left[kBeyond], left[kAcross]};
}

}  // namespace subdivd

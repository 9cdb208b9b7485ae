#include "core/lattice/quad_faces.h"

#include <cstring>

#include "core/lattice/quads.h"

namespace subdivd {
namespace {

// Row j's points are left, first, first + step, ..., right.
struct Row {
  Index left, first, step, right;
};

Row row_of(const QuadNumbers& numbers, Count n, Count j) {
  const auto inner = static_cast<Index>(j) - 1;
  if (j == 0) return {numbers.corner[0], numbers.side[0], numbers.step[0], numbers.corner[1]};
  // Sides 2 and 3 run against the rows.
  if (j == n) {
    const auto last = static_cast<Index>(n) - 2;
    return {numbers.corner[3], numbers.side[2] + last * numbers.step[2], Index{0} - numbers.step[2],
            numbers.corner[2]};
  }
  return {numbers.side[3] + (static_cast<Index>(n) - 2 - inner) * numbers.step[3],
          static_cast<Index>(numbers.inside + inner_quad_index(n, 1, j)), 1,
          numbers.side[1] + inner * numbers.step[1]};
}

template <QuadForm kForm>
[[gnu::always_inline]] inline Index* put_quad(Index a, Index b, Index c, Index d, Index* out) {
  if constexpr (kForm == QuadForm::quads) {
    const Index four[4] = {a, b, c, d};
    std::memcpy(out, four, sizeof four);
    return out + 4;
  } else {
    const Index six[6] = {a, b, c, a, c, d};
    std::memcpy(out, six, sizeof six);
    return out + 6;
  }
}

// The quads between two rows of n segments.
template <QuadForm kForm>
Index* write_row(const Row& low, const Row& high, Count n, Index* out) {
  if (n == 1) return put_quad<kForm>(low.left, low.right, high.right, high.left, out);
  out = put_quad<kForm>(low.left, low.first, high.first, high.left, out);
  Index a = low.first, d = high.first;
  if constexpr (kForm == QuadForm::quads) {
    // Inside rows numbers follow one another: a pattern that grows a quad by a step.
    using Four = Index __attribute__((vector_size(16)));
    Four at = {a, a + low.step, d + high.step, d};
    const Four grow = {low.step, low.step, high.step, high.step};
    for (Count k = 2; k < n; ++k, out += 4, at += grow) std::memcpy(out, &at, sizeof at);
    a += static_cast<Index>(n - 2) * low.step;
    d += static_cast<Index>(n - 2) * high.step;
  } else {
    for (Count k = 2; k < n; ++k, a += low.step, d += high.step)
      out = put_quad<kForm>(a, a + low.step, d + high.step, d, out);
  }
  return put_quad<kForm>(a, low.right, high.right, d, out);
}

}  // namespace

template <QuadForm kForm>
QuadWriter<kForm>::QuadWriter(const Connectivity<Quads>& connectivity, Index level, const Pace& pace)
    : connectivity_(connectivity), n_(segments(level)), pace_(pace) {}

template <QuadForm kForm>
Index* QuadWriter<kForm>::write_rows(Index face, Count begin, Count end, Index* out) const {
  const QuadNumbers numbers(connectivity_, n_, face);
  Row low = row_of(numbers, n_, begin);
  for (Count j = begin; j < end; ++j) {
    pace_.spend(n_);
    const Row high = row_of(numbers, n_, j + 1);
    out = write_row<kForm>(low, high, n_, out);
    low = high;
  }
  return out;
}

template class QuadWriter<QuadForm::quads>;
template class QuadWriter<QuadForm::triangles>;

}  // namespace subdivd

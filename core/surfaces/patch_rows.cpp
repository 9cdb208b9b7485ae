#include "core/surfaces/patch_rows.h"

#include <algorithm>
#include <cstddef>

#include "core/base/all_finite.h"
#include "core/base/precision.h"
#include "core/curves/kernels/curve_kernels.h"

namespace subdivd {
namespace {

// Points so far from either end that no rule sees it.
constexpr Count kEdge = 2;

// Three points of a row into one, times `scale`.
template <class Real>
void combine_points(const Real* row, Index width, const Taps& taps, Real scale, Real* out) {
  const Real* a = row + taps.at[0] * width;
  const Real* b = row + taps.at[1] * width;
  const Real* c = row + taps.at[2] * width;
  const Real x = Real(taps.weight[0]), y = Real(taps.weight[1]), z = Real(taps.weight[2]);
  for (Index k = 0; k < width; ++k) out[k] = ((a[k] * x + b[k] * y) + c[k] * z) * scale;
}

// Points first, ..., last - 1 of a new row by the taps of each.
template <class Real, class Rule>
void by_taps(const Real* row, Index width, Count first, Count last, Rule&& rule, Real scale, Real* out,
             const Pace& pace) {
  for (Count i = first; i < last; ++i) {
    pace.spend(width);
    combine_points(row, width, rule(i), scale, out + i * width);
  }
}

}  // namespace

template <class Real>
void combine_rows(const Real* grid, Count row_size, const Taps& taps, Real* out, const Pace& pace) {
  const Real* a = grid + taps.at[0] * row_size;
  const Real* b = grid + taps.at[1] * row_size;
  const Real* c = grid + taps.at[2] * row_size;
  const Real x = Real(taps.weight[0]), y = Real(taps.weight[1]), z = Real(taps.weight[2]);
  for (Count begin = 0; begin < row_size; begin += Pace::kBlock) {
    const Count end = std::min(begin + Pace::kBlock, row_size);
    pace.spend(end - begin);
    for (Count k = begin; k < end; ++k) out[k] = (a[k] * x + b[k] * y) + c[k] * z;
  }
}

// Inside, the two children of a point are those of a curve of the same degree, by the same sums.
template <class Real>
void split_row(const Direction& d, const Real* row, Index width, Real* out, const Pace& pace) {
  const auto rule = [&](Count i) { return step_taps(d, i); };
  const Count children = refined_grid_count(d.wrap, d.degree, d.n, 1);
  if (d.n <= 2 * kEdge || width > kernels::kKernelWidth)
    return by_taps(row, width, 0, children, rule, Real(1), out, pace);
  // Open rows without an end rule at their first point lack its first child (step_taps).
  const Count lacking = d.wrap == CurveWrap::nonperiodic || (d.open() && d.degree == 2) ? 1 : 0;
  const auto split = kernels::curve_kernels<Real>().lane_riesenfeld[d.degree - 1][width - 1];
  for (Count begin = kEdge; begin < d.n - kEdge; begin += Pace::kBlock) {
    const Count end = std::min(begin + Pace::kBlock, d.n - kEdge);
    pace.spend(2 * (end - begin) * width);
    split(0, row + begin * width, end - begin, out + (2 * begin - lacking) * width);
  }
  by_taps(row, width, 0, 2 * kEdge - lacking, rule, Real(1), out, pace);
  by_taps(row, width, 2 * (d.n - kEdge) - lacking, children, rule, Real(1), out, pace);
}

template <class Real>
void combine_along(const Direction& d, const Real* row, Index width, RowRule rule, Real scale, Real* out,
                   const Pace& pace) {
  const auto of_point = [&](Count i) { return rule(d, i); };
  if (d.n <= 2 * kEdge) return by_taps(row, width, 0, d.n, of_point, scale, out, pace);
  const Taps inside = rule(d, kEdge);
  const Real x = Real(inside.weight[0]), y = Real(inside.weight[1]), z = Real(inside.weight[2]);
  const Count last = (d.n - kEdge) * width;
  for (Count begin = kEdge * width; begin < last; begin += Pace::kBlock) {
    const Count end = std::min(begin + Pace::kBlock, last);
    pace.spend(end - begin);
    for (Count k = begin; k < end; ++k)
      out[k] = ((row[k - width] * x + row[k + width] * y) + row[k] * z) * scale;
  }
  by_taps(row, width, 0, kEdge, of_point, scale, out, pace);
  by_taps(row, width, d.n - kEdge, d.n, of_point, scale, out, pace);
}

template <class Real>
Result<void> check_finite(std::span<const Real> values, const Pace& pace) {
  while (!values.empty()) {
    const std::size_t count = std::min<std::size_t>(values.size(), Pace::kBlock);
    pace.spend(count);
    if (!all_finite(values.first(count))) return does_not_fit();
    values = values.subspan(count);
  }
  return {};
}

template void combine_rows(const float*, Count, const Taps&, float*, const Pace&);
template void combine_rows(const double*, Count, const Taps&, double*, const Pace&);
template void split_row(const Direction&, const float*, Index, float*, const Pace&);
template void split_row(const Direction&, const double*, Index, double*, const Pace&);
template void combine_along(const Direction&, const float*, Index, RowRule, float, float*, const Pace&);
template void combine_along(const Direction&, const double*, Index, RowRule, double, double*, const Pace&);
template Result<void> check_finite(std::span<const float>, const Pace&);
template Result<void> check_finite(std::span<const double>, const Pace&);

}  // namespace subdivd

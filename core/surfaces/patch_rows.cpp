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
std::optional<Error> by_taps(const Real* row, Index width, Count first, Count last, Rule&& rule, Real scale,
                             Real* out, Pacer& pacer) {
  for (Count i = first; i < last; ++i) {
    if (auto stop = pacer.spend(width)) return stop;
    combine_points(row, width, rule(i), scale, out + i * width);
  }
  return std::nullopt;
}

}  // namespace

template <class Real>
std::optional<Error> combine_rows(const Real* grid, Count row_size, const Taps& taps, Real* out,
                                  Pacer& pacer) {
  const Real* a = grid + taps.at[0] * row_size;
  const Real* b = grid + taps.at[1] * row_size;
  const Real* c = grid + taps.at[2] * row_size;
  const Real x = Real(taps.weight[0]), y = Real(taps.weight[1]), z = Real(taps.weight[2]);
  for (Count begin = 0; begin < row_size; begin += Pacer::kInterval) {
    const Count end = std::min(begin + Pacer::kInterval, row_size);
    if (auto stop = pacer.spend(end - begin)) return stop;
    for (Count k = begin; k < end; ++k) out[k] = (a[k] * x + b[k] * y) + c[k] * z;
  }
  return std::nullopt;
}

// Inside, the two children of a point are those of a curve of the same degree, by the same sums.
template <class Real>
std::optional<Error> split_row(const Direction& d, const Real* row, Index width, Real* out, Pacer& pacer) {
  const auto rule = [&](Count i) { return step_taps(d, i); };
  const Count children = refined_grid_count(d.wrap, d.degree, d.n, 1);
  if (d.n <= 2 * kEdge || width > kernels::kKernelWidth)
    return by_taps(row, width, 0, children, rule, Real(1), out, pacer);
  // Open rows without an end rule at their first point lack its first child (step_taps).
  const Count lacking = d.wrap == CurveWrap::nonperiodic || (d.open() && d.degree == 2) ? 1 : 0;
  const auto split = kernels::curve_kernels<Real>().lane_riesenfeld[d.degree - 1][width - 1];
  for (Count begin = kEdge; begin < d.n - kEdge; begin += Pacer::kInterval) {
    const Count end = std::min(begin + Pacer::kInterval, d.n - kEdge);
    if (auto stop = pacer.spend(2 * (end - begin) * width)) return stop;
    split(0, row + begin * width, end - begin, out + (2 * begin - lacking) * width);
  }
  if (auto stop = by_taps(row, width, 0, 2 * kEdge - lacking, rule, Real(1), out, pacer)) return stop;
  return by_taps(row, width, 2 * (d.n - kEdge) - lacking, children, rule, Real(1), out, pacer);
}

template <class Real>
std::optional<Error> combine_along(const Direction& d, const Real* row, Index width, RowRule rule, Real scale,
                                   Real* out, Pacer& pacer) {
  const auto of_point = [&](Count i) { return rule(d, i); };
  if (d.n <= 2 * kEdge) return by_taps(row, width, 0, d.n, of_point, scale, out, pacer);
  const Taps inside = rule(d, kEdge);
  const Real x = Real(inside.weight[0]), y = Real(inside.weight[1]), z = Real(inside.weight[2]);
  const Count last = (d.n - kEdge) * width;
  for (Count begin = kEdge * width; begin < last; begin += Pacer::kInterval) {
    const Count end = std::min(begin + Pacer::kInterval, last);
    if (auto stop = pacer.spend(end - begin)) return stop;
    for (Count k = begin; k < end; ++k)
      out[k] = ((row[k - width] * x + row[k + width] * y) + row[k] * z) * scale;
  }
  if (auto stop = by_taps(row, width, 0, kEdge, of_point, scale, out, pacer)) return stop;
  return by_taps(row, width, d.n - kEdge, d.n, of_point, scale, out, pacer);
}

template <class Real>
Result<void> check_finite(std::span<const Real> values, Pacer& pacer) {
  while (!values.empty()) {
    const std::size_t count = std::min<std::size_t>(values.size(), Pacer::kInterval);
    if (auto stop = pacer.spend(count)) return *stop;
    if (!all_finite(values.first(count))) return does_not_fit();
    values = values.subspan(count);
  }
  return {};
}

template std::optional<Error> combine_rows(const float*, Count, const Taps&, float*, Pacer&);
template std::optional<Error> combine_rows(const double*, Count, const Taps&, double*, Pacer&);
template std::optional<Error> split_row(const Direction&, const float*, Index, float*, Pacer&);
template std::optional<Error> split_row(const Direction&, const double*, Index, double*, Pacer&);
template std::optional<Error> combine_along(const Direction&, const float*, Index, RowRule, float, float*,
                                            Pacer&);
template std::optional<Error> combine_along(const Direction&, const double*, Index, RowRule, double, double*,
                                            Pacer&);
template Result<void> check_finite(std::span<const float>, Pacer&);
template Result<void> check_finite(std::span<const double>, Pacer&);

}  // namespace subdivd

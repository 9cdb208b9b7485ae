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
                             Real* out, BudgetPoller& poller) {
  for (Count i = first; i < last; ++i) {
    if (auto stop = poller.spend(width)) return stop;
    combine_points(row, width, rule(i), scale, out + i * width);
  }
  return std::nullopt;
}

}  // namespace

template <class Real>
std::optional<Error> combine_rows(const Real* grid, Count row_size, const Taps& taps, Real* out,
                                  BudgetPoller& poller) {
  const Real* a = grid + taps.at[0] * row_size;
  const Real* b = grid + taps.at[1] * row_size;
  const Real* c = grid + taps.at[2] * row_size;
  const Real x = Real(taps.weight[0]), y = Real(taps.weight[1]), z = Real(taps.weight[2]);
  for (Count begin = 0; begin < row_size; begin += BudgetPoller::kInterval) {
    const Count end = std::min(begin + BudgetPoller::kInterval, row_size);
    if (auto stop = poller.spend(end - begin)) return stop;
    for (Count k = begin; k < end; ++k) out[k] = (a[k] * x + b[k] * y) + c[k] * z;
  }
  return std::nullopt;
}

// Inside, the two children of a point are those of a curve of the same degree, by the same sums.
template <class Real>
std::optional<Error> split_row(const Direction& d, const Real* row, Index width, Real* out,
                               BudgetPoller& poller) {
  const auto rule = [&](Count i) { return step_taps(d, i); };
  const Count children = refined_grid_count(d.wrap, d.degree, d.n, 1);
  if (d.n <= 2 * kEdge || width > kernels::kKernelWidth)
    return by_taps(row, width, 0, children, rule, Real(1), out, poller);
  // Open rows without an end rule at their first point lack its first child (step_taps).
  const Count lacking = d.wrap == CurveWrap::nonperiodic || (d.open() && d.degree == 2) ? 1 : 0;
  const auto split = kernels::curve_kernels<Real>().lane_riesenfeld[d.degree - 1][width - 1];
  for (Count begin = kEdge; begin < d.n - kEdge; begin += BudgetPoller::kInterval) {
    const Count end = std::min(begin + BudgetPoller::kInterval, d.n - kEdge);
    if (auto stop = poller.spend(2 * (end - begin) * width)) return stop;
    split(0, row + begin * width, end - begin, out + (2 * begin - lacking) * width);
  }
  if (auto stop = by_taps(row, width, 0, 2 * kEdge - lacking, rule, Real(1), out, poller)) return stop;
  return by_taps(row, width, 2 * (d.n - kEdge) - lacking, children, rule, Real(1), out, poller);
}

template <class Real>
std::optional<Error> combine_along(const Direction& d, const Real* row, Index width, RowRule rule, Real scale,
                                   Real* out, BudgetPoller& poller) {
  const auto of_point = [&](Count i) { return rule(d, i); };
  if (d.n <= 2 * kEdge) return by_taps(row, width, 0, d.n, of_point, scale, out, poller);
  const Taps inside = rule(d, kEdge);
  const Real x = Real(inside.weight[0]), y = Real(inside.weight[1]), z = Real(inside.weight[2]);
  const Count last = (d.n - kEdge) * width;
  for (Count begin = kEdge * width; begin < last; begin += BudgetPoller::kInterval) {
    const Count end = std::min(begin + BudgetPoller::kInterval, last);
    if (auto stop = poller.spend(end - begin)) return stop;
    for (Count k = begin; k < end; ++k)
      out[k] = ((row[k - width] * x + row[k + width] * y) + row[k] * z) * scale;
  }
  if (auto stop = by_taps(row, width, 0, kEdge, of_point, scale, out, poller)) return stop;
  return by_taps(row, width, d.n - kEdge, d.n, of_point, scale, out, poller);
}

template <class Real>
Result<void> check_finite(std::span<const Real> values, BudgetPoller& poller) {
  while (!values.empty()) {
    const std::size_t count = std::min<std::size_t>(values.size(), BudgetPoller::kInterval);
    if (auto stop = poller.spend(count)) return *stop;
    if (!all_finite(values.first(count))) return does_not_fit();
    values = values.subspan(count);
  }
  return {};
}

template std::optional<Error> combine_rows(const float*, Count, const Taps&, float*, BudgetPoller&);
template std::optional<Error> combine_rows(const double*, Count, const Taps&, double*, BudgetPoller&);
template std::optional<Error> split_row(const Direction&, const float*, Index, float*, BudgetPoller&);
template std::optional<Error> split_row(const Direction&, const double*, Index, double*, BudgetPoller&);
template std::optional<Error> combine_along(const Direction&, const float*, Index, RowRule, float, float*,
                                            BudgetPoller&);
template std::optional<Error> combine_along(const Direction&, const double*, Index, RowRule, double, double*,
                                            BudgetPoller&);
template Result<void> check_finite(std::span<const float>, BudgetPoller&);
template Result<void> check_finite(std::span<const double>, BudgetPoller&);

}  // namespace subdivd

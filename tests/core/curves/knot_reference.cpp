#include "tests/core/curves/knot_reference.h"

#include <cmath>

namespace subdivd::testing {
namespace {

// N_{i,p}(t) on the knots `knot`, `knot` + 1, ...: N_{i,0} = 1 on [i, i+1), and
// N_{i,p} = (t - i)/p N_{i,p-1} + (i+p+1 - t)/p N_{i+1,p-1}.   [Cox 72, deBoor 72]
long double basis(long double knot, int degree, long double t) {
  if (t < knot || t > knot + degree + 1) return 0;
  if (degree == 0) return t < knot + 1 ? 1 : 0;
  return (t - knot) / degree * basis(knot, degree - 1, t) +
         (knot + degree + 1 - t) / degree * basis(knot + 1, degree - 1, t);
}

// 3 of other kinds than B-splines, which do not ask for it.
int degree_of(const ControlCurves& curves) {
  const UniformBSpline* bspline = std::get_if<UniformBSpline>(&curves.basis);
  return bspline == nullptr ? 3 : static_cast<int>(bspline->degree);
}

bool dual(const ControlCurves& curves) {
  return std::holds_alternative<CornerCutting>(curves.basis) ||
         (std::holds_alternative<UniformBSpline>(curves.basis) && degree_of(curves) % 2 == 0);
}

template <class Weight>
std::vector<double> sum_of_all(const ControlCurves& curves, Weight&& weight) {
  const bool inner = dual(curves) && curves.wrap == CurveWrap::pinned;
  const int n = static_cast<int>(curves.point_count()) - (inner ? 2 : 0);
  const int more = curves.wrap == CurveWrap::nonperiodic ? 0 : degree_of(curves) + 1;
  std::vector<double> sums;
  for (Index k = 0; k < curves.width; ++k) {
    long double sum = 0;
    for (int i = -more; i < n + more; ++i) sum += weight(i + (inner ? 0.5L : 0.0L)) * continued(curves, i, k);
    sums.push_back(static_cast<double>(sum));
  }
  return sums;
}

double binomial(int n, int k) {
  double value = 1;
  for (int i = 0; i < k; ++i) value = value * (n - i) / (i + 1);
  return std::round(value);
}

// Child m (of point m / 2) of one scalar; c(i) gives the points.
template <class Points>
double child(const ControlCurves& curves, int m, Points&& c) {
  const int i = m >= 0 ? m / 2 : -((1 - m) / 2);
  const bool second = m != 2 * i;
  if (std::holds_alternative<FourPoint>(curves.basis)) {
    const double w = std::get<FourPoint>(curves.basis).tension;
    if (!second) return c(i);
    return (c(i) * 0.5 + c(i + 1) * 0.5) + ((c(i) * w - c(i - 1) * w) + (c(i + 1) * w - c(i + 2) * w));
  }
  if (const CornerCutting* cutting = std::get_if<CornerCutting>(&curves.basis))
    return c(second ? i + 1 : i - 1) * cutting->ratio + c(i) * (1 - cutting->ratio);
  const int p = degree_of(curves), h = (p + 1) / 2;
  const auto weight = [&](int parent) {
    const int k = m - 2 * parent + h;
    return k < 0 || k > p + 1 ? 0 : binomial(p + 1, k) / std::ldexp(1.0, p);
  };
  double sum = 0;
  bool started = false;
  const auto add = [&](double value) { sum = started ? sum + value : value, started = true; };
  for (int away = p; away > 0; --away) {  // pairs, outermost first
    const int before = second && p % 2 == 1 ? i + 1 - away : second ? i - away : i + away;
    const int after = p % 2 == 1 ? i + away : second ? i + away : i - away;
    if (p % 2 == 1) {
      const int other = second ? before : i - away;
      if (weight(after) != 0) add(c(other) * weight(other) + c(after) * weight(after));
      continue;
    }
    if (weight(before) != 0) add(c(before) * weight(before));
    if (weight(after) != 0) add(c(after) * weight(after));
  }
  if (p % 2 == 0 || !second) add(c(i) * weight(i));
  return sum;
}

}  // namespace

double continued(const ControlCurves& curves, int i, Index k) {
  const bool pinned = curves.wrap == CurveWrap::pinned, inner = pinned && dual(curves);
  const int total = static_cast<int>(curves.point_count()), n = inner ? total - 2 : total;
  const auto at = [&](int j) { return curves.points[static_cast<std::size_t>(j) * curves.width + k]; };
  if (curves.wrap == CurveWrap::periodic) return at(((i % n) + n) % n);
  if (!pinned || (i >= 0 && i < n)) return at(inner ? i + 1 : i);
  const double end = at(i < 0 ? 0 : total - 1);
  const int mirror = i < 0 ? (inner ? -1 - i : -i) : (inner ? 2 * n - 1 - i : 2 * n - 2 - i);
  return end + (end - continued(curves, mirror, k));
}

std::vector<double> all_basis_point(const ControlCurves& curves, double t) {
  const int p = degree_of(curves);
  return sum_of_all(curves, [&](long double peak) { return basis(peak - (p + 1) / 2.0L, p, t); });
}

std::vector<double> all_basis_slope(const ControlCurves& curves, double t) {
  const int p = degree_of(curves);
  return sum_of_all(curves, [&](long double peak) {
    const long double knot = peak - (p + 1) / 2.0L;
    return basis(knot, p - 1, t) - basis(knot + 1, p - 1, t);
  });
}

std::vector<double> plain_step(const ControlCurves& curves) {
  const bool pinned = curves.wrap == CurveWrap::pinned, inner = pinned && dual(curves);
  const int total = static_cast<int>(curves.point_count());
  const int p = degree_of(curves);
  int first = 0, last = 2 * total - 1;
  if (curves.wrap == CurveWrap::nonperiodic) {
    const int lost = std::holds_alternative<UniformBSpline>(curves.basis) ? p
                     : std::holds_alternative<FourPoint>(curves.basis)    ? 5
                                                                          : 2;
    first = lost / 2;
    last = first + 2 * total - lost - 1;
  } else if (inner) {
    last = 2 * (total - 2) - 1;
  } else if (pinned) {
    last = 2 * total - 2;
  }
  std::vector<double> points;
  const auto append_end = [&](std::size_t end) {
    for (Index k = 0; k < curves.width; ++k) points.push_back(curves.points[end * curves.width + k]);
  };
  if (inner) append_end(0);
  for (int m = first; m <= last; ++m) {
    if (pinned && !inner && (m == first || m == last)) {
      append_end(m == first ? 0 : static_cast<std::size_t>(total - 1));
      continue;
    }
    for (Index k = 0; k < curves.width; ++k)
      points.push_back(child(curves, m, [&](int i) { return continued(curves, i, k); }));
  }
  if (inner) append_end(static_cast<std::size_t>(total - 1));
  return points;
}

}  // namespace subdivd::testing

#include "core/splines/gauss_rule.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/splines/bounds.h"

namespace subdivd {

// By Newton's method on the recurrence of Legendre polynomials.
GaussRule::GaussRule(Index m) : nodes(m), weights(m) {
  for (Index i = 0; i < (m + 1) / 2; ++i) {
    double z = std::cos(std::numbers::pi * (i + 0.75) / (m + 0.5)), slope = 1;
    for (int step = 0; step < 8; ++step) {
      double value = z, before = 1;
      for (Index n = 2; n <= m; ++n) {
        const double next = ((2.0 * n - 1) * z * value - (n - 1.0) * before) / n;
        before = value;
        value = next;
      }
      slope = m * (z * value - before) / (z * z - 1);
      z -= value / slope;
    }
    nodes[i] = (1 - z) / 2;
    nodes[m - 1 - i] = (1 + z) / 2;
    weights[i] = weights[m - 1 - i] = 1 / ((1 - z * z) * slope * slope);
  }
}

std::vector<double> bernstein_table(std::span<const double> nodes, Index n) {
  std::vector<double> table;
  for (const double x : nodes) {
    std::vector<double> row(n + 1, 0.0);
    row[0] = 1;
    for (Index r = 1; r <= n; ++r)
      for (Index k = r + 1; k-- > 0;) row[k] = (1 - x) * row[k] + (k > 0 ? x * row[k - 1] : 0);
    table.insert(table.end(), row.begin(), row.end());
  }
  return table;
}

std::vector<double> chebyshev_table(Index degree) {
  const Count count = Count{degree} + 1;
  std::vector<double> cosines(4 * count), nodes(count), table(count * count, 0.0);
  for (Count j = 0; j < cosines.size(); ++j)
    cosines[j] = std::cos(std::numbers::pi * static_cast<double>(j) / (2 * static_cast<double>(count)));
  for (Count j = 0; j < count; ++j) nodes[j] = (1 + cosines[2 * j + 1]) / 2;
  const std::vector<double> values = bernstein_table(nodes, degree);
  for (Count k = 0; k < count; ++k)
    for (Count j = 0; j < count; ++j) {
      const double factor =
          (k == 0 ? 1 : 2) * cosines[k * (2 * j + 1) % cosines.size()] / static_cast<double>(count);
      for (Count i = 0; i < count; ++i) table[k * count + i] += factor * values[j * count + i];
    }
  return table;
}

// f = sum c_k T_k has |f - c_0| <= sum_{k>0} |c_k| rho^k there. To each c_k the rounding that made it is
// added.
Ellipse ellipse_of(std::span<const double> bernstein, std::span<const double> table, double share) {
  const Count count = bernstein.size();
  std::vector<double> c(count, 0.0);
  double largest = 0;
  for (const double b : bernstein) largest = std::max(largest, std::abs(b));
  for (Count k = 0; k < count; ++k) {
    for (Count i = 0; i < count; ++i) c[k] += table[k * count + i] * bernstein[i];
    if (k > 0) c[k] = std::abs(c[k]) + 4 * static_cast<double>(count) * kRoundoff * largest;
  }
  const auto keeps = [&](double rho) {
    double sum = 0;
    for (Count k = count - 1; k > 0; --k) sum = (sum + c[k]) * rho;
    return sum <= share * c[0];
  };
  if (!(c[0] > 0) || !keeps(1)) return {c[0], 1};
  double low = 1, high = 16;  // more would add nothing to the nodes of the rule
  if (keeps(high)) return {c[0], high};
  for (int step = 0; step < 12; ++step) {
    const double middle = std::sqrt(low * high);
    (keeps(middle) ? low : high) = middle;
  }
  return {c[0], low};
}

}  // namespace subdivd

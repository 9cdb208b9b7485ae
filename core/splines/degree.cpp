#include "core/splines/degree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "core/splines/bspline.h"
#include "core/splines/edit.h"
#include "core/splines/knot_insertion.h"

namespace subdivd {
namespace {

// Elevation by one as a matrix: point i of the elevated curve is sum_j weight(i, j) P_{first(i) + j}.
struct Elevation {
  Index degree = 0;             // before
  std::vector<double> knots;    // after
  std::vector<Count> first;     // per row
  std::vector<double> weights;  // degree + 1 per row

  Count rows() const { return first.size(); }
  Count columns() const { return first.back() + degree + 1; }
  std::span<const double> row(Count i) const {
    return std::span(weights).subspan(i * (Count{degree} + 1), Count{degree} + 1);
  }
};

std::vector<double> each_once_more(std::span<const double> knots) {
  std::vector<double> more;
  for (Count i = 0; i < knots.size(); ++i) {
    more.push_back(knots[i]);
    if (i + 1 == knots.size() || knots[i + 1] != knots[i]) more.push_back(knots[i]);
  }
  return more;
}

// Of the spans that are not empty in [first, last), the one nearest to the middle: a blossom's arguments
// around its span make weights that are small.
Count middle_span(std::span<const double> knots, Count first, Count last) {
  const Count middle = (first + last) / 2;
  for (Count away = 0;; ++away) {
    assert(away <= last - first);
    if (const Count j = middle + away; j < last && knots[j] < knots[j + 1]) return j;
    if (const Count j = middle - away; away <= middle && j >= first && knots[j] < knots[j + 1]) return j;
  }
}

// Of a curve that starts and ends at its first and last point.
Result<Elevation> elevation(std::span<const double> knots, Index degree, const Budget& budget) {
  const Index p = degree;
  Elevation matrix{p, each_once_more(knots), {}, {}};
  const Count rows = matrix.knots.size() - p - 2;
  std::vector<double> others(p), weights(p + 1);
  for (Count i = 0; i < rows; ++i) {
    if (i % 256 == 0)
      if (auto stop = budget.poll()) return *stop;
    // Valid on every span of the elevated knots between knot i and knot i + p + 2.
    const Count middle = middle_span(matrix.knots, i, i + p + 2);
    const double inside = matrix.knots[middle];
    const auto span = static_cast<Count>(std::ranges::upper_bound(knots, inside) - knots.begin()) - 1;
    const std::span<const double> all = std::span(matrix.knots).subspan(i + 1, p + 1);
    std::vector<double> mean(p + 1, 0.0);
    for (Index without = 0; without <= p; ++without) {
      std::copy(all.begin(), all.begin() + without, others.begin());
      std::copy(all.begin() + without + 1, all.end(), others.begin() + without);
      blossom_weights(knots, p, span, others, weights);
      for (Index j = 0; j <= p; ++j) mean[j] += weights[j] / (p + 1);
    }
    matrix.first.push_back(span - p);
    matrix.weights.insert(matrix.weights.end(), mean.begin(), mean.end());
  }
  return matrix;
}

Spline elevated(const Spline& spline, const Elevation& matrix) {
  Spline result{spline.degree + 1, spline.width, spline.rational, spline.periodic, matrix.knots, {}};
  result.points.assign(matrix.rows() * spline.width, 0.0);
  for (Count i = 0; i < matrix.rows(); ++i)
    for (Index j = 0; j <= matrix.degree; ++j)
      for (Index k = 0; k < spline.width; ++k)
        result.points[i * spline.width + k] +=
            matrix.row(i)[j] * spline.points[(matrix.first[i] + j) * spline.width + k];
  // Exactly: an end is an end.
  std::copy_n(spline.points.begin(), spline.width, result.points.begin());
  std::copy_n(spline.points.end() - spline.width, spline.width, result.points.end() - spline.width);
  return result;
}

// --- Least squares ----------------------------------------------------------------------------------------

// A symmetric positive definite matrix of n rows and a band: entry (i, i - k) for k = 0 .. band.
class BandMatrix {
 public:
  BandMatrix(Count rows, Index band) : rows_(rows), band_(band), entries_(rows * (Count{band} + 1), 0.0) {}
  double& at(Count i, Count j) { return entries_[i * (Count{band_} + 1) + (i - j)]; }
  double at(Count i, Count j) const { return entries_[i * (Count{band_} + 1) + (i - j)]; }

  // Into its lower factor, L L^T.   [Cholesky]
  void factor() {
    for (Count i = 0; i < rows_; ++i)
      for (Count j = first(i); j <= i; ++j) {
        double sum = at(i, j);
        for (Count k = std::max(first(i), first(j)); k < j; ++k) sum -= at(i, k) * at(j, k);
        at(i, j) = i == j ? std::sqrt(sum) : sum / at(j, j);
      }
  }
  // Of the factor: x in place of the right side, `stride` numbers apart.
  void solve(double* x, Count stride) const {
    for (Count i = 0; i < rows_; ++i) {
      for (Count k = first(i); k < i; ++k) x[i * stride] -= at(i, k) * x[k * stride];
      x[i * stride] /= at(i, i);
    }
    for (Count i = rows_; i-- > 0;) {
      x[i * stride] /= at(i, i);
      for (Count k = first(i); k < i; ++k) x[k * stride] -= at(i, k) * x[i * stride];
    }
  }

 private:
  Count first(Count i) const { return i < band_ ? 0 : i - band_; }
  Count rows_;
  Index band_;
  std::vector<double> entries_;
};

// Points Q with the given ends whose elevation comes closest to `goal`. Inner points only are unknown: column
// j of the matrix is unknown j - 1.
std::vector<double> least_squares(const Elevation& matrix, const Spline& goal) {
  const Index width = goal.width;
  const Count columns = matrix.columns();
  std::vector<double> q(columns * width, 0.0);
  std::copy_n(goal.points.begin(), width, q.begin());
  std::copy_n(goal.points.end() - width, width, q.end() - width);
  if (columns == 2) return q;
  const auto is_inner = [&](Count j) { return j > 0 && j + 1 < columns; };
  BandMatrix normal(columns - 2, matrix.degree);
  for (Count i = 0; i < matrix.rows(); ++i)
    for (Index a = 0; a <= matrix.degree; ++a)
      for (Index b = 0; b <= a; ++b)
        if (const Count ja = matrix.first[i] + a, jb = matrix.first[i] + b; is_inner(ja) && is_inner(jb))
          normal.at(ja - 1, jb - 1) += matrix.row(i)[a] * matrix.row(i)[b];
  normal.factor();
  // Twice more with what is left over: the normal equations square the rounding.
  for (int round = 0; round < 3; ++round) {
    std::vector<double> right((columns - 2) * width, 0.0);
    for (Count i = 0; i < matrix.rows(); ++i)
      for (Index k = 0; k < width; ++k) {
        double left = goal.points[i * width + k];
        for (Index j = 0; j <= matrix.degree; ++j)
          left -= matrix.row(i)[j] * q[(matrix.first[i] + j) * width + k];
        for (Index j = 0; j <= matrix.degree; ++j)
          if (const Count column = matrix.first[i] + j; is_inner(column))
            right[(column - 1) * width + k] += matrix.row(i)[j] * left;
      }
    for (Index k = 0; k < width; ++k) normal.solve(right.data() + k, width);
    for (Count i = 0; i < right.size(); ++i) q[width + i] += right[i];
  }
  return q;
}

}  // namespace

Result<Spline> elevate_degree(const Spline& spline, Index times, const Budget& budget) {
  if (times > kMaxDegree - spline.degree)
    return Error{ErrorCode::out_of_range,
                 "the degree would be " + std::to_string(Count{spline.degree} + times) + "; it can be " +
                     std::to_string(kMaxDegree) + " at most",
                 {"degree"},
                 0,
                 0};
  auto result = part(spline, spline.begin(), spline.end());
  if (!result) return result;
  result->periodic = spline.periodic;
  for (Index k = 0; k < times; ++k) {
    const auto matrix = elevation(result->knots, result->degree, budget);
    if (!matrix) return matrix.error();
    *result = elevated(*result, *matrix);
  }
  return result;
}

Result<Approximation> reduce_degree(const Spline& spline, const Budget& budget) {
  if (spline.degree < 2)
    return Error{ErrorCode::out_of_range, "a curve of degree 1 has no lower degree", {"degree"}, 0, 0};
  auto given = part(spline, spline.begin(), spline.end());
  if (!given) return std::move(given).error();
  // Knots of the answer, and what the given curve lacks to have those of the answer's elevation.
  std::vector<double> knots, lacking;
  for (Count i = 0; i < given->knots.size();) {
    Count next = i;
    while (next < given->knots.size() && given->knots[next] == given->knots[i]) ++next;
    const Count times = std::max<Count>(next - i, 2) - 1;
    knots.insert(knots.end(), times, given->knots[i]);
    if (next - i == 1) lacking.push_back(given->knots[i]);
    i = next;
  }
  const auto goal = refine_knots(*given, lacking, budget);
  if (!goal) return goal.error();
  const auto matrix = elevation(knots, spline.degree - 1, budget);
  if (!matrix) return matrix.error();
  Spline reduced{spline.degree - 1, spline.width,     spline.rational,
                 spline.periodic,   std::move(knots), least_squares(*matrix, *goal)};
  if (auto fine = reduced.check(); !fine)
    return Error{ErrorCode::unsupported,
                 "no curve of one degree less was found near this one: " + fine.error().message,
                 {},
                 0,
                 0};
  const double bound = distance_bound(*goal, elevated(reduced, *matrix));
  return Approximation{std::move(reduced), bound};
}

}  // namespace subdivd

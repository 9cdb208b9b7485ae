#include "core/splines/degree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "core/base/pace.h"
#include "core/splines/bspline.h"
#include "core/splines/edit.h"
#include "core/splines/knot_insertion.h"

namespace subdivd {
namespace {

// Point i of the curve elevated by one is sum_j weights[j] P_{first + j}.
struct ElevatedPoint {
  Count first = 0;
  std::vector<double> weights;  // degree + 1
  // Of the weights, those in [begin, end) are not 0.
  Index begin = 0, end = 0;
};

std::vector<double> each_once_more(std::span<const double> knots, const Pace& pace) {
  std::vector<double> more;
  more.reserve(2 * knots.size());
  pace.for_each(knots.size(), [&](Count i) {
    more.push_back(knots[i]);
    if (i + 1 == knots.size() || knots[i + 1] != knots[i]) more.push_back(knots[i]);
  });
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

// Of a curve that starts and ends at its first and last point, by its knots alone. Points are asked for from
// the first to the last: nothing is looked for twice.
class Elevation {
 public:
  Elevation(std::span<const double> knots, Index degree, const Pace& pace)
      : before_(knots),
        degree_(degree),
        after_(each_once_more(knots, pace)),
        span_(degree),
        others_(degree),
        blossom_(degree + 1),
        pace_(pace) {}

  Index degree() const { return degree_; }
  Count size() const { return after_.size() - degree_ - 2; }
  std::vector<double> take_knots() { return std::move(after_); }

  void weigh(Count i, ElevatedPoint& point) {
    const Index p = degree_;
    // Valid on every span of the elevated knots between knot i and knot i + p + 2.
    const double inside = after_[middle_span(after_, i, i + p + 2)];
    while (span_ > p && before_[span_] > inside) --span_;
    while (before_[span_ + 1] <= inside) ++span_;
    const std::span<const double> all = std::span(after_).subspan(i + 1, p + 1);
    point.first = span_ - p;
    point.weights.assign(p + 1, 0.0);
    point.begin = p + 1, point.end = 0;
    for (Index without = 0; without <= p;) {
      std::copy(all.begin(), all.begin() + without, others_.begin());
      std::copy(all.begin() + without + 1, all.end(), others_.begin() + without);
      const auto [begin, end] = blossom_weights(before_, p, span_, others_, blossom_);
      pace_.spend(2 * Count{p} + (end - begin) * Count{p} / 2);
      point.begin = std::min(point.begin, begin), point.end = std::max(point.end, end);
      // It does not matter which of several equal knots is left out.
      for (Index j = begin; j < end; ++j) blossom_[j] /= p + 1;
      Index next = without;
      for (; next <= p && all[next] == all[without]; ++next)
        for (Index j = begin; j < end; ++j) point.weights[j] += blossom_[j];
      without = next;
    }
  }

 private:
  std::span<const double> before_;
  Index degree_;
  std::vector<double> after_;
  Count span_;  // of the knots before, the one that the last point was weighed on
  std::vector<double> others_, blossom_;
  const Pace& pace_;
};

// Exactly: an end is an end.
void keep_ends(const Spline& spline, Spline& elevated) {
  std::copy_n(spline.points.begin(), spline.width, elevated.points.begin());
  std::copy_n(spline.points.end() - spline.width, spline.width, elevated.points.end() - spline.width);
}

// All of its points, for who needs them more than once.
struct ElevationMatrix {
  Index degree = 0;
  std::vector<Count> first;     // per row
  std::vector<double> weights;  // degree + 1 per row

  Count rows() const { return first.size(); }
  Count columns() const { return first.back() + degree + 1; }
  std::span<const double> row(Count i) const {
    return std::span(weights).subspan(i * (Count{degree} + 1), Count{degree} + 1);
  }
};

// The points alone, without knots.
Spline elevated(const Spline& spline, const ElevationMatrix& matrix, const Pace& pace) {
  Spline result{spline.degree + 1, spline.width, spline.rational, spline.periodic, {}, {}};
  pace.fill(result.points, matrix.rows() * spline.width, 0);
  for (Count i = 0; i < matrix.rows(); ++i) {
    pace.spend(Count{spline.width} * (matrix.degree + 1));
    for (Index j = 0; j <= matrix.degree; ++j)
      for (Index k = 0; k < spline.width; ++k)
        result.points[i * spline.width + k] +=
            matrix.row(i)[j] * spline.points[(matrix.first[i] + j) * spline.width + k];
  }
  keep_ends(spline, result);
  return result;
}

ElevationMatrix matrix_of(Elevation& elevation, const Pace& pace) {
  ElevationMatrix matrix{elevation.degree(), {}, {}};
  matrix.first.reserve(elevation.size());
  matrix.weights.reserve(elevation.size() * (Count{elevation.degree()} + 1));
  ElevatedPoint point;
  for (Count i = 0; i < elevation.size(); ++i) {
    pace.spend(elevation.degree());
    elevation.weigh(i, point);
    matrix.first.push_back(point.first);
    matrix.weights.insert(matrix.weights.end(), point.weights.begin(), point.weights.end());
  }
  return matrix;
}

Spline elevated(const Spline& spline, const Pace& pace) {
  Elevation elevation(spline.knots, spline.degree, pace);
  Spline result{spline.degree + 1, spline.width, spline.rational, spline.periodic, {}, {}};
  const Index width = spline.width;
  result.points.reserve(elevation.size() * width);
  ElevatedPoint point;
  for (Count i = 0; i < elevation.size(); ++i) {
    elevation.weigh(i, point);
    pace.spend(Count{point.end - point.begin} * width);
    result.points.insert(result.points.end(), width, 0.0);
    double* const to = result.points.data() + i * width;
    for (Index j = point.begin; j < point.end; ++j)
      for (Index k = 0; k < width; ++k)
        to[k] += point.weights[j] * spline.points[(point.first + j) * width + k];
  }
  keep_ends(spline, result);
  result.knots = elevation.take_knots();
  return result;
}

// --- Least squares ----------------------------------------------------------------------------------------

// A symmetric positive definite matrix of n rows and a band: entry (i, i - k) for k = 0 .. band.
class BandMatrix {
 public:
  BandMatrix(Count rows, Index band, const Pace& pace) : rows_(rows), band_(band), pace_(pace) {
    pace.fill(entries_, rows * (Count{band} + 1), 0);
  }
  double& at(Count i, Count j) { return entries_[i * (Count{band_} + 1) + (i - j)]; }
  double at(Count i, Count j) const { return entries_[i * (Count{band_} + 1) + (i - j)]; }

  // Into its lower factor, L L^T.   [Cholesky]
  void factor() {
    for (Count i = 0; i < rows_; ++i) {
      pace_.spend(1 + Count{band_} * band_ / 2);
      for (Count j = first(i); j <= i; ++j) {
        double sum = at(i, j);
        for (Count k = std::max(first(i), first(j)); k < j; ++k) sum -= at(i, k) * at(j, k);
        at(i, j) = i == j ? std::sqrt(sum) : sum / at(j, j);
      }
    }
  }
  // Of the factor: x in place of the right side, `stride` numbers apart.
  void solve(double* x, Count stride) const {
    for (Count i = 0; i < rows_; ++i) {
      pace_.spend(1 + band_);
      for (Count k = first(i); k < i; ++k) x[i * stride] -= at(i, k) * x[k * stride];
      x[i * stride] /= at(i, i);
    }
    for (Count i = rows_; i-- > 0;) {
      pace_.spend(1 + band_);
      x[i * stride] /= at(i, i);
      for (Count k = first(i); k < i; ++k) x[k * stride] -= at(i, k) * x[i * stride];
    }
  }

 private:
  Count first(Count i) const { return i < band_ ? 0 : i - band_; }
  Count rows_;
  Index band_;
  const Pace& pace_;
  std::vector<double> entries_;
};

// Points Q with the given ends whose elevation comes closest to `goal`. Inner points only are unknown: column
// j of the matrix is unknown j - 1.
std::vector<double> least_squares(const ElevationMatrix& matrix, const Spline& goal, const Pace& pace) {
  const Index width = goal.width;
  const Count columns = matrix.columns();
  std::vector<double> q;
  pace.fill(q, columns * width, 0);
  std::copy_n(goal.points.begin(), width, q.begin());
  std::copy_n(goal.points.end() - width, width, q.end() - width);
  if (columns == 2) return q;
  const auto is_inner = [&](Count j) { return j > 0 && j + 1 < columns; };
  BandMatrix normal(columns - 2, matrix.degree, pace);
  for (Count i = 0; i < matrix.rows(); ++i) {
    pace.spend(1 + Count{matrix.degree} * matrix.degree / 2);
    for (Index a = 0; a <= matrix.degree; ++a)
      for (Index b = 0; b <= a; ++b)
        if (const Count ja = matrix.first[i] + a, jb = matrix.first[i] + b; is_inner(ja) && is_inner(jb))
          normal.at(ja - 1, jb - 1) += matrix.row(i)[a] * matrix.row(i)[b];
  }
  normal.factor();
  // Twice more with what is left over: the normal equations square the rounding.
  for (int round = 0; round < 3; ++round) {
    std::vector<double> right;
    pace.fill(right, (columns - 2) * width, 0);
    for (Count i = 0; i < matrix.rows(); ++i) {
      pace.spend(Count{width} * (matrix.degree + 1));
      for (Index k = 0; k < width; ++k) {
        double left = goal.points[i * width + k];
        for (Index j = 0; j <= matrix.degree; ++j)
          left -= matrix.row(i)[j] * q[(matrix.first[i] + j) * width + k];
        for (Index j = 0; j <= matrix.degree; ++j)
          if (const Count column = matrix.first[i] + j; is_inner(column))
            right[(column - 1) * width + k] += matrix.row(i)[j] * left;
      }
    }
    for (Index k = 0; k < width; ++k) normal.solve(right.data() + k, width);
    pace.for_each(right.size(), [&](Count i) { q[width + i] += right[i]; });
  }
  return q;
}

// --- Reduction --------------------------------------------------------------------------------------------

// Knots of the curve of one degree less, and what the given one lacks to have those of its elevation.
struct ReducedKnots {
  std::vector<double> knots, lacking;
};

ReducedKnots reduced_knots(std::span<const double> given, const Pace& pace) {
  ReducedKnots reduced;
  reduced.knots.reserve(given.size());
  reduced.lacking.reserve(given.size());
  for (Count i = 0; i < given.size();) {
    Count next = i;
    while (next < given.size() && given[next] == given[i]) ++next;
    pace.spend(next - i);
    const Count times = std::max<Count>(next - i, 2) - 1;
    reduced.knots.insert(reduced.knots.end(), times, given[i]);
    if (next - i == 1) reduced.lacking.push_back(given[i]);
    i = next;
  }
  return reduced;
}

Result<Approximation> reduced(const Spline& given, const Budget& budget, const Pace& pace) {
  ReducedKnots knots = reduced_knots(given.knots, pace);
  auto goal = refine_knots(given, knots.lacking, budget);
  if (!goal) return std::move(goal).error();
  const Index degree = given.degree - 1;
  Elevation elevation(knots.knots, degree, pace);
  const ElevationMatrix matrix = matrix_of(elevation, pace);
  Spline result{degree, given.width, given.rational, given.periodic, {}, least_squares(matrix, *goal, pace)};
  pace.copy(knots.knots, result.knots);
  if (auto fine = result.check(budget); !fine) {
    if (is_stop(fine.error())) return std::move(fine).error();
    return Error{ErrorCode::unsupported,
                 "no curve of one degree less was found near this one: " + fine.error().message};
  }
  const double bound = distance_bound(*goal, elevated(result, matrix, pace), pace);
  return Approximation{std::move(result), bound};
}

// Bytes while the degree of a curve is reduced: its knots and points, those of the curves that are compared,
// and two matrices of as many numbers per point as the degree has.
Count bytes_to_reduce(const Spline& spline) {
  const Count most = 2 * spline.knots.size();
  return most * (2 * Count{spline.degree} + 6 * Count{spline.width} + 8) * sizeof(double);
}

}  // namespace

Result<Spline> elevate_degree(const Spline& spline, Index times, const Budget& budget) {
  if (times > kMaxDegree - spline.degree)
    return Error{ErrorCode::out_of_range,
                 "the degree would be " + std::to_string(Count{spline.degree} + times) + "; it can be " +
                     std::to_string(kMaxDegree) + " at most",
                 {"degree"}};
  auto result = part(spline, spline.begin(), spline.end(), budget);
  if (!result) return result;
  result->periodic = spline.periodic;
  const auto done = stoppable(budget, [&](const Pace& pace) {
    for (Index k = 0; k < times; ++k) *result = elevated(*result, pace);
  });
  if (!done) return done.error();
  return result;
}

Result<Approximation> reduce_degree(const Spline& spline, const Budget& budget) {
  if (spline.degree < 2)
    return Error{ErrorCode::out_of_range, "a curve of degree 1 has no lower degree", {"degree"}};
  if (auto taken = budget.take_memory(bytes_to_reduce(spline)); !taken) return std::move(taken).error();
  auto given = part(spline, spline.begin(), spline.end(), budget);
  if (!given) return std::move(given).error();
  given->periodic = spline.periodic;
  return stoppable(budget, [&](const Pace& pace) { return reduced(*given, budget, pace); });
}

}  // namespace subdivd

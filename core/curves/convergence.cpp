#include "core/curves/convergence.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/pace.h"
#include "core/base/precision.h"
#include "core/curves/lane_riesenfeld.h"
#include "core/curves/subdivision.h"

namespace subdivd {
namespace {

using Place = std::int64_t;
using Rows = std::vector<std::vector<double>>;

constexpr double kTolerance = 2e-9;  // of the squared distance: 1e-9 of the distance
constexpr int kMaxHalvings = 40;

// --- The difference on half an interval -------------------------------------------------------------------

// The blossom of the curve's piece that holds [0, 1/2], for the unit control point `unit` of c_{-m}, ...,
// c_{p-m}, m = floor(p/2): `halves` of its p arguments are 1/2, the others 0. The spline of c_i spans i -
// (p+1)/2 to i + (p+1)/2.   [Ramshaw87; deBoor72]
double blossom_of_unit(int degree, int unit, int halves) {
  std::vector<double> d(static_cast<std::size_t>(degree) + 1, 0);
  d[static_cast<std::size_t>(unit)] = 1;
  const int before = degree / 2;
  for (int r = 1; r <= degree; ++r) {
    const double argument = r <= halves ? 0.5 : 0;
    for (int i = degree; i >= r; --i) {
      const double begin = i - before - (degree + 1) / 2.0;
      const double a = (argument - begin) / (degree + 1 - r);
      const auto at = static_cast<std::size_t>(i);
      d[at] = (1 - a) * d[at - 1] + a * d[at];
    }
  }
  return d.back();
}

// Bezier coefficients of C - P on [0, 1/2] by second differences: coefficient k is the sum over j of
// rows[k][j] D_{j+1-m}, j < p - 1, where D_j = c_{j-1} - 2 c_j + c_{j+1}.
// With weights g_j of c_j (which sum to 0, as do j g_j), those s_j of D_j follow from s_{j+1} - 2 s_j +
// s_{j-1} = g_j: two sums.
Rows difference_rows(int degree) {
  const int m = degree / 2;
  Rows rows;
  for (int k = 0; k <= degree; ++k) {
    const double u = k / (2.0 * degree);
    std::vector<double> row;
    double before = 0, weight = 0;
    for (int j = -m; j + m < degree - 1; ++j) {
      double g = blossom_of_unit(degree, j + m, k);
      if (j == 0) g -= 1 - u;
      if (j == 1) g -= u;
      const double next = g + 2 * weight - before;
      before = weight, weight = next;
      row.push_back(weight);  // of D_{j+1}
    }
    rows.push_back(row);
  }
  return rows;
}

// --- The largest value of |D|^2 ---------------------------------------------------------------------------

double binomial(int n, int k) {
  double value = 1;
  for (int i = 0; i < k; ++i) value = value * (n - i) / (i + 1);
  return value;
}

// Bernstein coefficients of the squared length of a polynomial with `width` components per coefficient:
//   s_k = sum_{i+j=k} binom(p,i) binom(p,j) / binom(2p,k) <b_i, b_j>   [Farin02]
class SquaredLength {
 public:
  explicit SquaredLength(int degree) : degree_(degree) {
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; j <= degree; ++j)
        weights_.push_back(binomial(degree, i) * binomial(degree, j) / binomial(2 * degree, i + j));
  }
  void of(const std::vector<double>& coefficients, Index width, std::vector<double>& squares) const {
    const std::size_t n = static_cast<std::size_t>(degree_) + 1;
    squares.assign(2 * n - 1, 0);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i; j < n; ++j) {
        double product = 0;
        for (Index k = 0; k < width; ++k)
          product += coefficients[i * width + k] * coefficients[j * width + k];
        squares[i + j] += (i == j ? 1 : 2) * weights_[i * n + j] * product;
      }
  }

 private:
  int degree_;
  std::vector<double> weights_;
};

// Raises `best` to the polynomial's maximum on its interval, to kTolerance: values at ends are reached, the
// largest coefficient is a bound; halves whose bound does not matter are left alone.   [LaneRiesenfeld81]
void raise_to_maximum(const std::vector<double>& squares, int halvings, double& best, const Pace& pace) {
  best = std::max({best, squares.front(), squares.back()});
  const double bound = *std::max_element(squares.begin(), squares.end());
  if (bound <= best * (1 + kTolerance) || halvings == kMaxHalvings) return;
  pace.spend(squares.size() * squares.size() / 2);
  std::vector<double> left(squares.size()), right = squares;
  for (std::size_t r = 0; r < squares.size(); ++r) {
    left[r] = right[0];
    for (std::size_t i = 0; i + 1 < squares.size() - r; ++i) right[i] = (right[i] + right[i + 1]) / 2;
  }
  // Whichever end is higher first: the other half is then often under the bound.
  const bool left_first = squares.front() >= squares.back();
  raise_to_maximum(left_first ? left : right, halvings + 1, best, pace);
  raise_to_maximum(left_first ? right : left, halvings + 1, best, pace);
}

// --- Second differences through the levels ----------------------------------------------------------------

// A row of second differences. Of a pinned curve they are odd about both ends, so that a ring of twice their
// number holds all of them: the second half mirrors the first.
struct Differences {
  bool ring = false;
  Place first = 0;  // the place (point index) of values[0]; a ring begins at 0
  Index width = 3;
  std::vector<double> values;
  int exponent = 0;  // the differences are values times 2^exponent

  Place count() const { return static_cast<Place>(values.size() / width); }
  const double* at(Place place) const {
    Place i = place - first;
    if (ring) i = (i % count() + count()) % count();
    return values.data() + static_cast<std::size_t>(i) * width;
  }
};

// Scaled to at most 1, so that squares neither overflow nor vanish.
void normalize(Differences& differences, const Pace& pace) {
  std::vector<double>& values = differences.values;
  double largest = 0;
  pace.for_each(values.size(), [&](Count i) { largest = std::max(largest, std::abs(values[i])); });
  int exponent = 0;
  std::frexp(largest, &exponent);
  pace.for_each(values.size(), [&](Count i) { values[i] = std::ldexp(values[i], -exponent); });
  differences.exponent += exponent;
}

Differences differences_of(const ControlCurves& curves, std::span<const double> points, bool dual,
                           const Pace& pace) {
  const Index width = curves.width;
  const bool pinned = curves.wrap == CurveWrap::pinned, outer = pinned && dual;
  const Place total = static_cast<Place>(points.size() / width), n = outer ? total - 2 : total;
  const bool open = curves.wrap == CurveWrap::nonperiodic;
  Differences result{!open, open ? 1 : 0, width, {}, 0};
  result.values.reserve(points.size() * (pinned ? 2 : 1));
  // Eighths: no difference of differences of doubles outgrows a double.
  const auto c = [&](Place place, Index k) {
    const Place i = outer ? place + 1 : (place + n) % n;
    return points[static_cast<std::size_t>(i) * width + k] / 8;
  };
  const auto end = [&](bool last, Index k) { return points[(last ? points.size() - width : 0) + k] / 8; };
  for (Place place = result.first; place < n - result.first; ++place) {
    pace.spend(2 * Count{width});
    for (Index k = 0; k < width; ++k) {
      const bool at_first = pinned && place == 0, at_last = pinned && place == n - 1;
      if (!outer && (at_first || at_last)) {  // the curve is odd about this point
        result.values.push_back(0);
        continue;
      }
      const double into = at_first ? 2 * (c(place, k) - end(false, k)) : c(place, k) - c(place - 1, k);
      const double out = at_last ? 2 * (end(true, k) - c(place, k)) : c(place + 1, k) - c(place, k);
      result.values.push_back(out - into);
    }
  }
  result.exponent = 3;
  if (pinned)  // primal: places n, n+1, ... mirror n-2, n-3, ... 1; dual: n-1, n-2, ... 0
    for (Place place = outer ? n - 1 : n - 2; place >= (outer ? 0 : 1); --place) {
      pace.spend(width);
      for (Index k = 0; k < width; ++k)
        result.values.push_back(-result.values[static_cast<std::size_t>(place) * width + k]);
    }
  return result;
}

// One step of the scheme of degree p - 2 and a division by 4 (in the exponent). Child m of the differences
// has the place m among the points, but for the missing ones at the front of an open curve.
void refine_differences(int degree, Differences& differences, const Pace& pace) {
  const int lower = degree - 2, h = (lower + 1) / 2;
  // Degree 0 has the mask (1, 1): both children are the point.
  const std::vector<double> mask =
      lower == 0 ? std::vector<double>{1, 1} : lane_riesenfeld_mask(static_cast<Index>(lower));
  const Index width = differences.width;
  const Place n = differences.count(), missing = differences.ring ? 0 : lower / 2;
  const Place children = differences.ring ? 2 * n : 2 * n - lower;
  Differences next{differences.ring, 0, width, {}, differences.exponent - 2};
  pace.fill(next.values, static_cast<std::size_t>(children) * width, 0);
  for (Place place = 0; place < children; ++place) {
    pace.spend(mask.size() * width / 2);
    const Place m = place + missing;
    double* to = next.values.data() + static_cast<std::size_t>(place) * width;
    // Weight k of the mask belongs to the parent i with m - 2i = k - h.
    for (Place k = (m + h) & 1; k <= lower + 1; k += 2) {
      const double* from = differences.at(differences.first + (m + h - k) / 2);
      for (Index c = 0; c < width; ++c) to[c] += mask[static_cast<std::size_t>(k)] * from[c];
    }
  }
  // The row still begins one place inside the points.
  next.first = differences.first;
  differences = std::move(next);
}

// --- One level --------------------------------------------------------------------------------------------

// The places whose half intervals are in the domain, and whether the outer halves of the outermost are.
struct Domain {
  Place begin = 0, end = 0;
  bool outer_halves = false;
};

Domain domain_of(const ControlCurves& curves, Count points, Index level) {
  const bool dual = split_of(curves).dual;
  const Place count = static_cast<Place>(refined_point_count(curves, points, level));
  if (curves.wrap == CurveWrap::periodic) return {0, count, true};
  if (curves.wrap == CurveWrap::pinned) return {0, dual ? count - 2 : count, dual};
  const Place outer = static_cast<Place>(split_of(curves).lost / 2);
  return {outer, count - outer, dual};
}

class LevelMeter {
 public:
  LevelMeter(int degree, const Pace& pace)
      : degree_(degree), pace_(pace), rows_(difference_rows(degree)), squared_(degree) {}

  // The largest distance in units of 2^differences.exponent.
  double largest(const Differences& differences, Domain domain) {
    double best = 0;
    for (Place place = domain.begin; place < domain.end; ++place) {
      if (place + 1 < domain.end || domain.outer_halves) raise(differences, place, 1, best);
      if (place > domain.begin || domain.outer_halves) raise(differences, place, -1, best);
    }
    return std::sqrt(best);
  }

 private:
  // The half interval behind (1) or before (-1) a point: the latter is the former seen from the other side.
  void raise(const Differences& differences, Place place, int side, double& best) {
    const Index width = differences.width;
    pace_.spend(rows_.size() * rows_.size() * (Count{width} + 1) * 2);
    coefficients_.assign((static_cast<std::size_t>(degree_) + 1) * width, 0);
    const int m = degree_ / 2;
    for (std::size_t k = 0; k < rows_.size(); ++k)
      for (std::size_t j = 0; j < rows_[k].size(); ++j) {
        if (rows_[k][j] == 0) continue;
        const double* from = differences.at(place + side * (static_cast<int>(j) + 1 - m));
        for (Index c = 0; c < width; ++c) coefficients_[k * width + c] += rows_[k][j] * from[c];
      }
    squared_.of(coefficients_, width, squares_);
    raise_to_maximum(squares_, 0, best, pace_);
  }

  int degree_;
  const Pace& pace_;
  Rows rows_;
  SquaredLength squared_;
  std::vector<double> coefficients_, squares_;
};

Result<void> check_request(const ControlCurves& curves, Index curve, Index levels, const Budget& budget) {
  if (!std::holds_alternative<UniformBSpline>(curves.basis))
    return Error{ErrorCode::unsupported, "convergence is measured for the basis bspline only", {"basis"}};
  if (curve >= curves.curve_count())
    return Error{
        ErrorCode::out_of_range,
        "there is no curve " + std::to_string(curve) + "; there are " + std::to_string(curves.curve_count()),
        {}};
  if (levels > kMaxCurveLevel)
    return Error{ErrorCode::out_of_range,
                 "level " + std::to_string(levels) + " is over the maximum of " +
                     std::to_string(kMaxCurveLevel) + " for curves",
                 {}};
  const Count points = refined_point_count(curves, curves.points_of_curve(curve), levels);
  if (points > kMostConvergencePoints)
    return Error{.code = ErrorCode::too_large,
                 .message = "the last level would have " + std::to_string(points) + " points; " +
                            std::to_string(kMostConvergencePoints) + " are allowed: ask for fewer levels",
                 .predicted = points,
                 .allowed = kMostConvergencePoints};
  const Count copies = curves.wrap == CurveWrap::pinned ? 4 : 2;
  const Count bytes = points * curves.width * copies * sizeof(double);
  if (auto allowed = budget.check_bytes(bytes); !allowed) return allowed;
  return budget.take_memory(bytes);
}

}  // namespace

Result<Convergence> measure_convergence(const ControlCurves& curves, Index curve, Index levels,
                                        const Budget& budget) {
  Count first = 0;
  for (Index c = 0; c < curve && c < curves.vertex_counts.size(); ++c) first += curves.vertex_counts[c];
  return measure_convergence(curves, curve, first, levels, budget);
}

Result<Convergence> measure_convergence(const ControlCurves& curves, Index curve, Count first, Index levels,
                                        const Budget& budget) {
  if (auto checked = check_request(curves, curve, levels, budget); !checked) return checked.error();
  Convergence result;
  const int degree = static_cast<int>(std::get<UniformBSpline>(curves.basis).degree);
  if (degree == 1) {
    result.distances.assign(levels + Count{1}, 0);
    result.ratios.assign(levels, 0);
    return result;
  }
  return stoppable(budget, [&](const Pace& pace) -> Result<Convergence> {
    const Count points = curves.points_of_curve(curve);
    const std::span<const double> all(curves.points);
    Differences differences = differences_of(curves, all.subspan(first * curves.width, points * curves.width),
                                             degree % 2 == 0, pace);
    normalize(differences, pace);
    LevelMeter meter(degree, pace);
    for (Index level = 0; level <= levels; ++level) {
      if (level > 0) refine_differences(degree, differences, pace);
      const double distance = meter.largest(differences, domain_of(curves, points, level));
      result.distances.push_back(std::ldexp(distance, differences.exponent));
      if (!std::isfinite(result.distances.back())) return does_not_fit();
      if (level == 0) continue;
      const double before = result.distances[level - 1];
      result.ratios.push_back(before > 0 ? result.distances[level] / before : 0);
    }
    return std::move(result);
  });
}

}  // namespace subdivd

#include "core/splines/bspline.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "core/base/all_finite.h"
#include "core/base/precision.h"
#include "core/splines/bezier.h"

namespace subdivd {
namespace {

constexpr std::size_t kMost = kMaxDegree + 1;

// --- Derivatives of the basis -----------------------------------------------------------------------------

// Basis functions of all degrees 0..p on a span, in the upper triangle, and the knot differences that they
// were divided by, in the lower.   [PieglTiller97, A2.3]
struct Triangle {
  std::array<std::array<double, kMost>, kMost> rows;

  Triangle(std::span<const double> knots, Index p, Count span, double t) {
    rows[0][0] = 1;
    for (Index j = 1; j <= p; ++j) {
      double saved = 0;
      for (Index r = 0; r < j; ++r) {
        const double above = knots[span + r + 1], below = knots[span + 1 + r - j];
        rows[j][r] = above - below;
        const double part = rows[r][j - 1] / rows[j][r];
        rows[r][j] = saved + (above - t) * part;
        saved = (t - below) * part;
      }
      rows[j][j] = saved;
    }
  }
};

// Derivatives of basis function r (counted on the span), of order 1 to `order` <= p, without their factors
// p! / (p - d)!.
void derivatives_of_one(const Triangle& triangle, Index p, Index r, Index order, std::span<double> values) {
  std::array<std::array<double, kMost>, 2> a{};
  Index now = 0, before = 1;
  a[now][0] = 1;
  for (Index d = 1; d <= order; ++d) {
    std::swap(now, before);
    double sum = 0;
    const Index rest = p - d;
    if (r >= d) {
      a[now][0] = a[before][0] / triangle.rows[rest + 1][r - d];
      sum = a[now][0] * triangle.rows[r - d][rest];
    }
    const Index first = r + 1 >= d ? 1 : d - r;
    const Index last = r <= rest + 1 ? d - 1 : p - r;
    for (Index j = first; j <= last; ++j) {
      a[now][j] = (a[before][j] - a[before][j - 1]) / triangle.rows[rest + 1][r + j - d];
      sum += a[now][j] * triangle.rows[r + j - d][rest];
    }
    if (r <= rest) {
      a[now][d] = -a[before][d - 1] / triangle.rows[rest + 1][r];
      sum += a[now][d] * triangle.rows[r][rest];
    }
    values[Count{d} * (p + 1) + r] = sum;
  }
}

// The stored points on a span, weighted by one row of basis values.
void combine(const Spline& spline, Count span, std::span<const double> basis, std::span<double> point) {
  std::ranges::fill(point, 0.0);
  for (Index j = 0; j <= spline.degree; ++j) {
    const std::span<const double> control = spline.point(span - spline.degree + j);
    for (Index k = 0; k < spline.width; ++k) point[k] += basis[j] * control[k];
  }
}

// Rows of homogeneous derivatives A^(d), w^(d) into those of the curve.
void divide_by_weight(std::span<const double> stored, Index dimension, Index order, std::span<double> rows) {
  const Index width = dimension + 1;
  const auto weight = [&](Index d) { return stored[Count{d} * width + dimension]; };
  for (Index d = 0; d <= order; ++d)
    for (Index k = 0; k < dimension; ++k) {
      double value = stored[Count{d} * width + k];
      double binomial = 1;
      for (Index i = 1; i <= d; ++i) {
        binomial = binomial * (d - i + 1) / i;
        value -= binomial * weight(i) * rows[Count{d - i} * dimension + k];
      }
      rows[Count{d} * dimension + k] = value / weight(0);
    }
}

}  // namespace

void basis_functions(std::span<const double> knots, Index degree, Count span, double t,
                     std::span<double> values) {
  assert(values.size() == Count{degree} + 1);
  values[0] = 1;
  for (Index j = 1; j <= degree; ++j) {
    double saved = 0;
    for (Index r = 0; r < j; ++r) {
      const double above = knots[span + r + 1], below = knots[span + 1 + r - j];
      const double part = values[r] / (above - below);
      values[r] = saved + (above - t) * part;
      saved = (t - below) * part;
    }
    values[j] = saved;
  }
}

void basis_derivatives(std::span<const double> knots, Index degree, Count span, double t, Index order,
                       std::span<double> values) {
  assert(values.size() == (Count{order} + 1) * (Count{degree} + 1));
  const Triangle triangle(knots, degree, span, t);
  std::ranges::fill(values, 0.0);
  const Index highest = std::min(order, degree);
  for (Index r = 0; r <= degree; ++r) {
    values[r] = triangle.rows[r][degree];
    derivatives_of_one(triangle, degree, r, highest, values);
  }
  double factor = 1;
  for (Index d = 1; d <= highest; ++d) {
    factor *= degree - d + 1;
    for (Index r = 0; r <= degree; ++r) values[Count{d} * (degree + 1) + r] *= factor;
  }
}

Result<void> evaluate(const Spline& spline, double t, std::span<double> point) {
  assert(point.size() == spline.dimension());
  const Result<double> parameter = check_parameter(spline, t);
  if (!parameter) return parameter.error();
  const Count span = find_span(spline, *parameter);
  std::array<double, kMost> basis;
  const std::span<double> values = std::span(basis).first(spline.degree + 1);
  basis_functions(spline.knots, spline.degree, span, *parameter, values);
  if (!spline.rational) {
    combine(spline, span, values, point);
  } else {
    std::vector<double> stored(spline.width);
    combine(spline, span, values, stored);
    for (Index k = 0; k < spline.dimension(); ++k) point[k] = stored[k] / stored[spline.dimension()];
  }
  if (!all_finite(std::span<const double>(point))) return does_not_fit();
  return {};
}

Result<void> derivatives(const Spline& spline, double t, Index order, std::span<double> rows) {
  assert(rows.size() == (Count{order} + 1) * spline.dimension());
  const Result<double> parameter = check_parameter(spline, t);
  if (!parameter) return parameter.error();
  const Count span = find_span(spline, *parameter);
  const Count functions = Count{spline.degree} + 1;
  std::vector<double> basis((Count{order} + 1) * functions);
  basis_derivatives(spline.knots, spline.degree, span, *parameter, order, basis);
  std::vector<double> stored((Count{order} + 1) * spline.width);
  for (Index d = 0; d <= order; ++d)
    combine(spline, span, std::span(basis).subspan(d * functions, functions),
            std::span(stored).subspan(Count{d} * spline.width, spline.width));
  if (spline.rational)
    divide_by_weight(stored, spline.dimension(), order, rows);
  else
    std::ranges::copy(stored, rows.begin());
  if (!all_finite(std::span<const double>(rows))) return does_not_fit();
  return {};
}

// De Boor's triangle from its tip down: what weight the tip gives to every point of a row.
std::pair<Index, Index> blossom_weights(std::span<const double> knots, Index degree, Count span,
                                        std::span<const double> arguments, std::span<double> weights) {
  assert(arguments.size() == degree && weights.size() == Count{degree} + 1);
  std::ranges::fill(weights, 0.0);
  weights[degree] = 1;
  Index first = degree, last = degree;  // of those that are not 0
  for (Index r = degree; r >= 1; --r) {
    for (Index j = first; j <= last; ++j) {
      const double low = knots[span - degree + j], high = knots[span + 1 + j - r];
      const double share = (arguments[r - 1] - low) / (high - low);
      weights[j - 1] += (1 - share) * weights[j];
      weights[j] *= share;
    }
    --first;
    while (first < last && weights[first] == 0) ++first;
    while (first < last && weights[last] == 0) --last;
  }
  return {first, last + 1};
}

// --- Many parameters --------------------------------------------------------------------------------------

// The arrays by their addresses: the compiler cannot know that the points that are written are not among
// them.
struct SplineEvaluator::Search {
  const double* breaks;
  const Index* first_in_cell;
  double cells_per_unit;

  explicit Search(const SplineEvaluator& of)
      : breaks(of.breaks_.data()),
        first_in_cell(of.first_in_cell_.data()),
        cells_per_unit(of.cells_per_unit_) {}

  // By way of a signed number: processors have no instruction for the other.
  Count cell_of(double t) const {
    return static_cast<Count>(static_cast<std::int64_t>((t - breaks[0]) * cells_per_unit));
  }
  // The number, among the spans that are not empty, of the one that holds t. `kFew`: no cell holds more than
  // two breaks; then without a jump, for whether t lies before a break or behind it is a coin toss.
  template <bool kFew>
  [[gnu::always_inline]] Count span_of(double t) const {
    const Count cell = cell_of(t), low = first_in_cell[cell], high = first_in_cell[cell + 1];
    if constexpr (kFew) {
      const Count next = low + static_cast<Count>((low < high) & (breaks[low + 1] <= t));
      return next + static_cast<Count>((next < high) & (breaks[next + 1] <= t));
    }
    return static_cast<Count>(std::upper_bound(breaks + low + 1, breaks + high + 1, t) - breaks) - 1;
  }
};

SplineEvaluator::SplineEvaluator(const Spline& spline)
    : degree_(spline.degree),
      width_(spline.width),
      dimension_(spline.dimension()),
      rational_(spline.rational),
      knots_(spline.knots),
      points_(spline.points) {
  for (Count k = degree_; k < spline.point_count(); ++k) {
    if (!(knots_[k] < knots_[k + 1])) continue;
    breaks_.push_back(knots_[k]);
    spans_.push_back(static_cast<Index>(k));
  }
  breaks_.push_back(spline.end());
  // Finer until a cell holds two breaks at most, but not for ever.
  constexpr Count kFinest = 8;
  for (Count fineness = 1; fineness <= kFinest; fineness *= 2) {
    divide_domain(fineness * spans_.size());
    if (most_in_cell_ <= 2) break;
  }
  if (degree_ == 3 && !rational_) set_cubics(spline);
}

// By the very arithmetic that will look a cell up, so that a break's cell never lies behind its points'.
void SplineEvaluator::divide_domain(Count cells) {
  cells_per_unit_ = static_cast<double>(cells) / (breaks_.back() - breaks_.front());
  first_in_cell_.assign(cells + 2, 0);
  most_in_cell_ = 0;
  Index span = 0;
  const auto last = static_cast<Index>(spans_.size() - 1);
  const Search search(*this);
  for (Count cell = 0; cell < first_in_cell_.size(); ++cell) {
    while (span < last && search.cell_of(breaks_[span + 1]) < cell) ++span;
    first_in_cell_[cell] = span;
    if (cell > 0) most_in_cell_ = std::max(most_in_cell_, span - first_in_cell_[cell - 1]);
  }
}

// From Bezier points b to powers: b_0, 3 (b_1 - b_0), 3 (b_0 - 2 b_1 + b_2), b_3 - 3 b_2 + 3 b_1 - b_0.
void SplineEvaluator::set_cubics(const Spline& spline) {
  cubics_.reserve(spans_.size() * width_ * 4);
  for (const BezierPiece& piece : bezier_pieces(spline)) {
    for (Index k = 0; k < width_; ++k) {
      const double b0 = piece.points[k], b1 = piece.points[width_ + k];
      const double b2 = piece.points[2 * width_ + k], b3 = piece.points[3 * width_ + k];
      const double first = b1 - b0, second = b2 - b1, third = b3 - b2;
      const double bend = second - first;
      cubics_.insert(cubics_.end(), {b0, 3 * first, 3 * bend, (third - second) - bend});
    }
    inverse_lengths_.push_back(1 / (piece.end - piece.begin));
  }
}

template <Index kWidth, bool kFew>
void SplineEvaluator::evaluate_cubic(std::span<const double> ts, std::span<double> points) const {
  const Search search(*this);
  const double *cubics = cubics_.data(), *inverse_lengths = inverse_lengths_.data();
  double* out = points.data();
  for (const double t : ts) {
    const Count span = search.span_of<kFew>(t);
    const double u = (t - search.breaks[span]) * inverse_lengths[span];
    const double* c = cubics + span * (4 * kWidth);
    for (Index k = 0; k < kWidth; ++k, c += 4) *out++ = c[0] + u * (c[1] + u * (c[2] + u * c[3]));
  }
}

void SplineEvaluator::evaluate_any(std::span<const double> ts, std::span<double> points) const {
  std::array<double, kMost> basis;
  const std::span<double> values = std::span(basis).first(degree_ + 1);
  std::vector<double> stored(width_);
  double* out = points.data();
  const Search search(*this);
  for (const double t : ts) {
    const Count span = spans_[search.span_of<false>(t)];
    basis_functions(knots_, degree_, span, t, values);
    std::ranges::fill(stored, 0.0);
    const double* control = points_.data() + (span - degree_) * width_;
    for (const double weight : values)
      for (Index k = 0; k < width_; ++k) stored[k] += weight * *control++;
    const double divisor = rational_ ? stored[dimension_] : 1;
    for (Index k = 0; k < dimension_; ++k) *out++ = stored[k] / divisor;
  }
}

void SplineEvaluator::evaluate(std::span<const double> ts, std::span<double> points) const {
  assert(points.size() == ts.size() * dimension_);
  const bool few = most_in_cell_ <= 2;
  if (!cubics_.empty() && width_ == 3)
    return few ? evaluate_cubic<3, true>(ts, points) : evaluate_cubic<3, false>(ts, points);
  if (!cubics_.empty() && width_ == 2)
    return few ? evaluate_cubic<2, true>(ts, points) : evaluate_cubic<2, false>(ts, points);
  evaluate_any(ts, points);
}

}  // namespace subdivd

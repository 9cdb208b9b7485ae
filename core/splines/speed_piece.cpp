#include "core/splines/speed_piece.h"

#include <algorithm>
#include <cmath>

namespace subdivd {
namespace {

// De Casteljau's triangle: the points left of u where `keep_left`, else those right of it.
void cut(std::vector<double>& points, Index width, double u, bool keep_left) {
  const Count count = points.size() / width;
  for (Count r = 1; r < count; ++r)
    for (Count i = 0; i < count - r; ++i) {
      // Towards the left end the triangle is walked from its right side, so that what is kept stays in place.
      const Count to = keep_left ? count - 1 - i : i;
      const Count left = keep_left ? to - 1 : to;
      for (Index k = 0; k < width; ++k)
        points[to * width + k] = (1 - u) * points[left * width + k] + u * points[(left + 1) * width + k];
    }
}

}  // namespace

// Rounding of the points is relative to the extent of what they were combined from, so a term of N may be
// wrong by roundings of p * extent, whatever its own size.
SpeedPiece Ruler::piece_of(const LocalSpline& local) const {
  pace_.spend(Count{p_ + 1} * (p_ + 1) * (dimension_ + 1));
  const std::vector<BezierPiece> pieces = bezier_pieces(local.spline);
  const BezierPiece& bezier = pieces.front();
  const double reach = p_ * extent(local.spline);
  SpeedPiece piece;
  piece.derivative = {bezier.begin, bezier.end, std::vector<double>(Count{n_ + 1} * row_width(), 0.0)};
  std::vector<double>& rows = piece.derivative.points;
  std::vector<double> points(Count{p_ + 1} * dimension_);
  const std::span<const double> stored(bezier.points);
  const Index width = local.spline.width;
  for (Count i = 0; i <= p_; ++i)
    project(stored.subspan(i * width, width), rational_,
            std::span(points).subspan(i * dimension_, dimension_));
  const auto add = [&](Count k, double factor, Count to, Count from) {
    double* row = &rows[k * row_width()];
    for (Index x = 0; x < dimension_; ++x)
      row[x] += factor * p_ * (points[to * dimension_ + x] - points[from * dimension_ + x]);
    row[dimension_] += factor * reach;
  };
  if (!rational_) {
    for (Index i = 0; i < p_; ++i) add(i, 1, i + 1, i);
    return piece;
  }
  piece.weight = {bezier.begin, bezier.end, {}};
  for (Count i = 0; i <= p_; ++i) piece.weight.points.push_back(stored[i * width + dimension_]);
  // |C'| does not change with all weights together; near 1 their products are safe.
  const double largest = *std::ranges::max_element(piece.weight.points);
  for (double& weight : piece.weight.points) weight /= largest;
  for (Index i = 0; i < p_; ++i)
    for (Index j = 0; j < p_; ++j)
      add(i + j, pair_weights_[i * p_ + j] * piece.weight.points[i + 1] * piece.weight.points[j], i + 1, j);
  return piece;
}

std::array<SpeedPiece, 2> Ruler::halves(const SpeedPiece& piece) const {
  pace_.spend(Count{n_ + 1} * (n_ + 1) * row_width() / 2);
  auto derivative = subdivd::halves(piece.derivative, row_width());
  std::array<SpeedPiece, 2> both;
  for (Index side = 0; side < 2; ++side) {
    both[side].derivative = std::move(derivative[side]);
    both[side].width = piece.width / 2;
    both[side].level = piece.level + 1;
  }
  if (!rational_) return both;
  auto weight = subdivd::halves(piece.weight, 1);
  for (Index side = 0; side < 2; ++side) both[side].weight = std::move(weight[side]);
  return both;
}

SpeedPiece Ruler::part(const SpeedPiece& piece, double from, double to) const {
  pace_.spend(Count{n_ + 1} * (n_ + 1) * row_width());
  SpeedPiece result = piece;
  const auto cut_both = [&](double u, bool keep_left) {
    cut(result.derivative.points, row_width(), u, keep_left);
    if (rational_) cut(result.weight.points, 1, u, keep_left);
  };
  if (to < 1) cut_both(to, true);
  if (from > 0) cut_both(from / to, false);
  result.width = piece.width * (to - from);
  result.level = piece.level + 2;
  return result;
}

double Ruler::length_of_row(const SpeedPiece& piece, Count i) const {
  const double* row = &piece.derivative.points[i * row_width()];
  double square = 0;
  for (Index x = 0; x < dimension_; ++x) square += row[x] * row[x];
  return std::sqrt(square);
}

double Ruler::speed_at_end(const SpeedPiece& piece) const {
  const double weight = rational_ ? piece.weight.points.back() : 1;
  return length_of_row(piece, n_) / (weight * weight);
}

// Bernstein coefficients of |N|^2, degree 2n.
std::vector<double> Ruler::square_of(const SpeedPiece& piece) const {
  std::vector<double> q(2 * Count{n_} + 1, 0.0);
  for (Count i = 0; i <= n_; ++i) {
    pace_.spend((Count{n_} + 1) * dimension_);
    for (Count j = 0; j <= n_; ++j) {
      const double* a = &piece.derivative.points[i * row_width()];
      const double* b = &piece.derivative.points[j * row_width()];
      double product = 0;
      for (Index x = 0; x < dimension_; ++x) product += a[x] * b[x];
      q[i + j] += square_weights_[i * (n_ + 1) + j] * product;
    }
  }
  return q;
}

// How much Gauss's rule errs at most on |N| / w^2, or nothing where that cannot be said.
// In an ellipse where |q - mean_q| < mean_q for q = |N|^2 and |w - mean_w| <= mean_w / 2, the function is
// analytic and at most M = sqrt(2 mean_q) 4 / mean_w^2. Polynomials of degree 2m - 1 come as close to it as
// 2 M rho^-(2m-1) / (rho - 1) on the piece; the rule is exact for them, and its weights are positive and sum
// to 1, so that it errs by twice that at most.   [Trefethen13, theorems 8.2 and 19.3]
std::optional<double> Ruler::gauss_error(const SpeedPiece& piece) const {
  const Ellipse of_square = ellipse_of(square_of(piece), square_chebyshev_, 0.99);
  double rho = of_square.rho, most = std::sqrt(2 * of_square.mean);
  if (rational_) {
    const Ellipse of_weight = ellipse_of(piece.weight.points, weight_chebyshev_, 0.5);
    rho = std::min(rho, of_weight.rho);
    most *= 4 / (of_weight.mean * of_weight.mean);
  }
  if (!(rho > 1)) return std::nullopt;
  const double exact_degree = 2 * static_cast<double>(rule_.nodes.size()) - 1;
  return 4 * most * std::pow(rho, -exact_degree) / (rho - 1);
}

double Ruler::gauss_sum(const SpeedPiece& piece) const {
  double sum = 0;
  for (Count i = 0; i < rule_.nodes.size(); ++i) {
    pace_.spend((Count{n_} + 1) * dimension_);
    const double* basis = &derivative_table_[i * (n_ + 1)];
    double square = 0, weight = rational_ ? 0 : 1;
    for (Index x = 0; x < dimension_; ++x) {
      double value = 0;
      for (Count k = 0; k <= n_; ++k) value += basis[k] * piece.derivative.points[k * row_width() + x];
      square += value * value;
    }
    if (rational_)
      for (Count k = 0; k <= p_; ++k) weight += weight_table_[i * (p_ + 1) + k] * piece.weight.points[k];
    sum += rule_.weights[i] * std::sqrt(square) / (weight * weight);
  }
  return sum;
}

// The rounding term: making the control points (8 p operations, on either side of a difference), halving (n
// per level), the table of the rule and its nodes (8 n), each relative to what |N| could have been; and the
// sum of the rule, relative to the length.
Interval Ruler::measure(const SpeedPiece& piece) const {
  double least_weight = 1, most_weight = 1, scale = 0, lengths = 0, square = 0;
  if (rational_) {
    least_weight = *std::ranges::min_element(piece.weight.points);
    most_weight = *std::ranges::max_element(piece.weight.points);
  }
  for (Count i = 0; i <= n_; ++i) {
    lengths += length_of_row(piece, i);
    scale = std::max(scale, piece.derivative.points[i * row_width() + dimension_]);
  }
  for (Index x = 0; x < dimension_; ++x) {
    double sum = 0;
    for (Count i = 0; i <= n_; ++i) sum += piece.derivative.points[i * row_width() + x];
    square += sum * sum;
  }
  Interval length;
  length.low = std::sqrt(square) / (n_ + 1) / (most_weight * most_weight);
  length.high = std::max(length.low, lengths / (n_ + 1) / (least_weight * least_weight));
  if (const auto error = gauss_error(piece)) {
    const double sum = gauss_sum(piece);
    // Where rounding lets the two intervals miss one another, the ends meet in the old one.
    length.low = std::clamp(sum - *error, length.low, length.high);
    length.high = std::clamp(sum + *error, length.low, length.high);
  }
  length.rounding =
      kRoundoff * ((16 * p_ + (2 * piece.level + 8) * n_) * scale / (least_weight * least_weight) +
                   4.0 * static_cast<double>(rule_.nodes.size()) * length.high);
  length.uneven = most_weight > 2 * least_weight;
  length.low *= piece.width, length.high *= piece.width, length.rounding *= piece.width;
  return length;
}

}  // namespace subdivd

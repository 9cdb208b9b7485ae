#include "core/curves/arc_length.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>

#include "core/curves/bezier.h"
#include "core/curves/bounds.h"
#include "core/curves/precision.h"

namespace subdivd {
namespace {

constexpr Count kPollInterval = 64;  // pieces between two looks at the budget

std::string brief(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", value);
  return text;
}

Error refusal(ErrorCode code, std::string message, Path where) {
  return Error{code, std::move(message), std::move(where), 0, 0};
}

// --- Pieces -----------------------------------------------------------------------------------------------

// What the length of a piece is made of:  |C'(u)| = |N(u)| / w(u)^2  on 0 <= u <= 1, times `width`.
//   polynomial   N_i = p (P_{i+1} - P_i), degree p - 1, no weights
//   rational     N = p (A1 w0 - A0 w1), degree 2p - 2, where A0, A1 and w0, w1 are the first and the last p
//                control points and weights:  N_k = p sum_{i+j=k} b_ij w_{i+1} w_j (P_{i+1} - P_j)
//                [Floater92]
// Halving differences instead of points keeps rounding relative to the piece, however short it gets.
struct SpeedPiece {
  BezierPiece
      derivative;      // rows of dimension + 1: N, and the scale of its rounding (what |N| could have been)
  BezierPiece weight;  // empty where the curve is polynomial
  double width = 1;    // length of the piece's interval on that of its span, in the unit of the whole
  Index level = 0;
};

// An interval that contains a length, and the rounding that may have gone into its ends.
struct Interval {
  double low = 0, high = 0, rounding = 0;
  bool uneven = false;  // weights differ so much that halving makes the rounding less, too
  double middle() const { return low / 2 + high / 2; }
  double half() const { return (high - low) / 2; }
  // What halving the piece can make less.
  double gain() const { return half() + (uneven ? rounding : 0); }
};

// Gauss-Legendre nodes x and weights on [0, 1], by Newton's method on the recurrence of Legendre polynomials.
//   [Trefethen13, chapter 19]
struct GaussRule {
  std::vector<double> nodes, weights;

  explicit GaussRule(Index m) : nodes(m), weights(m) {
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
};

// B_k(x) of degree n at every node, n + 1 numbers each.
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

// From Bernstein to Chebyshev coefficients: row k holds the k-th ones of B_0, ..., B_D, as polynomials of
// degree D are interpolated in the D + 1 zeros of T_{D+1}.   [Trefethen13, chapter 3]
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

// An ellipse around [0, 1], with foci at its ends and axes of rho +- 1/rho over 2, inside which a polynomial
// f keeps to |f - mean| <= share * mean. rho is 1 where there is none.
struct Ellipse {
  double mean = 0, rho = 1;
};

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

// Measures pieces of one kind: the tables depend on degree, dimension and whether there are weights.
class Ruler {
 public:
  explicit Ruler(const Spline& spline)
      : p_(spline.degree),
        dimension_(spline.dimension()),
        rational_(spline.rational),
        n_(rational_ ? 2 * p_ - 2 : p_ - 1),
        rule_(3 * n_ + 12),
        derivative_table_(bernstein_table(rule_.nodes, n_)),
        weight_table_(rational_ ? bernstein_table(rule_.nodes, p_) : std::vector<double>{}),
        square_weights_(product_weights(n_)),
        square_chebyshev_(chebyshev_table(2 * n_)),
        weight_chebyshev_(rational_ ? chebyshev_table(p_) : std::vector<double>{}),
        pair_weights_(rational_ ? product_weights(p_ - 1) : std::vector<double>{}) {}

  SpeedPiece piece_of(const LocalSpline& local) const;
  std::array<SpeedPiece, 2> halves(const SpeedPiece& piece) const;
  // The part of it from u = `from` to u = `to`, 0 <= from <= to <= 1; its parameters are not kept.
  SpeedPiece part(const SpeedPiece& piece, double from, double to) const;
  Interval measure(const SpeedPiece& piece) const;
  double speed_at_end(const SpeedPiece& piece) const;

 private:
  Index row_width() const { return dimension_ + 1; }
  double length_of_row(const SpeedPiece& piece, Count i) const;
  std::vector<double> square_of(const SpeedPiece& piece) const;
  std::optional<double> gauss_error(const SpeedPiece& piece) const;
  double gauss_sum(const SpeedPiece& piece) const;

  Index p_, dimension_;
  bool rational_;
  Index n_;  // degree of N
  GaussRule rule_;
  std::vector<double> derivative_table_, weight_table_, square_weights_;
  std::vector<double> square_chebyshev_, weight_chebyshev_, pair_weights_;
};

// Rounding of the points is relative to the extent of what they were combined from, so a term of N may be
// wrong by roundings of p * extent, whatever its own size.
SpeedPiece Ruler::piece_of(const LocalSpline& local) const {
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

SpeedPiece Ruler::part(const SpeedPiece& piece, double from, double to) const {
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
  for (Count i = 0; i <= n_; ++i)
    for (Count j = 0; j <= n_; ++j) {
      const double* a = &piece.derivative.points[i * row_width()];
      const double* b = &piece.derivative.points[j * row_width()];
      double product = 0;
      for (Index x = 0; x < dimension_; ++x) product += a[x] * b[x];
      q[i + j] += square_weights_[i * (n_ + 1) + j] * product;
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

// --- A curve in measured pieces ---------------------------------------------------------------------------

struct Measured {
  SpeedPiece piece;
  Interval length;
  // Of a heap whose front gains most by halving; the parameter makes the order unique.
  bool operator<(const Measured& other) const {
    const double mine = length.gain(), others = other.length.gain();
    return mine != others ? mine < others : piece.derivative.begin > other.piece.derivative.begin;
  }
};

struct Survey {
  std::vector<Measured> pieces;  // a heap, until put in order
  int exponent = 0;              // lengths are times 2^exponent
  double length = 0, bound = 0;
};

void add_up(Survey& survey) {
  survey.length = survey.bound = 0;
  for (const Measured& one : survey.pieces) {
    survey.length += one.length.middle();
    survey.bound += one.length.half() + one.length.rounding;
  }
  survey.bound += static_cast<double>(survey.pieces.size()) * kRoundoff * (survey.length + survey.bound);
}

// The spans between a and b as they are, each in coordinates of its own, so that rounding is relative to it.
Result<Survey> first_survey(const Spline& spline, const Ruler& ruler, double a, double b,
                            const Budget& budget) {
  Survey survey;
  std::vector<int> exponents;
  const Count first = find_span(spline, a), last = find_span(spline, b);
  for (Count span = first; span <= last; ++span) {
    const double begin = spline.knots[span], end = spline.knots[span + 1];
    const double from = std::max(a, begin), to = std::min(b, end);
    if (!(from < to)) continue;
    if (survey.pieces.size() % kPollInterval == 0)
      if (auto stop = budget.poll()) return *stop;
    const Result<LocalSpline> local = localized(window(spline, span));
    if (!local) return local.error();
    SpeedPiece piece = ruler.piece_of(*local);
    if (from > begin || to < end) {
      piece = ruler.part(piece, (from - begin) / (end - begin), (to - begin) / (end - begin));
      piece.derivative.begin = from;
      piece.derivative.end = to;
      piece.width = (to - from) / (end - begin);
    }
    survey.pieces.push_back({std::move(piece), {}});
    exponents.push_back(local->exponent);
  }
  if (exponents.empty()) return survey;
  survey.exponent = *std::ranges::max_element(exponents);
  for (Count i = 0; i < exponents.size(); ++i) {
    Measured& one = survey.pieces[i];
    one.piece.width = std::ldexp(one.piece.width, exponents[i] - survey.exponent);
    one.length = ruler.measure(one.piece);
  }
  return survey;
}

Error not_reached(const Survey& survey, const LengthOptions& options, bool by_rounding) {
  const double reached = survey.bound / survey.length;
  std::string message = "the length is known to " + (std::isfinite(reached) ? brief(reached) : "no part") +
                        " of itself after " + std::to_string(survey.pieces.size()) + " pieces, ";
  message += by_rounding ? "and rounding allows no better"
                         : "and " + std::to_string(options.max_pieces) + " pieces are allowed";
  message += "; a tolerance of " + brief(options.tolerance) + " was asked for: choose a larger one";
  Error error = refusal(by_rounding ? ErrorCode::out_of_range : ErrorCode::too_large, std::move(message),
                        {"tolerance"});
  if (!by_rounding) {
    error.predicted = survey.pieces.size() + 1;
    error.allowed = options.max_pieces;
  }
  return error;
}

Result<Survey> survey_of(const Spline& spline, const Ruler& ruler, double a, double b,
                         const LengthOptions& options, const Budget& budget) {
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
    return refusal(ErrorCode::out_of_range, "the tolerance must be a finite number above 0", {"tolerance"});
  Result<Survey> surveyed = first_survey(spline, ruler, a, b, budget);
  if (!surveyed) return surveyed;
  Survey& survey = *surveyed;
  std::make_heap(survey.pieces.begin(), survey.pieces.end());
  add_up(survey);
  double running = survey.bound;  // kept up to date piece by piece; add_up has the last word
  for (Count steps = 1;; ++steps) {
    if (running <= options.tolerance * survey.length || steps % 4096 == 0) {
      add_up(survey);
      running = survey.bound;
      if (survey.bound <= options.tolerance * survey.length) return surveyed;
    }
    // A piece that halving no longer helps has an interval of the size of its rounding.
    const Measured& widest = survey.pieces.front();
    const bool by_rounding = !widest.length.uneven && widest.length.half() <= widest.length.rounding;
    if (by_rounding || survey.pieces.size() >= options.max_pieces) {
      add_up(survey);
      if (survey.bound <= options.tolerance * survey.length) return surveyed;
      return not_reached(survey, options, by_rounding);
    }
    if (steps % kPollInterval == 0)
      if (auto stop = budget.poll()) return *stop;
    std::pop_heap(survey.pieces.begin(), survey.pieces.end());
    const Measured old = std::move(survey.pieces.back());
    survey.pieces.pop_back();
    running -= old.length.half() + old.length.rounding;
    survey.length -= old.length.middle();
    for (SpeedPiece& half : ruler.halves(old.piece)) {
      const Interval length = ruler.measure(half);
      running += length.half() + length.rounding;
      survey.length += length.middle();
      survey.pieces.push_back({std::move(half), length});
      std::push_heap(survey.pieces.begin(), survey.pieces.end());
    }
  }
}

// --- Parameters -------------------------------------------------------------------------------------------

// Pieces in the order of the curve, and how long it is up to the end of each.
struct Milestones {
  Survey survey;
  std::vector<double> ends;

  explicit Milestones(Survey made) : survey(std::move(made)) {
    std::ranges::sort(survey.pieces, {}, [](const Measured& one) { return one.piece.derivative.begin; });
    double sum = 0;
    for (const Measured& one : survey.pieces) ends.push_back(sum += one.length.middle());
  }
  double total() const { return ends.empty() ? 0 : ends.back(); }
};

// Newton's method for the length from the piece's begin to u, with bisection where it would leave what
// brackets the answer. The part is measured as its piece has been: its chord and polygon are closer together
// than those of the whole; that its Gauss interval is no wider either is tested, not proved.
double share_at_length(const Ruler& ruler, const Measured& one, double length, double accuracy) {
  double low = 0, high = 1, u = std::clamp(length / one.length.middle(), 0.0, 1.0);
  for (int step = 0; step < 100 && low < u && u < high; ++step) {
    const SpeedPiece part = ruler.part(one.piece, 0, u);
    const double excess = ruler.measure(part).middle() - length;
    if (std::abs(excess) <= accuracy) return u;
    (excess > 0 ? high : low) = u;
    const double slope = one.piece.width * ruler.speed_at_end(part);
    const double next = u - excess / slope;
    u = next > low && next < high ? next : low / 2 + high / 2;  // also where the slope is 0
  }
  return u;
}

double parameter_at(const Ruler& ruler, const Milestones& milestones, double length) {
  const auto found = std::ranges::lower_bound(milestones.ends, length);
  const Count i =
      std::min<Count>(static_cast<Count>(found - milestones.ends.begin()), milestones.ends.size() - 1);
  const Measured& one = milestones.survey.pieces[i];
  const double begin = one.piece.derivative.begin, end = one.piece.derivative.end;
  const double rest = length - (i == 0 ? 0 : milestones.ends[i - 1]);
  if (!(rest > 0)) return begin;
  if (length >= milestones.ends[i]) return end;
  const double u = share_at_length(ruler, one, rest, 4 * kRoundoff * milestones.total());
  return std::clamp(begin + u * (end - begin), begin, end);
}

}  // namespace

Result<ArcLength> arc_length(const Spline& spline, double a, double b, const LengthOptions& options,
                             const Budget& budget) {
  if (!(a >= spline.begin() && a <= spline.end()))
    return refusal(ErrorCode::out_of_range, "the length must be asked for from within the curve's domain",
                   {"from"});
  if (!(b >= a && b <= spline.end()))
    return refusal(
        ErrorCode::out_of_range,
        "the length must be asked for up to the same or a later parameter within the curve's domain", {"to"});
  const Ruler ruler(spline);
  const Result<Survey> survey = survey_of(spline, ruler, a, b, options, budget);
  if (!survey) return survey.error();
  const double length = std::ldexp(survey->length, survey->exponent);
  const double bound = std::ldexp(survey->bound, survey->exponent);
  if (!std::isfinite(length) || !std::isfinite(bound)) return does_not_fit();
  return ArcLength{length, bound, survey->pieces.size()};
}

Result<ArcLength> arc_length(const Spline& spline, const LengthOptions& options, const Budget& budget) {
  return arc_length(spline, spline.begin(), spline.end(), options, budget);
}

Result<double> parameter_at_length(const Spline& spline, double length, const LengthOptions& options,
                                   const Budget& budget) {
  if (!std::isfinite(length))
    return refusal(ErrorCode::not_finite, "the length is not a finite number", {"length"});
  const Ruler ruler(spline);
  Result<Survey> survey = survey_of(spline, ruler, spline.begin(), spline.end(), options, budget);
  if (!survey) return survey.error();
  const double bound = survey->bound;
  const Milestones milestones(*std::move(survey));
  const double wanted = std::ldexp(length, -milestones.survey.exponent);
  if (!(wanted >= 0 && wanted <= milestones.total() + bound))
    return refusal(ErrorCode::out_of_range,
                   "the length must be 0 to that of the curve, " +
                       brief(std::ldexp(milestones.total(), milestones.survey.exponent)),
                   {"length"});
  if (wanted >= milestones.total() && wanted > 0) return spline.end();
  return parameter_at(ruler, milestones, wanted);
}

Result<std::vector<double>> equal_parameters(const Spline& spline, Count count, const LengthOptions& options,
                                             const Budget& budget) {
  const Count least = spline.periodic ? 1 : 2;
  if (count < least || count > kMaxIndexCount)
    return refusal(ErrorCode::out_of_range,
                   "there must be " + std::to_string(least) + " to " + std::to_string(kMaxIndexCount) +
                       " parameters; " + std::to_string(count) + " were asked for",
                   {"count"});
  if (auto allowed = budget.check_bytes(count * sizeof(double)); !allowed) return allowed.error();
  const Ruler ruler(spline);
  Result<Survey> survey = survey_of(spline, ruler, spline.begin(), spline.end(), options, budget);
  if (!survey) return survey.error();
  const Milestones milestones(*std::move(survey));
  const double total = milestones.total(), begin = spline.begin(), end = spline.end();
  const double steps = static_cast<double>(spline.periodic ? count : count - 1);
  std::vector<double> parameters;
  parameters.reserve(count);
  for (Count i = 0; i < count; ++i) {
    if (i % kPollInterval == 0)
      if (auto stop = budget.poll()) return *stop;
    const double share = static_cast<double>(i) / steps;
    if (i == 0)
      parameters.push_back(begin);
    else if (!spline.periodic && i + 1 == count)
      parameters.push_back(end);
    else
      parameters.push_back(total > 0 ? parameter_at(ruler, milestones, share * total)
                                     : begin + share * (end - begin));
  }
  // Neighbours closer than the accuracy may have come out in the wrong order.
  for (Count i = 1; i < count; ++i) parameters[i] = std::max(parameters[i], parameters[i - 1]);
  return parameters;
}

}  // namespace subdivd

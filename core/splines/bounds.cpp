#include "core/splines/bounds.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/precision.h"
#include "core/splines/growing_memory.h"
#include "core/splines/measurement.h"

namespace subdivd {
namespace {

constexpr int kLeastWeightExponent = -500;
// Halving evens out weights by one power of two at a time; 53 more reach the last bit of the coordinates.
constexpr Index kMaxDepth = 640;

int exponent_of(double value) { return value > 0 ? std::ilogb(value) + 1 : 0; }

Box box_of(std::span<const double> points, Index dimension) {
  Box box{{points.begin(), points.begin() + dimension}, {points.begin(), points.begin() + dimension}};
  for (Count i = 0; i < points.size(); ++i) {
    const Count k = i % dimension;
    box.low[k] = std::min(box.low[k], points[i]);
    box.high[k] = std::max(box.high[k], points[i]);
  }
  return box;
}

// Brings the largest weight into [1/2, 1); the coordinates, which are times the weight, follow.
Result<int> weight_exponent(const Spline& spline) {
  if (!spline.rational) return 0;
  const std::vector<double> all = weights(spline);
  const int exponent = exponent_of(*std::ranges::max_element(all));
  for (Count i = 0; i < all.size(); ++i)
    if (exponent_of(all[i]) - exponent < kLeastWeightExponent)
      return Error{ErrorCode::out_of_range,
                   "weight " + std::to_string(i) + " is less than 2^" + std::to_string(kLeastWeightExponent) +
                       " of the largest; weights that far apart cannot be measured with",
                   {"pointWeights", std::uint64_t{i}},
                   0,
                   0};
  return exponent;
}

// --- The highest point of one coordinate ------------------------------------------------------------------

// A piece of one coordinate, and what it does not exceed.
struct Slope {
  double top;
  Index depth;
  BezierPiece piece;
  bool operator<(const Slope& other) const { return top < other.top; }
};

// Largest of +-x_i, projected. The curve is inside the hull of its control points.
double top_of(const BezierPiece& piece, Index width) {
  double top = piece.points[0] / (width == 2 ? piece.points[1] : 1);
  for (Count i = width; i < piece.points.size(); i += width)
    top = std::max(top, piece.points[i] / (width == 2 ? piece.points[i + 1] : 1));
  return top;
}

// The higher of its ends, which the curve attains.
double attained_by(const BezierPiece& piece, Index width) {
  const Count last = piece.points.size() - width;
  if (width == 1) return std::max(piece.points[0], piece.points[last]);
  return std::max(piece.points[0] / piece.points[1], piece.points[last] / piece.points[last + 1]);
}

// Coordinate k alone, times `sign`.
BezierPiece coordinate_of(const BezierPiece& piece, const Spline& spline, Index k, double sign) {
  BezierPiece one{piece.begin, piece.end, {}};
  for (Count i = 0; i < piece.points.size(); i += spline.width) {
    one.points.push_back(sign * piece.points[i + k]);
    if (spline.rational) one.points.push_back(piece.points[i + spline.width - 1]);
  }
  return one;
}

// The largest value of sign * coordinate k, from above, to within the rounding of halving: halves the piece
// that could reach highest until none could reach more than has been attained.
Result<double> highest(const Spline& local, std::span<const BezierPiece> pieces, Index k, double sign,
                       const Budget& budget, GrowingMemory& memory) {
  const Index width = local.rational ? 2 : 1;
  const double tolerance = 8 * (local.degree + 1) * kRoundoff;
  double attained = -1;
  std::vector<Slope> heap;
  Count steps = 0;
  const auto consider = [&](BezierPiece piece, Index depth) {
    attained = std::max(attained, attained_by(piece, width));
    const double top = top_of(piece, width);
    if (!(top > attained)) return;
    heap.push_back({top, depth, std::move(piece)});
    std::push_heap(heap.begin(), heap.end());
  };
  for (const BezierPiece& piece : pieces) {
    if (steps++ % kPiecesPerPoll == 0)
      if (auto stop = budget.poll()) return *stop;
    if (auto taken = memory.hold(heap.size() + 1); !taken) return taken.error();
    consider(coordinate_of(piece, local, k, sign), 0);
  }
  while (!heap.empty() && heap.front().top > attained + tolerance && heap.front().depth < kMaxDepth) {
    if (steps++ % kPiecesPerPoll == 0)
      if (auto stop = budget.poll()) return *stop;
    std::pop_heap(heap.begin(), heap.end());
    const Slope slope = std::move(heap.back());
    heap.pop_back();
    if (auto taken = memory.hold(heap.size() + 2); !taken) return taken.error();
    for (BezierPiece& half : halves(slope.piece, width)) consider(std::move(half), slope.depth + 1);
  }
  return heap.empty() ? attained : std::max(attained, heap.front().top);
}

}  // namespace

double LocalSpline::to_global(Index k, double local) const {
  return std::clamp(centre[k] + std::ldexp(local, exponent), control.low[k], control.high[k]);
}

Result<LocalSpline> localized(const Spline& spline) {
  const Result<int> weight_shift = weight_exponent(spline);
  if (!weight_shift) return weight_shift.error();
  const std::vector<double> points = projected(spline);
  if (!std::ranges::all_of(points, [](double x) { return std::isfinite(x); })) return does_not_fit();

  const Index dimension = spline.dimension(), width = spline.width;
  LocalSpline local{spline, std::vector<double>(dimension), 0, box_of(points, dimension)};
  std::vector<double>& stored = local.spline.points;
  if (spline.rational)
    for (Count i = dimension; i < stored.size(); i += width)
      stored[i] = std::ldexp(stored[i], -*weight_shift);

  // First every coordinate in its own unit, a power of two above its largest value: there nothing overflows,
  // and fma takes the centre away with one rounding of the (small) difference.
  std::vector<int> unit(dimension);
  bool any = false;
  for (Index k = 0; k < dimension; ++k) {
    const double low = local.control.low[k], high = local.control.high[k];
    const double centre = local.centre[k] = low / 2 + high / 2;
    unit[k] = exponent_of(std::max(std::abs(low), std::abs(high)));
    const double moved_by = std::ldexp(centre, -unit[k]);
    double radius = 0;
    for (Count i = k; i < stored.size(); i += width) {
      const double weight = spline.rational ? stored[i - k + dimension] : 1;
      stored[i] = std::fma(-weight, moved_by, std::ldexp(stored[i], -unit[k] - *weight_shift));
      radius = std::max(radius, std::abs(stored[i]) / weight);
    }
    if (radius == 0) continue;
    const int exponent = unit[k] + exponent_of(radius);
    local.exponent = any ? std::max(local.exponent, exponent) : exponent;
    any = true;
  }
  for (Count i = 0; i < stored.size(); ++i)
    if (const Count k = i % width; k < dimension) stored[i] = std::ldexp(stored[i], unit[k] - local.exponent);
  return local;
}

Spline window(const Spline& spline, Count span) {
  const auto knot = spline.knots.begin() + static_cast<std::ptrdiff_t>(span - spline.degree);
  const auto point =
      spline.points.begin() + static_cast<std::ptrdiff_t>((span - spline.degree) * spline.width);
  return {spline.degree,
          spline.width,
          spline.rational,
          false,
          {knot, knot + 2 * (static_cast<std::ptrdiff_t>(spline.degree) + 1)},
          {point, point + static_cast<std::ptrdiff_t>((Count{spline.degree} + 1) * spline.width)}};
}

std::vector<double> product_weights(Index degree) {
  // Rows of Pascal's triangle: exact up to 2^53, and sums of positive numbers beyond.
  const auto binomials = [](Index n) {
    std::vector<double> row(n + 1, 1.0);
    for (Index r = 1; r <= n; ++r)
      for (Index i = r - 1; i > 0; --i) row[i] += row[i - 1];
    return row;
  };
  const std::vector<double> of_factor = binomials(degree), of_product = binomials(2 * degree);
  std::vector<double> all;
  for (Index i = 0; i <= degree; ++i)
    for (Index j = 0; j <= degree; ++j) all.push_back(of_factor[i] * of_factor[j] / of_product[i + j]);
  return all;
}

Result<Box> bounds(const Spline& spline, const Budget& budget) {
  const Result<LocalSpline> local = localized(spline);
  if (!local) return local.error();
  const auto pieces = bezier_pieces(local->spline, budget);
  if (!pieces) return pieces.error();
  // One heap at a time, of a coordinate alone and its weight.
  GrowingMemory memory(budget, sizeof(Slope),
                       kBytesPerBlock + 4 * (Count{spline.degree} + 1) * sizeof(double));
  Box box = local->control;
  for (Index k = 0; k < spline.dimension(); ++k) {
    if (box.low[k] == box.high[k]) continue;
    const Result<double> high = highest(local->spline, *pieces, k, 1, budget, memory);
    if (!high) return high.error();
    const Result<double> low = highest(local->spline, *pieces, k, -1, budget, memory);
    if (!low) return low.error();
    box.low[k] = local->to_global(k, -*low);
    box.high[k] = local->to_global(k, *high);
  }
  return box;
}

}  // namespace subdivd

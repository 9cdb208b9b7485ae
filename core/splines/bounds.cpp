#include "core/splines/bounds.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/base/all_finite.h"
#include "core/base/pace.h"
#include "core/base/precision.h"
#include "core/splines/growing_memory.h"
#include "core/splines/piece_store.h"

namespace subdivd {
namespace {

constexpr int kLeastWeightExponent = -500;
// Halving evens out weights by one power of two at a time; 53 more reach the last bit of the coordinates.
constexpr Index kMaxDepth = 640;

int exponent_of(double value) { return value > 0 ? std::ilogb(value) + 1 : 0; }

// Around the control points. Nothing where one of them outgrows a double.
std::optional<Box> control_box(const Spline& spline, const Pace& pace) {
  const Index dimension = spline.dimension();
  std::vector<double> point(dimension);
  project(spline.point(0), spline.rational, point);
  Box box{point, point};
  bool finite = true;
  for (Count i = 0; i < spline.point_count(); ++i) {
    pace.spend(dimension);
    project(spline.point(i), spline.rational, point);
    finite = finite && all_finite(std::span<const double>(point));
    for (Index k = 0; k < dimension; ++k) {
      box.low[k] = std::min(box.low[k], point[k]);
      box.high[k] = std::max(box.high[k], point[k]);
    }
  }
  if (!finite) return {};
  return box;
}

// Brings the largest weight into [1/2, 1); the coordinates, which are times the weight, follow.
Result<int> weight_exponent(const Spline& spline, const Pace& pace) {
  if (!spline.rational) return 0;
  const auto weight = [&](Count i) { return spline.points[i * spline.width + spline.width - 1]; };
  double largest = weight(0);
  pace.for_each(spline.point_count(), [&](Count i) { largest = std::max(largest, weight(i)); });
  const int exponent = exponent_of(largest);
  for (Count i = 0; i < spline.point_count(); ++i) {
    pace.spend(1);
    if (exponent_of(weight(i)) - exponent < kLeastWeightExponent)
      return Error{ErrorCode::out_of_range,
                   "weight " + std::to_string(i) + " is less than 2^" + std::to_string(kLeastWeightExponent) +
                       " of the largest; weights that far apart cannot be measured with",
                   {"pointWeights", std::uint64_t{i}}};
  }
  return exponent;
}

// --- The highest point of one coordinate ------------------------------------------------------------------

// A piece of one coordinate, and what it does not exceed.
struct BoundedPiece {
  double top;
  Count number;  // of the curve's pieces, or in the store
  Index depth;   // 0: a piece of the curve
  bool operator<(const BoundedPiece& other) const { return top < other.top; }
};

// The largest control value. The curve is inside the hull of its control points.
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

// Coordinate k of piece `number` alone, times `sign`.
void take_coordinate(const BezierPieces& pieces, Count number, const Spline& spline, Index k, double sign,
                     BezierPiece& one) {
  one.begin = pieces.begin(number), one.end = pieces.end(number);
  one.points.clear();
  const std::span<const double> points = pieces.points(number);
  for (Count i = 0; i < points.size(); i += spline.width) {
    one.points.push_back(sign * points[i + k]);
    if (spline.rational) one.points.push_back(points[i + spline.width - 1]);
  }
}

// The largest value of sign * coordinate k, from above, to within the rounding of halving: halves the piece
// that could reach highest until none could reach more than has been attained.
Result<double> highest(const Spline& local, const BezierPieces& pieces, Index k, double sign,
                       GrowingMemory& memory, const Pace& pace) {
  const Index width = local.rational ? 2 : 1;
  const Count steps = 4 * Count{local.degree + 1} * width;
  const double tolerance = 8 * (local.degree + 1) * kRoundoff;
  double attained = -1;
  std::vector<BoundedPiece> heap;
  PieceStore store;  // of halves
  const auto matters = [&](const BezierPiece& piece, double& top) {
    attained = std::max(attained, attained_by(piece, width));
    top = top_of(piece, width);
    return top > attained;
  };
  const auto put = [&](const BoundedPiece& bounded) {
    pace.make_room(heap, 1);
    heap.push_back(bounded);
    std::push_heap(heap.begin(), heap.end());
  };
  BezierPiece piece;
  double top = 0;
  for (Count i = 0; i < pieces.size(); ++i) {
    pace.spend(steps);
    if (auto taken = memory.hold(heap.size() + 1); !taken) return taken.error();
    take_coordinate(pieces, i, local, k, sign, piece);
    if (matters(piece, top)) put({top, i, 0});
  }
  while (!heap.empty() && heap.front().top > attained + tolerance && heap.front().depth < kMaxDepth) {
    pace.spend(steps * (local.degree + 2));
    std::pop_heap(heap.begin(), heap.end());
    const BoundedPiece bounded = heap.back();
    heap.pop_back();
    if (bounded.depth == 0)
      take_coordinate(pieces, bounded.number, local, k, sign, piece);
    else
      piece = store.take(bounded.number);
    if (auto taken = memory.hold(heap.size() + 2); !taken) return taken.error();
    for (BezierPiece& half : halves(piece, width))
      if (matters(half, top)) put({top, store.keep(std::move(half), pace), bounded.depth + 1});
  }
  return heap.empty() ? attained : std::max(attained, heap.front().top);
}

}  // namespace

double LocalSpline::to_global(Index k, double local) const {
  return std::clamp(centre[k] + std::ldexp(local, exponent), control.low[k], control.high[k]);
}

namespace {

Result<LocalSpline> to_local_coordinates(const Spline& spline, const Pace& pace) {
  const Result<int> weight_shift = weight_exponent(spline, pace);
  if (!weight_shift) return weight_shift.error();
  auto control = control_box(spline, pace);
  if (!control) return does_not_fit();

  const Index dimension = spline.dimension(), width = spline.width;
  LocalSpline local{copy_of(spline, pace), std::vector<double>(dimension), 0, *std::move(control)};
  std::vector<double>& stored = local.spline.points;
  const Count points = spline.point_count();
  if (spline.rational)
    pace.for_each(points, [&](Count i) {
      double& weight = stored[i * width + dimension];
      weight = std::ldexp(weight, -*weight_shift);
    });

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
    pace.for_each(points, [&](Count i) {
      double& x = stored[i * width + k];
      const double weight = spline.rational ? stored[i * width + dimension] : 1;
      x = std::fma(-weight, moved_by, std::ldexp(x, -unit[k] - *weight_shift));
      radius = std::max(radius, std::abs(x) / weight);
    });
    if (radius == 0) continue;
    const int exponent = unit[k] + exponent_of(radius);
    local.exponent = any ? std::max(local.exponent, exponent) : exponent;
    any = true;
  }
  pace.for_each(stored.size(), [&](Count i) {
    if (const Count k = i % width; k < dimension) stored[i] = std::ldexp(stored[i], unit[k] - local.exponent);
  });
  return local;
}

}  // namespace

Result<LocalSpline> to_local_coordinates(const Spline& spline, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) { return to_local_coordinates(spline, pace); });
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
  const Result<LocalSpline> local = to_local_coordinates(spline, budget);
  if (!local) return local.error();
  const auto pieces = bezier_pieces(local->spline, budget);
  if (!pieces) return pieces.error();
  // One heap at a time, of a coordinate alone and its weight.
  GrowingMemory memory(budget, sizeof(BoundedPiece) + PieceStore::kBytes,
                       kBytesPerBlock + 4 * (Count{spline.degree} + 1) * sizeof(double));
  return stoppable(budget, [&](const Pace& pace) -> Result<Box> {
    Box box = local->control;
    for (Index k = 0; k < spline.dimension(); ++k) {
      if (box.low[k] == box.high[k]) continue;
      const Result<double> high = highest(local->spline, *pieces, k, 1, memory, pace);
      if (!high) return high.error();
      const Result<double> low = highest(local->spline, *pieces, k, -1, memory, pace);
      if (!low) return low.error();
      box.low[k] = local->to_global(k, -*low);
      box.high[k] = local->to_global(k, *high);
    }
    return box;
  });
}

}  // namespace subdivd

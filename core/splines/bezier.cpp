#include "core/splines/bezier.h"

#include <algorithm>
#include <cassert>

#include "core/base/pace.h"
#include "core/splines/knot_insertion.h"

namespace subdivd {
namespace {

// What is missing for every knot of the domain to stand `degree` times.
std::vector<double> missing_knots(const Spline& spline, const Pace& pace) {
  std::vector<double> missing;
  for (Count i = 0; i < spline.knots.size();) {
    const double t = spline.knots[i];
    Count next = i;
    while (next < spline.knots.size() && spline.knots[next] == t) ++next;
    const bool inside = t >= spline.begin() && t <= spline.end();
    const Count lacking = inside && next - i < spline.degree ? spline.degree - (next - i) : 0;
    pace.spend(next - i + lacking);
    pace.make_room(missing, lacking);
    missing.insert(missing.end(), lacking, t);
    i = next;
  }
  return missing;
}

// The knots that the spans of the domain begin at, of those that are not empty.
std::vector<Count> spans_of(const Spline& refined, double begin, double end, Count most, const Pace& pace) {
  std::vector<Count> spans;
  spans.reserve(most);
  pace.for_each(refined.knots.size() - 1, [&](Count k) {
    const double first = refined.knots[k], last = refined.knots[k + 1];
    if (first >= begin && last <= end && first < last) spans.push_back(k);
  });
  return spans;
}

}  // namespace

std::vector<BezierPiece> bezier_pieces(const Spline& spline) {
  const auto all = bezier_pieces(spline, Budget{});
  assert(all.ok());
  std::vector<BezierPiece> pieces;
  pieces.reserve(all->size());
  for (Count i = 0; i < all->size(); ++i) pieces.push_back((*all)[i]);
  return pieces;
}

Result<BezierPieces> bezier_pieces(const Spline& spline, const Budget& budget) {
  const Index p = spline.degree;
  const Count most = spline.point_count() - p;
  // Every span gets p points and knots of its own, and the lists of knots grow; then where they begin.
  const Count knots = spline.knots.size() + (most + 1) * p;
  const Count bytes = knots * (spline.width + 5) * sizeof(double) + most * sizeof(Count);
  if (auto taken = budget.take_memory(bytes); !taken) return taken.error();
  const auto missing = stoppable(budget, [&](const Pace& pace) { return missing_knots(spline, pace); });
  if (!missing) return missing.error();
  Result<Spline> refined = refine_knots(spline, *missing, budget);
  if (!refined) return refined.error();
  auto spans = stoppable(
      budget, [&](const Pace& pace) { return spans_of(*refined, spline.begin(), spline.end(), most, pace); });
  if (!spans) return spans.error();
  BezierPieces pieces;
  pieces.refined_ = *std::move(refined);
  pieces.spans_ = *std::move(spans);
  return pieces;
}

std::span<const double> BezierPieces::points(Count i) const {
  // Both ends stand p times at least: the points of the span are those of the piece.
  const Count p = refined_.degree, width = refined_.width;
  return std::span(refined_.points).subspan((spans_[i] - p) * width, (p + 1) * width);
}

BezierPiece BezierPieces::operator[](Count i) const {
  const std::span<const double> all = points(i);
  return {begin(i), end(i), {all.begin(), all.end()}};
}

std::array<BezierPiece, 2> halves(const BezierPiece& piece, Index width) {
  const double middle = piece.begin + (piece.end - piece.begin) / 2;
  std::array<BezierPiece, 2> both{BezierPiece{piece.begin, middle, {}}, BezierPiece{middle, piece.end, {}}};
  const Count count = piece.points.size() / width;
  both[0].points.resize(piece.points.size());
  both[1].points = piece.points;
  // Row by row of the triangle of means: its left side is the first half, what is left of it in place, the
  // right side, the second.
  std::vector<double>& net = both[1].points;
  for (Count r = 0; r < count; ++r) {
    std::copy_n(net.begin(), width, both[0].points.begin() + static_cast<std::ptrdiff_t>(r * width));
    for (Count i = 0; i + 1 < count - r; ++i)
      for (Index k = 0; k < width; ++k)
        net[i * width + k] = net[i * width + k] / 2 + net[(i + 1) * width + k] / 2;
  }
  return both;
}

void evaluate(const BezierPiece& piece, Index width, double t, std::span<double> point) {
  std::vector<double> net = piece.points;
  const double share = (t - piece.begin) / (piece.end - piece.begin);
  for (Count left = net.size() / width - 1; left > 0; --left)
    for (Count i = 0; i < left * width; ++i) net[i] = (1 - share) * net[i] + share * net[i + width];
  std::copy_n(net.begin(), width, point.begin());
}

void project(std::span<const double> stored, bool rational, std::span<double> coordinates) {
  const double divisor = rational ? stored.back() : 1;
  for (Count k = 0; k < coordinates.size(); ++k) coordinates[k] = stored[k] / divisor;
}

PieceChain::PieceChain(Index degree, Index width, bool rational, Count pieces)
    : spline_{degree, width, rational, false, {}, {}} {
  spline_.knots.reserve((pieces + 1) * degree + 2);
  spline_.points.reserve((pieces * degree + 1) * width);
}

void PieceChain::add(const BezierPiece& piece) {
  const Index degree = spline_.degree;
  if (spline_.knots.empty())
    spline_.knots.assign(degree + 1, piece.begin);
  else
    spline_.points.resize(spline_.points.size() - spline_.width);
  spline_.points.insert(spline_.points.end(), piece.points.begin(), piece.points.end());
  spline_.knots.insert(spline_.knots.end(), degree, piece.end);
}

Spline PieceChain::finish() {
  assert(!spline_.knots.empty());
  spline_.knots.push_back(spline_.knots.back());
  return std::move(spline_);
}

Spline spline_of(std::span<const BezierPiece> pieces, Index degree, Index width, bool rational) {
  PieceChain chain(degree, width, rational, pieces.size());
  for (const BezierPiece& piece : pieces) chain.add(piece);
  return chain.finish();
}

}  // namespace subdivd

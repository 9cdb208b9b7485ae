#include "core/splines/bezier.h"

#include <algorithm>
#include <cassert>

#include "core/splines/growing_memory.h"
#include "core/splines/knot_insertion.h"

namespace subdivd {
namespace {

// What is missing for every knot of the domain to stand `degree` times.
std::vector<double> missing_knots(const Spline& spline) {
  std::vector<double> missing;
  for (Count i = 0; i < spline.knots.size();) {
    const double t = spline.knots[i];
    Count next = i;
    while (next < spline.knots.size() && spline.knots[next] == t) ++next;
    if (t >= spline.begin() && t <= spline.end())
      for (Count k = next - i; k < spline.degree; ++k) missing.push_back(t);
    i = next;
  }
  return missing;
}

}  // namespace

std::vector<BezierPiece> bezier_pieces(const Spline& spline) {
  auto pieces = bezier_pieces(spline, Budget{});
  assert(pieces.ok());
  return *std::move(pieces);
}

Result<std::vector<BezierPiece>> bezier_pieces(const Spline& spline, const Budget& budget) {
  const Index p = spline.degree;
  const Count spans = spline.point_count() - p;
  // Every span gets p points and knots of its own, and the lists of knots grow; then the pieces.
  const Count knots = spline.knots.size() + (spans + 1) * p;
  const Count refining = knots * (spline.width + 5) * sizeof(double);
  const Count in_pieces =
      sizeof(BezierPiece) + kBytesPerBlock + (Count{p} + 1) * spline.width * sizeof(double);
  if (auto taken = budget.take_memory(refining + spans * in_pieces); !taken) return taken.error();
  const Result<Spline> refined = refine_knots(spline, missing_knots(spline), budget);
  if (!refined) return refined.error();
  std::vector<BezierPiece> pieces;
  pieces.reserve(spans);
  BudgetPoller poller(budget);
  for (Count k = 0; k + 1 < refined->knots.size(); ++k) {
    if (auto stop = poller.spend(8)) return *stop;
    const double begin = refined->knots[k], end = refined->knots[k + 1];
    if (begin < spline.begin() || end > spline.end() || !(begin < end)) continue;
    // Both ends stand p times at least: the points of the span are those of the piece.
    const auto first = refined->points.begin() + static_cast<std::ptrdiff_t>((k - p) * spline.width);
    pieces.push_back(
        {begin, end, {first, first + static_cast<std::ptrdiff_t>((Count{p} + 1) * spline.width)}});
  }
  return pieces;
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

Spline spline_of(std::span<const BezierPiece> pieces, Index degree, Index width, bool rational) {
  assert(!pieces.empty());
  Spline spline{degree, width, rational, false, {}, {}};
  spline.knots.assign(degree + 1, pieces.front().begin);
  for (const BezierPiece& piece : pieces) {
    if (!spline.points.empty()) spline.points.resize(spline.points.size() - width);
    spline.points.insert(spline.points.end(), piece.points.begin(), piece.points.end());
    spline.knots.insert(spline.knots.end(), degree, piece.end);
  }
  spline.knots.push_back(pieces.back().end);
  return spline;
}

}  // namespace subdivd

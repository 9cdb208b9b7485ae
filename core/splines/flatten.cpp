#include "core/splines/flatten.h"

#include <algorithm>
#include <cmath>

#include "core/base/pace.h"
#include "core/splines/bezier.h"
#include "core/splines/bounds.h"
#include "core/splines/chord.h"
#include "core/splines/growing_memory.h"

namespace subdivd {
namespace {

// What a local control point may be off after `level` halvings, as a distance: knot insertion (2 p steps of
// about 4 roundings), p roundings per halving, twice that for quotients, in every coordinate.
double rounding(const Spline& local, Index level) {
  const double steps = 8.0 * local.degree + 2.0 * local.degree * level + 4;
  return (local.rational ? 2 : 1) * steps * kRoundoff * std::sqrt(local.dimension());
}

// A corner moved to its place is rounded once more there: half the last bit of its coordinates.
double rounding_of_corners(const LocalSpline& local) {
  double square = 0;
  for (Count k = 0; k < local.centre.size(); ++k) {
    const double largest = std::max(std::abs(local.control.low[k]), std::abs(local.control.high[k]));
    const double last_bit = std::ldexp(largest, -local.exponent) * 2 * kRoundoff;
    square += last_bit * last_bit;
  }
  return std::sqrt(square);
}

// The largest distance of a piece's control points from its chord. `points`: room for all of them, projected.
double distance_from_chord(const BezierPiece& piece, const Spline& local, std::vector<double>& points) {
  const Index dimension = local.dimension(), width = local.width;
  const std::span<const double> stored(piece.points);
  const auto at = [&](Count i) { return std::span(points).subspan(i * dimension, dimension); };
  for (Count i = 0; i <= local.degree; ++i) project(stored.subspan(i * width, width), local.rational, at(i));
  double square = 0;
  for (Count i = 1; i < local.degree; ++i)
    square = std::max(square, square_from_segment(at(i), at(0), at(local.degree)));
  return std::sqrt(square);
}

struct Part {
  BezierPiece piece;
  Index level;
};

// Halves `first` until every part is flat and adds the corner at the end of each, `points` in local
// coordinates. `waiting`: pieces of the curve still to come, which are corners at least.
Result<void> add_piece(const LocalSpline& local, BezierPiece first, double tolerance, Count most,
                       Count waiting, const FlattenOptions& options, GrowingMemory& memory, const Pace& pace,
                       Polyline& polyline) {
  const Spline& spline = local.spline;
  const double corner = rounding_of_corners(local);
  std::vector<double> scratch((Count{spline.degree} + 1) * spline.dimension());
  const Count steps = (Count{spline.degree} + 4) * (spline.degree + 1) * spline.width;
  std::vector<Part> ahead;  // the next one last; never more than one per level
  ahead.push_back({std::move(first), 0});
  while (!ahead.empty()) {
    pace.spend(steps);
    Part part = std::move(ahead.back());
    ahead.pop_back();
    const double rounded = 2 * rounding(spline, part.level) + corner;
    if (distance_from_chord(part.piece, spline, scratch) + rounded <= tolerance) {
      const Count corners = polyline.parameters.size() + 1;
      if (corners + ahead.size() + waiting > most)
        return too_many_corners(corners + ahead.size() + waiting, most);
      if (auto taken = memory.hold(corners); !taken) return taken;
      pace.make_room(polyline.parameters, 1);
      polyline.parameters.push_back(part.piece.end);
      pace.make_room(polyline.points, spline.dimension());
      polyline.points.insert(polyline.points.end(), scratch.end() - spline.dimension(), scratch.end());
      continue;
    }
    if (rounded >= tolerance) return too_fine(options, std::ldexp(rounded, local.exponent));
    auto both = halves(part.piece, spline.width);
    ahead.push_back({std::move(both[1]), part.level + 1});
    ahead.push_back({std::move(both[0]), part.level + 1});
  }
  return {};
}

// A curve that begins or ends at its first or last control point does so to the bit.
void keep_ends(const Spline& spline, Polyline& polyline) {
  const Count p = spline.degree, n = spline.point_count(), dimension = spline.dimension();
  if (spline.knots[1] == spline.knots[p])
    project(spline.point(0), spline.rational, std::span(polyline.points).first(dimension));
  if (spline.knots[n] == spline.knots[n + p - 1])
    project(spline.point(n - 1), spline.rational, std::span(polyline.points).last(dimension));
}

}  // namespace

namespace {

// In local coordinates.
Result<Polyline> local_polyline(const LocalSpline& local, const BezierPieces& pieces, Count most,
                                const FlattenOptions& options, const Budget& budget, const Pace& pace) {
  const Spline& spline = local.spline;
  const Index dimension = spline.dimension();
  // May be infinite, which is fine with comparisons: so large a tolerance is kept by every chord, and any is
  // by a curve that is but a point.
  const bool is_point = local.control.low == local.control.high;
  const double tolerance = is_point ? HUGE_VAL : std::ldexp(options.tolerance, -local.exponent);
  Polyline polyline;
  GrowingMemory memory(budget, (Count{dimension} + 1) * sizeof(double), 0);
  polyline.parameters.push_back(pieces.begin(0));
  polyline.points.resize(dimension);
  project(pieces.points(0).first(spline.width), spline.rational, polyline.points);
  for (Count i = 0; i < pieces.size(); ++i) {
    const Count waiting = pieces.size() - 1 - i;
    if (auto added = add_piece(local, pieces[i], tolerance, most, waiting, options, memory, pace, polyline);
        !added)
      return added.error();
  }
  return polyline;
}

}  // namespace

Result<Polyline> flatten(const Spline& spline, const FlattenOptions& options, const Budget& budget) {
  if (auto checked = check_tolerance(options); !checked) return checked.error();
  const Result<LocalSpline> local = to_local_coordinates(spline, budget);
  if (!local) return local.error();
  const Index dimension = spline.dimension();
  const Count fitting = budget.max_bytes / ((Count{dimension} + 1) * sizeof(double));
  const Count most = std::min(options.max_points, fitting);
  const auto pieces = bezier_pieces(local->spline, budget);
  if (!pieces) return pieces.error();
  if (pieces->size() + 1 > most) return too_many_corners(pieces->size() + 1, most);
  return stoppable(budget, [&](const Pace& pace) {
    auto polyline = local_polyline(*local, *pieces, most, options, budget, pace);
    if (!polyline) return polyline;
    std::vector<double>& points = polyline->points;
    pace.for_each(points.size(), [&](Count i) {
      points[i] = local->to_global(static_cast<Index>(i % dimension), points[i]);
    });
    keep_ends(spline, *polyline);
    return polyline;
  });
}

}  // namespace subdivd

#include "core/curves/bases.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "core/splines/bezier.h"
#include "core/splines/degree.h"
#include "core/splines/edit.h"

namespace subdivd {
namespace {

using Points = std::span<const double>;

// --- Into splines -----------------------------------------------------------------------------------------

// Point i of a row that goes on beyond both ends, as far as one likes.
class Row {
 public:
  Row(Points points, Index width) : points_(points), width_(width) {}

  Count count() const { return points_.size() / width_; }
  double at(Count i, Index k) const { return points_[i * width_ + k]; }
  // Modulo the number of points.
  double around(std::int64_t i, Index k) const {
    const auto n = static_cast<std::int64_t>(count());
    return at(static_cast<Count>(((i % n) + n) % n), k);
  }
  // Reflected in the first and the last point, again and again: c_{-i} = 2 c_0 - c_i.
  double mirrored(std::int64_t i, Index k) const {
    const auto last = static_cast<std::int64_t>(count()) - 1;
    if (i < 0 && -i <= last) return 2 * at(0, k) - at(static_cast<Count>(-i), k);
    const std::int64_t period = 2 * last;  // two reflections are a shift by 2 (c_last - c_0)
    std::int64_t turns = i / period;
    std::int64_t rest = i % period;
    if (rest < 0) {
      rest += period;
      --turns;
    }
    const double first_point = at(0, k), last_point = at(count() - 1, k);
    const double here = rest <= last ? at(static_cast<Count>(rest), k)
                                     : 2 * last_point - at(static_cast<Count>(period - rest), k);
    return turns == 0 ? here : here + static_cast<double>(turns) * 2 * (last_point - first_point);
  }
  // The same for points that stand half a step beside the ends, which are the first and the last point: d_j
  // is point j + 1.
  double mirrored_beside(std::int64_t j, Index k) const {
    const auto inner = static_cast<std::int64_t>(count()) - 2;
    if (j < 0 && -j <= inner) return 2 * at(0, k) - at(static_cast<Count>(-j), k);
    const std::int64_t period = 2 * inner;
    std::int64_t turns = j / period;
    std::int64_t rest = j % period;
    if (rest < 0) {
      rest += period;
      --turns;
    }
    const double first_point = at(0, k), last_point = at(count() - 1, k);
    const double here = rest < inner ? at(static_cast<Count>(rest) + 1, k)
                                     : 2 * last_point - at(static_cast<Count>(period - rest), k);
    return turns == 0 ? here : here + static_cast<double>(turns) * 2 * (last_point - first_point);
  }

 private:
  Points points_;
  Index width_;
};

// Points numbered from `first` on, `count` of them, over whole knots the first of which is `knot`.
template <class At>
Spline uniform(Index degree, Index width, bool periodic, std::int64_t first, Count count, double knot,
               At at) {
  Spline spline{degree, width, false, periodic, {}, {}};
  for (Count i = 0; i < count; ++i)
    for (Index k = 0; k < width; ++k) spline.points.push_back(at(first + static_cast<std::int64_t>(i), k));
  for (Count i = 0; i < count + degree + 1; ++i) spline.knots.push_back(knot + static_cast<double>(i));
  return spline;
}

// Pieces of Bezier points over 0, 1, 2, ..., from `begin` on.
Spline of_pieces(std::vector<BezierPiece> pieces, Index width, bool periodic, double begin) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    pieces[i].begin = begin + static_cast<double>(i);
    pieces[i].end = begin + static_cast<double>(i + 1);
  }
  Spline spline = spline_of(pieces, 3, width, false);
  spline.periodic = periodic;
  return spline;
}

// p, p + u / 3, q - v / 3, q.
BezierPiece piece_of_tangents(Points p, Points u, Points q, Points v) {
  BezierPiece piece;
  piece.points.assign(p.begin(), p.end());
  for (std::size_t k = 0; k < p.size(); ++k) piece.points.push_back(p[k] + u[k] / 3);
  for (std::size_t k = 0; k < p.size(); ++k) piece.points.push_back(q[k] - v[k] / 3);
  piece.points.insert(piece.points.end(), q.begin(), q.end());
  return piece;
}

double between(Points a, Points b, Spacing spacing) {
  if (spacing == Spacing::uniform) return 1;
  double distance = 0;
  for (std::size_t k = 0; k < a.size(); ++k) distance = std::hypot(distance, a[k] - b[k]);
  return spacing == Spacing::chordal ? distance : std::sqrt(distance);
}

// The tangent at b on the way from a over b to c, per unit of a segment whose step is `own` (that of a to b
// or that of b to c):
//   own ((b - a) / ab - (c - a) / (ab + bc) + (c - b) / bc)   [BarryGoldman88]
//   = own (bc / ab (b - a) + ab / bc (c - b)) / (ab + bc)
std::vector<double> tangent_at(Points a, Points b, Points c, Spacing spacing, bool behind) {
  const double ab = between(a, b, spacing), bc = between(b, c, spacing), own = behind ? bc : ab;
  std::vector<double> tangent(b.size(), 0.0);
  if (own == 0) return tangent;
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (ab == 0)
      tangent[k] = c[k] - b[k];
    else if (bc == 0)
      tangent[k] = b[k] - a[k];
    else  // no factor is above 1 but own / ab or own / bc
      tangent[k] = own / ab * (bc / (ab + bc)) * (b[k] - a[k]) + own / bc * (ab / (ab + bc)) * (c[k] - b[k]);
  }
  return tangent;
}

}  // namespace

namespace {

// Of a curve that begins at `first` and ends at `last` but for rounding: with knots so that it does to the
// bit.
Spline pinned_at(Points first, Points last, const Spline& spline) {
  const Result<Spline> whole = part(spline, spline.begin(), spline.end());
  assert(whole.ok());
  Spline pinned = *whole;
  std::ranges::copy(first, pinned.points.begin());
  std::ranges::copy(last, pinned.points.end() - static_cast<std::ptrdiff_t>(last.size()));
  return pinned;
}

}  // namespace

Spline spline_of_bspline(Points points, Index width, CurveWrap wrap, Index degree) {
  const Row row(points, width);
  const Index m = degree / 2, p = degree;
  const Count n = row.count();
  const bool odd = degree % 2 == 1;
  // c_i is centred on i, over the knots i - (p + 1) / 2 to i + (p + 1) / 2.
  const double half_support = (p + 1) / 2.0;
  const auto before = -static_cast<std::int64_t>(m);
  switch (wrap) {
    case CurveWrap::nonperiodic:
      return uniform(p, width, false, 0, n, -half_support,
                     [&](std::int64_t i, Index k) { return row.at(static_cast<Count>(i), k); });
    case CurveWrap::periodic:
      return uniform(p, width, true, before, n + p, -static_cast<double>(m) - half_support,
                     [&](std::int64_t i, Index k) { return row.around(i, k); });
    case CurveWrap::pinned:
      break;
  }
  const Points first = points.first(width), last = points.last(width);
  if (odd)
    return pinned_at(
        first, last,
        uniform(p, width, false, before, n + 2 * Count{m}, -static_cast<double>(m) - half_support,
                [&](std::int64_t i, Index k) { return row.mirrored(i, k); }));
  // d_j is centred on j + 1/2; the border is 0.
  return pinned_at(
      first, last,
      uniform(p, width, false, before, n - 2 + 2 * Count{m}, -static_cast<double>(m) + 0.5 - half_support,
              [&](std::int64_t j, Index k) { return row.mirrored_beside(j, k); }));
}

Spline spline_of_bezier(Points points, Index width, CurveWrap wrap) {
  const Row row(points, width);
  const bool closed = wrap == CurveWrap::periodic;
  const Count segments = closed ? row.count() / 3 : (row.count() - 1) / 3;
  std::vector<BezierPiece> pieces(segments);
  for (Count s = 0; s < segments; ++s)
    for (Count i = 0; i < 4; ++i)
      for (Index k = 0; k < width; ++k)
        pieces[s].points.push_back(row.around(static_cast<std::int64_t>(3 * s + i), k));
  return of_pieces(std::move(pieces), width, closed, 0);
}

Spline spline_of_catmull_rom(Points points, Index width, CurveWrap wrap, Spacing spacing) {
  const Row row(points, width);
  const auto n = static_cast<std::int64_t>(row.count());
  const auto point = [&](std::int64_t i) {
    std::vector<double> p(width);
    for (Index k = 0; k < width; ++k)
      p[k] = wrap == CurveWrap::pinned ? row.mirrored(i, k) : row.around(i, k);
    return p;
  };
  const std::int64_t first = wrap == CurveWrap::nonperiodic ? 1 : 0;
  const std::int64_t last = wrap == CurveWrap::periodic ? n : wrap == CurveWrap::pinned ? n - 1 : n - 2;
  std::vector<BezierPiece> pieces;
  for (std::int64_t i = first; i < last; ++i) {
    const std::vector<double> a = point(i - 1), b = point(i), c = point(i + 1), d = point(i + 2);
    pieces.push_back(
        piece_of_tangents(b, tangent_at(a, b, c, spacing, true), c, tangent_at(b, c, d, spacing, false)));
  }
  return of_pieces(std::move(pieces), width, wrap == CurveWrap::periodic, static_cast<double>(first));
}

Spline spline_of_hermite(Points points, Index width, CurveWrap wrap) {
  const Count ends = points.size() / width / 2;
  const bool closed = wrap == CurveWrap::periodic;
  const auto entry = [&](Count i) { return points.subspan(i % (2 * ends) * width, width); };
  std::vector<BezierPiece> pieces;
  for (Count i = 0; i + (closed ? 0 : 1) < ends; ++i)
    pieces.push_back(piece_of_tangents(entry(2 * i), entry(2 * i + 1), entry(2 * i + 2), entry(2 * i + 3)));
  return of_pieces(std::move(pieces), width, closed, 0);
}

// --- Out of splines ---------------------------------------------------------------------------------------

namespace {

Error no_such_curve(std::string message) {
  return Error{ErrorCode::unsupported, std::move(message), {}, 0, 0};
}

Result<std::vector<BezierPiece>> cubic_pieces(const Spline& spline, const Budget& budget) {
  if (spline.rational)
    return no_such_curve("a curve with weights has no exact form without them; take nurbs");
  if (spline.degree > 3)
    return no_such_curve("a curve of degree " + std::to_string(spline.degree) +
                         " has no exact cubic form; take nurbs, or reduce its degree first");
  const auto cubic = elevate_degree(spline, 3 - spline.degree, budget);
  if (!cubic) return cubic.error();
  return bezier_pieces(*cubic, budget);
}

// Sees to it that what ought to be equal is, and remembers how far it was from it.
class Agreement {
 public:
  void of(Points a, Points b) {
    double distance = 0;
    for (std::size_t k = 0; k < a.size(); ++k) distance = std::hypot(distance, a[k] - b[k]);
    if (!(distance <= worst_)) worst_ = distance;
  }
  Result<void> within(double tolerance, const char* what) const {
    if (worst_ <= tolerance) return {};
    return no_such_curve(std::string("the curve is no ") + what + ": its pieces are up to " +
                         std::to_string(worst_) + " away from one; take bezier or nurbs");
  }

 private:
  double worst_ = 0;
};

Points control(const BezierPiece& piece, std::size_t i) {
  const std::size_t width = piece.points.size() / 4;
  return Points(piece.points).subspan(i * width, width);
}

std::vector<double> combined(double a, Points p, double b, Points q) {
  std::vector<double> result(p.size());
  for (std::size_t k = 0; k < p.size(); ++k) result[k] = a * p[k] + b * q[k];
  return result;
}

void append(std::vector<double>& all, Points point) { all.insert(all.end(), point.begin(), point.end()); }

// Tangents at both ends of a segment of length 1.
std::vector<double> first_tangent(const BezierPiece& piece) {
  return combined(3, control(piece, 1), -3, control(piece, 0));
}
std::vector<double> last_tangent(const BezierPiece& piece) {
  return combined(3, control(piece, 3), -3, control(piece, 2));
}

// Control point j of the uniform B-spline that the piece over [0, 1] belongs to, j = 0 .. 3: the blossom of
// the knots j - 2, j - 1, j.   [Ramshaw87]
std::vector<double> de_boor_point(const BezierPiece& piece, int j) {
  std::vector<std::vector<double>> net;
  for (std::size_t i = 0; i < 4; ++i) net.emplace_back(control(piece, i).begin(), control(piece, i).end());
  for (int round = 0; round < 3; ++round) {
    const double t = j - 2 + round;
    for (std::size_t i = 0; i + 1 < net.size(); ++i) net[i] = combined(1 - t, net[i], t, net[i + 1]);
    net.pop_back();
  }
  return net[0];
}

}  // namespace

Result<std::vector<double>> bezier_points(const Spline& spline, const Budget& budget) {
  const auto pieces = cubic_pieces(spline, budget);
  if (!pieces) return pieces.error();
  std::vector<double> points;
  for (const BezierPiece& piece : *pieces) {
    if (!points.empty()) points.resize(points.size() - spline.width);
    append(points, piece.points);
  }
  return points;
}

Result<std::vector<double>> bspline_points(const Spline& spline, double tolerance, const Budget& budget) {
  const auto pieces = cubic_pieces(spline, budget);
  if (!pieces) return pieces.error();
  Agreement agreement;
  std::vector<double> points;
  for (const BezierPiece& piece : *pieces)
    for (int j = 0; j < 4; ++j) {
      const std::vector<double> point = de_boor_point(piece, j);
      if (points.empty() || j == 3 || points.size() < std::size_t{4} * spline.width) {
        append(points, point);
        continue;
      }
      agreement.of(point,
                   Points(points).last((3 - static_cast<std::size_t>(j)) * spline.width).first(spline.width));
    }
  if (auto fine = agreement.within(tolerance, "uniform cubic B-spline"); !fine)
    return std::move(fine).error();
  return points;
}

Result<std::vector<double>> catmull_rom_points(const Spline& spline, double tolerance, const Budget& budget) {
  const auto pieces = cubic_pieces(spline, budget);
  if (!pieces) return pieces.error();
  // The points of the curve, and one more at each end that gives it its tangent: c_{-1} = c_1 - 2 u.
  const auto beyond = [](Points from, const std::vector<double>& tangent, double sign) {
    return combined(1, from, -2 * sign, tangent);
  };
  std::vector<double> points = beyond(control(pieces->front(), 3), first_tangent(pieces->front()), 1);
  for (const BezierPiece& piece : *pieces) append(points, control(piece, 0));
  append(points, control(pieces->back(), 3));
  append(points, beyond(control(pieces->back(), 0), last_tangent(pieces->back()), -1));
  Agreement agreement;
  const Row row(points, spline.width);
  for (std::size_t s = 0; s < pieces->size(); ++s)
    for (const bool behind : {false, true}) {
      const std::size_t i = s + 1 + (behind ? 1 : 0);
      const auto at = [&](std::size_t j) { return Points(points).subspan(j * spline.width, spline.width); };
      const std::vector<double> tangent = behind ? last_tangent((*pieces)[s]) : first_tangent((*pieces)[s]);
      agreement.of(tangent, combined(0.5, at(i + 1), -0.5, at(i - 1)));
    }
  if (auto fine = agreement.within(tolerance, "uniform Catmull-Rom curve"); !fine)
    return std::move(fine).error();
  return points;
}

Result<std::vector<double>> hermite_points(const Spline& spline, double tolerance, const Budget& budget) {
  const auto pieces = cubic_pieces(spline, budget);
  if (!pieces) return pieces.error();
  Agreement agreement;
  std::vector<double> points;
  for (std::size_t s = 0; s < pieces->size(); ++s) {
    append(points, control((*pieces)[s], 0));
    append(points, first_tangent((*pieces)[s]));
    if (s > 0) agreement.of(last_tangent((*pieces)[s - 1]), first_tangent((*pieces)[s]));
  }
  append(points, control(pieces->back(), 3));
  append(points, last_tangent(pieces->back()));
  if (auto fine = agreement.within(tolerance, "chain of Hermite segments with one tangent at every point");
      !fine)
    return std::move(fine).error();
  return points;
}

}  // namespace subdivd

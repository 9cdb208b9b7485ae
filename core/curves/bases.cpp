#include "core/curves/bases.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/pace.h"
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
               const Pace& pace, At at) {
  Spline spline{degree, width, false, periodic, {}, {}};
  spline.points.reserve(count * width);
  spline.knots.reserve(count + degree + 1);
  for (Count i = 0; i < count; ++i) {
    pace.spend(2 * Count{width});
    for (Index k = 0; k < width; ++k) spline.points.push_back(at(first + static_cast<std::int64_t>(i), k));
  }
  pace.for_each(count + degree + 1, [&](Count i) { spline.knots.push_back(knot + static_cast<double>(i)); });
  return spline;
}

// `count` pieces over 0, 1, 2, ..., from `begin` on: piece(i) makes the points of one.
template <class Piece>
Spline of_pieces(Count count, Index width, bool periodic, double begin, const Pace& pace, Piece&& piece) {
  PieceChain chain(3, width, false, count);
  for (Count i = 0; i < count; ++i) {
    pace.spend(16 * (Count{width} + 1));
    BezierPiece one = piece(i);
    one.begin = begin + static_cast<double>(i);
    one.end = begin + static_cast<double>(i + 1);
    chain.add(one);
  }
  Spline spline = chain.finish();
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
Spline pinned_at(Points first, Points last, const Spline& spline, const Pace& pace) {
  Result<Spline> whole = part(spline, spline.begin(), spline.end(), pace.budget());
  if (!whole) throw Stopped{std::move(whole).error()};  // it cannot fail otherwise
  Spline pinned = *std::move(whole);
  std::ranges::copy(first, pinned.points.begin());
  std::ranges::copy(last, pinned.points.end() - static_cast<std::ptrdiff_t>(last.size()));
  return pinned;
}

}  // namespace

Spline spline_of_bspline(Points points, Index width, CurveWrap wrap, Index degree, const Pace& pace) {
  const Row row(points, width);
  const Index m = degree / 2, p = degree;
  const Count n = row.count();
  const bool odd = degree % 2 == 1;
  // c_i is centred on i, over the knots i - (p + 1) / 2 to i + (p + 1) / 2.
  const double half_support = (p + 1) / 2.0;
  const auto before = -static_cast<std::int64_t>(m);
  switch (wrap) {
    case CurveWrap::nonperiodic:
      return uniform(p, width, false, 0, n, -half_support, pace,
                     [&](std::int64_t i, Index k) { return row.at(static_cast<Count>(i), k); });
    case CurveWrap::periodic:
      return uniform(p, width, true, before, n + p, -static_cast<double>(m) - half_support, pace,
                     [&](std::int64_t i, Index k) { return row.around(i, k); });
    case CurveWrap::pinned:
      break;
  }
  const Points first = points.first(width), last = points.last(width);
  if (odd)
    return pinned_at(
        first, last,
        uniform(p, width, false, before, n + 2 * Count{m}, -static_cast<double>(m) - half_support, pace,
                [&](std::int64_t i, Index k) { return row.mirrored(i, k); }),
        pace);
  // d_j is centred on j + 1/2; the border is 0.
  return pinned_at(
      first, last,
      uniform(p, width, false, before, n - 2 + 2 * Count{m}, -static_cast<double>(m) + 0.5 - half_support,
              pace, [&](std::int64_t j, Index k) { return row.mirrored_beside(j, k); }),
      pace);
}

Spline spline_of_bezier(Points points, Index width, CurveWrap wrap, const Pace& pace) {
  const Row row(points, width);
  const bool closed = wrap == CurveWrap::periodic;
  const Count segments = closed ? row.count() / 3 : (row.count() - 1) / 3;
  return of_pieces(segments, width, closed, 0, pace, [&](Count s) {
    BezierPiece piece;
    for (Count i = 0; i < 4; ++i)
      for (Index k = 0; k < width; ++k)
        piece.points.push_back(row.around(static_cast<std::int64_t>(3 * s + i), k));
    return piece;
  });
}

Spline spline_of_catmull_rom(Points points, Index width, CurveWrap wrap, Spacing spacing, const Pace& pace) {
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
  return of_pieces(static_cast<Count>(last - first), width, wrap == CurveWrap::periodic,
                   static_cast<double>(first), pace, [&](Count s) {
                     const std::int64_t i = first + static_cast<std::int64_t>(s);
                     const std::vector<double> a = point(i - 1), b = point(i), c = point(i + 1),
                                               d = point(i + 2);
                     return piece_of_tangents(b, tangent_at(a, b, c, spacing, true), c,
                                              tangent_at(b, c, d, spacing, false));
                   });
}

Spline spline_of_hermite(Points points, Index width, CurveWrap wrap, const Pace& pace) {
  const Count ends = points.size() / width / 2;
  const bool closed = wrap == CurveWrap::periodic;
  const auto entry = [&](Count i) { return points.subspan(i % (2 * ends) * width, width); };
  return of_pieces(ends - (closed ? 0 : 1), width, closed, 0, pace, [&](Count i) {
    return piece_of_tangents(entry(2 * i), entry(2 * i + 1), entry(2 * i + 2), entry(2 * i + 3));
  });
}

}  // namespace subdivd

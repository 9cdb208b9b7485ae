#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "core/base/pace.h"
#include "core/curves/bases.h"
#include "core/splines/bezier.h"
#include "core/splines/degree.h"

namespace subdivd {
namespace {

using Points = std::span<const double>;

Error no_such_curve(std::string message) { return Error{ErrorCode::unsupported, std::move(message)}; }

Result<BezierPieces> cubic_pieces(const Spline& spline, const Budget& budget) {
  if (spline.rational)
    return no_such_curve("a curve with weights has no exact form without them; take nurbs");
  if (spline.degree > 3)
    return no_such_curve("a curve of degree " + std::to_string(spline.degree) +
                         " has no exact cubic form; take nurbs, or reduce its degree first");
  const auto cubic = elevate_degree(spline, 3 - spline.degree, budget);
  if (!cubic) return cubic.error();
  return bezier_pieces(*cubic, budget);
}

// Points for `each` of every piece, and as many more at the ends: write(pieces, points, pace) writes them.
template <class Write>
Result<std::vector<double>> points_of(const Spline& spline, Count each, const Budget& budget, Write&& write) {
  const auto pieces = cubic_pieces(spline, budget);
  if (!pieces) return pieces.error();
  return stoppable(budget, [&](const Pace& pace) -> Result<std::vector<double>> {
    std::vector<double> points;
    points.reserve((pieces->size() + 3) * each * spline.width);
    const auto done = write(*pieces, points, [&] { pace.spend(16 * (Count{spline.width} + 1)); });
    if (!done) return done.error();
    return points;
  });
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
  const auto write = [&](const BezierPieces& pieces, std::vector<double>& points,
                         auto spend) -> Result<void> {
    for (Count s = 0; s < pieces.size(); ++s) {
      spend();
      if (!points.empty()) points.resize(points.size() - spline.width);
      append(points, pieces.points(s));
    }
    return {};
  };
  return points_of(spline, 3, budget, write);
}

Result<std::vector<double>> bspline_points(const Spline& spline, double tolerance, const Budget& budget) {
  const auto write = [&](const BezierPieces& pieces, std::vector<double>& points,
                         auto spend) -> Result<void> {
    Agreement agreement;
    for (Count s = 0; s < pieces.size(); ++s) {
      const BezierPiece piece = pieces[s];
      for (int j = 0; j < 4; ++j) {
        spend();
        const std::vector<double> point = de_boor_point(piece, j);
        if (points.empty() || j == 3 || points.size() < std::size_t{4} * spline.width) {
          append(points, point);
          continue;
        }
        agreement.of(
            point, Points(points).last((3 - static_cast<std::size_t>(j)) * spline.width).first(spline.width));
      }
    }
    return agreement.within(tolerance, "uniform cubic B-spline");
  };
  return points_of(spline, 3, budget, write);
}

Result<std::vector<double>> catmull_rom_points(const Spline& spline, double tolerance, const Budget& budget) {
  // The points of the curve, and one more at each end that gives it its tangent: c_{-1} = c_1 - 2 u.
  const auto beyond = [](Points from, const std::vector<double>& tangent, double sign) {
    return combined(1, from, -2 * sign, tangent);
  };
  const auto write = [&](const BezierPieces& pieces, std::vector<double>& points,
                         auto spend) -> Result<void> {
    const BezierPiece front = pieces[0], back = pieces[pieces.size() - 1];
    append(points, beyond(control(front, 3), first_tangent(front), 1));
    for (Count s = 0; s < pieces.size(); ++s) {
      spend();
      append(points, pieces.points(s).first(spline.width));
    }
    append(points, control(back, 3));
    append(points, beyond(control(back, 0), last_tangent(back), -1));
    Agreement agreement;
    for (std::size_t s = 0; s < pieces.size(); ++s) {
      spend();
      const BezierPiece piece = pieces[s];
      for (const bool behind : {false, true}) {
        const std::size_t i = s + 1 + (behind ? 1 : 0);
        const auto at = [&](std::size_t j) { return Points(points).subspan(j * spline.width, spline.width); };
        const std::vector<double> tangent = behind ? last_tangent(piece) : first_tangent(piece);
        agreement.of(tangent, combined(0.5, at(i + 1), -0.5, at(i - 1)));
      }
    }
    return agreement.within(tolerance, "uniform Catmull-Rom curve");
  };
  return points_of(spline, 1, budget, write);
}

Result<std::vector<double>> hermite_points(const Spline& spline, double tolerance, const Budget& budget) {
  const auto write = [&](const BezierPieces& pieces, std::vector<double>& points,
                         auto spend) -> Result<void> {
    Agreement agreement;
    std::vector<double> before;
    for (std::size_t s = 0; s < pieces.size(); ++s) {
      spend();
      const BezierPiece piece = pieces[s];
      const std::vector<double> tangent = first_tangent(piece);
      append(points, control(piece, 0));
      append(points, tangent);
      if (s > 0) agreement.of(before, tangent);
      before = last_tangent(piece);
    }
    const BezierPiece back = pieces[pieces.size() - 1];
    append(points, control(back, 3));
    append(points, before);
    return agreement.within(tolerance, "chain of Hermite segments with one tangent at every point");
  };
  return points_of(spline, 2, budget, write);
}

}  // namespace subdivd

#pragma once
// A B-spline curve of any degree p on any knot vector, rational (NURBS) or not: what every curve whose pieces
// are polynomials can be written as, and what all algorithms on knots work on.
//
//   C(t) = sum_i N_i,p(t) P_i,   n points, n + p + 1 knots u_0 <= ... <= u_{n+p}, domain [u_p, u_n]
//
// A rational curve is kept in homogeneous coordinates: P_i = (w_i x_i, w_i y_i, ..., w_i). Every algorithm
// that is linear in the points then needs to know nothing about weights.   [PieglTiller97, chapters 2 to 4]

#include <span>
#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/base/result.h"

namespace subdivd {

inline constexpr Index kMaxDegree = 63;

struct Spline {
  Index degree = 3;
  Index width = 3;             // scalars per stored point, the weight included
  bool rational = false;       // the last scalar of a point is its weight, and the others are times it
  bool periodic = false;       // t is taken modulo the length of the domain
  std::vector<double> knots;   // point_count() + degree + 1, ascending
  std::vector<double> points;  // width scalars per point

  Count point_count() const { return width == 0 ? 0 : points.size() / width; }
  // Coordinates of a point of the curve.
  Index dimension() const { return width - (rational ? 1 : 0); }
  double begin() const { return knots[degree]; }
  double end() const { return knots[point_count()]; }
  std::span<const double> point(Count i) const { return std::span(points).subspan(i * width, width); }

  // The first fault and its place ("degree", "points", "knots", "pointWeights", with indices of scalars,
  // knots, weights). Degree 1 to kMaxDegree; at least degree + 1 points; finite numbers; knots ascending, a
  // domain that is not empty, no knot inside it more than `degree` times nor any more than degree + 1 times;
  // weights above 0.
  Result<void> check(const Budget& budget = {}) const;
};

// How often `t` stands among the knots.
Index multiplicity(std::span<const double> knots, double t);

// The span k that holds t: u_k <= t < u_{k+1}, and the last one that is not empty for t = u_n. For t in the
// domain: degree <= k < n. Logarithmic in the number of knots.
Count find_span(const Spline& spline, double t);

// t itself, or of a periodic spline t modulo its period; out_of_range outside the domain, not_finite.
Result<double> check_parameter(const Spline& spline, double t);

// What goes through a whole curve takes a pace, and throws Stopped when that has no more to spend.

// The stored point of coordinates `point` and weight w, and back.
std::vector<double> to_homogeneous(std::span<const double> points, Index dimension,
                                   std::span<const double> weights, const Pace& pace = {});
// dimension() scalars per control point
std::vector<double> control_points_of(const Spline& spline, const Pace& pace = {});
// empty when it is not rational
std::vector<double> weights(const Spline& spline, const Pace& pace = {});

// Longest diagonal of the box around the control points: what tolerances are measured in.
double extent(const Spline& spline, const Pace& pace = {});

Spline copy_of(const Spline& spline, const Pace& pace);

}  // namespace subdivd

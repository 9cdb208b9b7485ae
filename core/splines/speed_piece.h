#pragma once
// How fast a piece of a curve is run through, and between what its length must lie. The formulas stand in
// arc_length.h.

#include <array>
#include <optional>
#include <vector>

#include "core/base/pace.h"
#include "core/splines/bezier.h"
#include "core/splines/bounds.h"
#include "core/splines/gauss_rule.h"
#include "core/splines/spline.h"

namespace subdivd {

// What the length of a piece is made of:  |C'(u)| = |N(u)| / w(u)^2  on 0 <= u <= 1, times `width`.
//   polynomial   N_i = p (P_{i+1} - P_i), degree p - 1, no weights
//   rational     N = p (A1 w0 - A0 w1), degree 2p - 2, where A0, A1 and w0, w1 are the first and the last p
//                control points and weights:  N_k = p sum_{i+j=k} b_ij w_{i+1} w_j (P_{i+1} - P_j)
//                [Floater92]
// Halving differences instead of points keeps rounding relative to the piece, however short it gets.
struct SpeedPiece {
  // Rows of dimension + 1: N, and the scale of its rounding (what |N| could have been).
  BezierPiece derivative;
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

// Measures pieces of one kind: the tables depend on degree, dimension and whether there are weights.
class Ruler {
 public:
  // Throws Stopped when the pace has no more to spend; it must outlive the ruler.
  Ruler(const Spline& spline, const Pace& pace)
      : pace_(pace),
        p_(spline.degree),
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

  // Of a spline with one span, in the unit of its local coordinates.
  SpeedPiece piece_of(const LocalSpline& local) const;
  std::array<SpeedPiece, 2> halves(const SpeedPiece& piece) const;
  // The part of it from u = `from` to u = `to`, 0 <= from <= to <= 1; its parameters are not kept.
  SpeedPiece part(const SpeedPiece& piece, double from, double to) const;
  // Between what its length lies: the intersection of the two intervals of arc_length.h.
  Interval measure(const SpeedPiece& piece) const;
  // |C'| at the end, per unit of u, without `width`.
  double speed_at_end(const SpeedPiece& piece) const;

 private:
  Index row_width() const { return dimension_ + 1; }
  double length_of_row(const SpeedPiece& piece, Count i) const;
  std::vector<double> square_of(const SpeedPiece& piece) const;
  std::optional<double> gauss_error(const SpeedPiece& piece) const;
  double gauss_sum(const SpeedPiece& piece) const;

  const Pace& pace_;
  Index p_, dimension_;
  bool rational_;
  Index n_;  // degree of N
  GaussRule rule_;
  std::vector<double> derivative_table_, weight_table_, square_weights_;
  std::vector<double> square_chebyshev_, weight_chebyshev_, pair_weights_;
};

}  // namespace subdivd

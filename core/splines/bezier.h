#pragma once
// Bezier pieces: one polynomial (or quotient of two) each, inside the convex hull of its control points. What
// bounds, distances and lengths are worked out on.

#include <array>
#include <span>
#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/splines/spline.h"

namespace subdivd {

// One piece of a spline over [begin, end]: degree + 1 points of `width` scalars, homogeneous where the spline
// is rational.
struct BezierPiece {
  double begin = 0, end = 1;
  std::vector<double> points;
};

// All pieces, in order, by inserting every knot until it stands `degree` times.   [PieglTiller97, A5.6]
std::vector<BezierPiece> bezier_pieces(const Spline& spline);

// The same of a long curve: what is kept is the curve with its knots inserted, a piece is made when it is
// asked for. Millions of small arrays would take half a second to be made, and to be given back.
class BezierPieces {
 public:
  Count size() const { return spans_.size(); }
  double begin(Count i) const { return refined_.knots[spans_[i]]; }
  double end(Count i) const { return refined_.knots[spans_[i] + 1]; }
  // degree + 1 points.
  std::span<const double> points(Count i) const;
  BezierPiece operator[](Count i) const;

 private:
  friend Result<BezierPieces> bezier_pieces(const Spline& spline, const Budget& budget);
  Spline refined_;
  std::vector<Count> spans_;  // the knots that the pieces begin at
};
// Within a budget: takes the memory before it allocates it, and polls.
Result<BezierPieces> bezier_pieces(const Spline& spline, const Budget& budget);

// The two halves of a piece.   [de Casteljau]
std::array<BezierPiece, 2> halves(const BezierPiece& piece, Index width);
// The piece at the parameter `t` of the spline, begin <= t <= end: width scalars, homogeneous.
void evaluate(const BezierPiece& piece, Index width, double t, std::span<double> point);

// Coordinates of control point i: divided by the weight where there is one.
void project(std::span<const double> stored, bool rational, std::span<double> coordinates);

// A spline of pieces of one degree that follow one another: every inner knot stands `degree` times. The last
// point of a piece and the first of the next must agree (assumed; the next one's is taken).
class PieceChain {
 public:
  // Makes room for `pieces` of them.
  PieceChain(Index degree, Index width, bool rational, Count pieces);

  void add(const BezierPiece& piece);
  Spline finish();  // one piece at least has been added

 private:
  Spline spline_;
};
Spline spline_of(std::span<const BezierPiece> pieces, Index degree, Index width, bool rational);

}  // namespace subdivd

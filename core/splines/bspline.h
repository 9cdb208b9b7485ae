#pragma once
// B-spline basis functions and the points and derivatives of a spline. Each touches degree + 1 control points, so
// the cost does not depend on how many there are (but for the search of the span).

#include <span>
#include <utility>
#include <vector>

#include "core/base/index.h"
#include "core/base/result.h"
#include "core/splines/spline.h"

namespace subdivd {

// The degree + 1 basis functions that do not vanish on span `span`, N_{span-p}(t), ..., N_span(t), into
// values[0..p]. They sum to 1. The span is not empty, knots[span] < knots[span + 1], and degree <= span; t may lie
// anywhere in it.   [Cox72; deBoor72; PieglTiller97, A2.2]
void basis_functions(std::span<const double> knots, Index degree, Count span, double t,
                     std::span<double> values);

// The same and their derivatives of order 1 to `order`: row d of values, (p + 1) numbers long, holds the d-th
// derivatives; rows above the degree are 0.   [PieglTiller97, A2.3]
void basis_derivatives(std::span<const double> knots, Index degree, Count span, double t, Index order,
                       std::span<double> values);

// The point at t, dimension() coordinates. `spline` must have passed check(). Fails as check_parameter, and
// with out_of_range when a coordinate outgrows a double.
Result<void> evaluate(const Spline& spline, double t, std::span<double> point);

// Point and derivatives by t of order 1 to `order`: order + 1 rows of dimension() numbers. At a knot where
// the curve has a kink they are those of the piece behind it, at the domain's end of the piece before.
// Rational curves by the quotient rule: C^(d) = (A^(d) - sum_i binom(d, i) w^(i) C^(d-i)) / w.
//   [PieglTiller97, A3.2, A4.2]
Result<void> derivatives(const Spline& spline, double t, Index order, std::span<double> rows);

// The blossom of the piece on span `span`: the function of degree p that is affine in each of its p
// arguments, does not mind their order, and is the curve where all of them are t. Every control point is the
// blossom of the knots behind it, P_i = f(u_{i+1}, ..., u_{i+p}).   [Ramshaw87] `weights`: those of the
// degree + 1 points on the span, span - p to span; they sum to 1. Returns the range [begin, end) outside of
// which all of them are 0: arguments that are knots leave few, and take less time.
std::pair<Index, Index> blossom_weights(std::span<const double> knots, Index degree, Count span,
                                        std::span<const double> arguments, std::span<double> weights);

// Points at many parameters: what does not depend on t is worked out once, and finding the span takes the
// same time however many there are, but where knots crowd together in one part of the domain. Cubics without
// weights are kept as one polynomial per span.
class SplineEvaluator {
 public:
  explicit SplineEvaluator(const Spline& spline);

  Index dimension() const { return dimension_; }
  // ts.size() points into `points`, dimension() coordinates each; each t in [begin(), end()] (assumed: see
  // check_parameter).
  void evaluate(std::span<const double> ts, std::span<double> points) const;

 private:
  void divide_domain(Count cells);
  void set_cubics(const Spline& spline);
  struct Search;
  template <Index kWidth, bool kFew>
  void evaluate_cubic(std::span<const double> ts, std::span<double> points) const;
  void evaluate_any(std::span<const double> ts, std::span<double> points) const;

  Index degree_, width_, dimension_;
  bool rational_;
  std::vector<double> knots_, points_;
  std::vector<double> breaks_;        // where the spans that are not empty begin, and the last one ends
  std::vector<Index> spans_;          // and which knot begins them
  std::vector<Index> first_in_cell_;  // of every cell of the domain: the span that its begin lies in
  Index most_in_cell_ = 0;            // breaks within one cell
  double cells_per_unit_ = 0;
  std::vector<double> cubics_;  // per span and coordinate four coefficients, by (t - begin) / length
  std::vector<double> inverse_lengths_;
};

}  // namespace subdivd

#pragma once
// Gauss-Legendre quadrature on [0, 1], and where around it a polynomial stays close to its mean: the two that
// bound an integral of its root.

#include <span>
#include <vector>

#include "core/base/index.h"

namespace subdivd {

// m nodes x, ascending, and weights, which are positive and sum to 1.   [Trefethen13, chapter 19]
struct GaussRule {
  std::vector<double> nodes, weights;
  explicit GaussRule(Index m);
};

// B_k(x) of degree n at every node, n + 1 numbers each.
std::vector<double> bernstein_table(std::span<const double> nodes, Index n);

// From Bernstein to Chebyshev coefficients: row k holds the k-th ones of B_0, ..., B_D, as polynomials of
// degree D are interpolated in the D + 1 zeros of T_{D+1}.   [Trefethen13]
std::vector<double> chebyshev_table(Index degree);

// An ellipse around [0, 1], with foci at its ends and axes of rho +- 1/rho over 2, inside which a polynomial
// f keeps to |f - mean| <= share * mean. rho is 1 where there is none.
struct Ellipse {
  double mean = 0, rho = 1;
};

// Of the polynomial with these Bernstein coefficients; `table`: chebyshev_table of its degree.
Ellipse ellipse_of(std::span<const double> bernstein, std::span<const double> table, double share);

}  // namespace subdivd

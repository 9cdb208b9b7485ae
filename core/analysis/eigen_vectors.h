#pragma once
// Eigenvectors: all that belong to a value, for matrices that need not be diagonalizable.

#include <optional>

#include "core/analysis/eigen.h"
#include "core/analysis/matrix.h"
#include "core/base/budget.h"
#include "core/base/result.h"

namespace subdivd {

// What is known of the matrix when vectors are looked for.
struct Reduced {
  const Matrix& balanced;
  const Vector& diagonal;  // balanced = diagonal^-1 matrix diagonal / scale
  const Matrix& q;
  const Matrix& h;  // = q^T balanced q
  double scale;
  double norm;       // of h
  double tolerance;  // of a residual that counts as 0
  const Budget& budget;
};

// The vectors of an eigenvalue at `value` that stands `count` times; nullopt when no single one does. The
// value comes back as exact as its vectors make it, and vectors that fit to it.
Result<std::optional<EigenSpace>> space_at(const Reduced& m, double value, Index count);

}  // namespace subdivd

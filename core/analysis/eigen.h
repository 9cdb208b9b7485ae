#pragma once
// Eigenvalues and eigenvectors of small real matrices whose eigenvalues are real, as those of subdivision
// rules mostly are: rows of masks that are neither symmetric nor, always, diagonalizable.

#include <span>
#include <vector>

#include "core/base/budget.h"
#include "core/base/result.h"

namespace subdivd {

inline constexpr Index kMaxEigenSize = 512;

// One eigenvalue with all vectors that belong to it.
struct EigenSpace {
  double value = 0;
  Index multiplicity = 1;  // as a root of the characteristic polynomial
  // Independent eigenvectors: `multiplicity` of them, or fewer where the matrix has Jordan blocks.
  Index dimension = 1;
  // `dimension` rows each: vectors x of length 1 with A x = value x, and y with y A = value y. Where
  // dimension is multiplicity y_i . x_j is 1 for i = j and 0 else; where it is less, the y are of length 1.
  std::vector<double> right, left;
};

struct EigenSystem {
  Index size = 0;
  std::vector<EigenSpace> spaces;  // by |value|, descending; of exactly opposite ones the positive first
};

// The eigenvalues of `matrix` (row major, `size` rows) and their vectors. Eigenvalues that rounding cannot
// tell apart come as one of higher multiplicity, with as many independent vectors as there are.
//   balancing, Hessenberg form, Francis' double steps for the values [GolubVanLoan13, 7.4 and 7.5;
//   ParlettReinsch69; Francis61]; inverse iteration of whole spaces for the vectors [PetersWilkinson79]
// Takes some 50 size^3 operations, about a second for 300 rows, three where all values are equal. Refuses
// sizes of 0 or over kMaxEigenSize (out_of_range, too_large), a span that is not size^2 long (wrong_length),
// numbers that are not finite (not_finite), and, as unsupported, matrices with complex eigenvalues or with
// Jordan blocks of more than two rows.
Result<EigenSystem> eigen_system(std::span<const double> matrix, Index size, const Budget& budget);

}  // namespace subdivd

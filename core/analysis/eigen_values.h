#pragma once
// Eigenvalues: from a matrix to a Hessenberg one, and from there to its eigenvalues.

#include <complex>
#include <optional>
#include <vector>

#include "core/analysis/matrix.h"
#include "core/base/budget.h"
#include "core/base/result.h"

namespace subdivd {

// Makes D^-1 A D of A, D being a diagonal of powers of 2, so that rows and columns are about equally large.
// Returns D.   [ParlettReinsch69]
Vector balance(Matrix& m);

// Makes H = Q^T A Q of A, 0 below the first subdiagonal; returns Q in `q`.   [GolubVanLoan13, 7.4.2]
std::optional<Error> to_hessenberg(Matrix& m, Matrix& q, const Budget& budget);

// All eigenvalues of a Hessenberg matrix, in no particular order, complex ones in pairs. internal: not found
// within the steps that any known matrix takes.   [Francis61; GolubVanLoan13, 7.5]
Result<std::vector<std::complex<double>>> eigenvalues(Matrix h, const Budget& budget);

}  // namespace subdivd

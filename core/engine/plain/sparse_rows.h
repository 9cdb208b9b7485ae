#pragma once
// A refinement step as a matrix of which few entries are not zero: a row for every new value, a column for
// every old one.

#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"

namespace subdivd::plain {

struct SparseRows {
  std::vector<Count> offsets = {0};  // where each row begins in `columns` and `weights`, and the last ends
  std::vector<Index> columns;
  std::vector<double> weights;

  Count row_count() const { return offsets.size() - 1; }
  void add(Index column, double weight) {
    columns.push_back(column);
    weights.push_back(weight);
  }
  void end_row() { offsets.push_back(columns.size()); }
};

// The new values, `width` scalars each, from `values`, as many for every column. Sums go in the order of the
// entries, weights are rounded to Real first. Instantiated for float and double.
template <class Real>
std::vector<Real> apply(const SparseRows& rows, std::span<const Real> values, Index width,
                        const Pace& pace = {});
// Into `out`, which has room for them.
template <class Real>
void apply(const SparseRows& rows, std::span<const Real> values, Index width, Real* out, const Pace& pace);

}  // namespace subdivd::plain

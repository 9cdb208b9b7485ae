#pragma once
// A step, or a set of limits, as rows of which many may be long: all corners of a face of 100,000 see one another,
// and so do all edges at such a vertex. What these rows have in common is summed first, once.

#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/engine/plain/sparse_rows.h"

namespace subdivd::plain {

struct StepRows {
  Index old_count = 0;  // values that a row may take: the columns 0..old_count - 1
  SparseRows sums;      // of those
  SparseRows rows;      // of those, and, as columns from old_count on, of the sums
};

// The new values, `width` scalars each. Instantiated for float and double.
template <class Real>
std::vector<Real> apply(const StepRows& step, std::span<const Real> values, Index width,
                        const Pace& pace = {});
// Into `out`, which has room for them.
template <class Real>
void apply(const StepRows& step, std::span<const Real> values, Index width, Real* out, const Pace& pace);

// Faces and rings of more than these are summed first.
inline constexpr Index kShortRow = 16;

// Writes the rows of a step one after the other. A row may take one column several times: the weights are added up.
class RowMaker {
 public:
  RowMaker(Index old_count, const Pace& pace) : pace_(pace) {
    step_.old_count = old_count;
    pace.fill(place_, old_count, kNowhere);
  }

  void add(Index column, double weight);
  void add_sum(Index sum, double weight);  // sum: a number that end_sum() gave
  void end_row();

  // Sums are written in the same way, each column once, while no row is begun.
  void add_to_sum(Index column, double weight) { step_.sums.add(column, weight); }
  Index end_sum();

  StepRows take() { return std::move(step_); }
  const Pace& pace() const { return pace_; }

 private:
  static constexpr Count kNowhere = ~Count{0};
  const Pace& pace_;
  StepRows step_;
  std::vector<Count> place_;  // of a column in the row that is written; sums behind the old values
};

}  // namespace subdivd::plain

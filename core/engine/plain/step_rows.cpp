#include "core/engine/plain/step_rows.h"

namespace subdivd::plain {

template <class Real>
void apply(const StepRows& step, std::span<const Real> values, Index width, Real* out, const Pace& pace) {
  if (step.sums.row_count() == 0) return apply<Real>(step.rows, values, width, out, pace);
  std::vector<Real> all;
  all.reserve((step.old_count + step.sums.row_count()) * width);
  const auto old = values.first(Count{step.old_count} * width);
  pace.append(old, all);
  pace.append(apply<Real>(step.sums, values, width, pace), all);
  apply<Real>(step.rows, std::span<const Real>(all), width, out, pace);
}

template <class Real>
std::vector<Real> apply(const StepRows& step, std::span<const Real> values, Index width, const Pace& pace) {
  std::vector<Real> result;
  pace.fill(result, step.rows.row_count() * width, Real(0));
  apply<Real>(step, values, width, result.data(), pace);
  return result;
}

template void apply(const StepRows&, std::span<const float>, Index, float*, const Pace&);
template void apply(const StepRows&, std::span<const double>, Index, double*, const Pace&);
template std::vector<float> apply(const StepRows&, std::span<const float>, Index, const Pace&);
template std::vector<double> apply(const StepRows&, std::span<const double>, Index, const Pace&);

void RowMaker::add(Index column, double weight) {
  pace_.spend(1);
  if (weight == 0) return;
  if (place_[column] == kNowhere) {
    place_[column] = step_.rows.columns.size();
    step_.rows.add(column, weight);
  } else {
    step_.rows.weights[place_[column]] += weight;
  }
}

void RowMaker::add_sum(Index sum, double weight) { add(step_.old_count + sum, weight); }

void RowMaker::end_row() {
  for (Count k = step_.rows.offsets.back(); k < step_.rows.columns.size(); ++k)
    place_[step_.rows.columns[k]] = kNowhere;
  step_.rows.end_row();
}

Index RowMaker::end_sum() {
  pace_.spend(step_.sums.columns.size() - step_.sums.offsets.back());
  step_.sums.end_row();
  place_.push_back(kNowhere);
  return static_cast<Index>(step_.sums.row_count() - 1);
}

}  // namespace subdivd::plain

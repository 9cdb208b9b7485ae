#include "core/engine/plain/sparse_rows.h"

namespace subdivd::plain {

template <class Real>
void apply(const SparseRows& rows, std::span<const Real> values, Index width, Real* out, const Pace& pace) {
  for (Count row = 0; row < rows.row_count(); ++row, out += width) {
    pace.spend(1);
    for (Index c = 0; c < width; ++c) out[c] = 0;
    for (Count k = rows.offsets[row]; k < rows.offsets[row + 1]; ++k) {
      pace.spend(width);
      const auto weight = static_cast<Real>(rows.weights[k]);
      const Real* from = values.data() + Count{rows.columns[k]} * width;
      for (Index c = 0; c < width; ++c) out[c] += weight * from[c];
    }
  }
}

template <class Real>
std::vector<Real> apply(const SparseRows& rows, std::span<const Real> values, Index width, const Pace& pace) {
  std::vector<Real> result;
  pace.fill(result, rows.row_count() * width, Real(0));
  apply(rows, values, width, result.data(), pace);
  return result;
}

template void apply(const SparseRows&, std::span<const float>, Index, float*, const Pace&);
template void apply(const SparseRows&, std::span<const double>, Index, double*, const Pace&);
template std::vector<float> apply(const SparseRows&, std::span<const float>, Index, const Pace&);
template std::vector<double> apply(const SparseRows&, std::span<const double>, Index, const Pace&);

}  // namespace subdivd::plain

#pragma once
// Arrays of numbers on their way into Far and out of it. Includes no OpenSubdiv.

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/base/result.h"

namespace subdivd::oracle {

// Rows of `width` scalars, as Far's templates want to see them. Refers to `values`. Every row that Far asks
// for counts as its width in steps, so that Far's loops stop when the budget says so.
template <class Real>
class Rows {
 public:
  Rows(Buffer<Real>& values, Index width, const Pace& pace)
      : data_(values.data()), width_(width), pace_(&pace) {}

  class Row {
   public:
    Row(Real* data, Index width) : data_(data), width_(width) {}
    void Clear() { std::fill_n(data_, width_, Real(0)); }
    // Far passes its weights as Real, float or double literals.
    template <class Weight>
    void AddWithWeight(const Row& from, Weight weight) {
      for (Index k = 0; k < width_; ++k) data_[k] += static_cast<Real>(weight) * from.data_[k];
    }

   private:
    Real* data_;
    Index width_;
  };

  Row operator[](int i) const {
    pace_->spend(width_);
    return {data_ + static_cast<std::size_t>(i) * width_, width_};
  }

 private:
  Real* data_;
  Index width_;
  const Pace* pace_;
};

// The values in Real; out_of_range at `where` when one does not fit.
template <class Real>
Result<Buffer<Real>> convert_values(std::span<const double> values, Path where, const Pace& pace) {
  Buffer<Real> result(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    pace.spend(1);
    if (std::abs(values[k]) > static_cast<double>(std::numeric_limits<Real>::max()))
      return Error{ErrorCode::out_of_range, "a number is too large for single precision", std::move(where)};
    result[k] = static_cast<Real>(values[k]);
  }
  return result;
}

}  // namespace subdivd::oracle

#pragma once
// One step of a curve's scheme, whichever it is, on a run of points.

#include <vector>

#include "core/curves/curve_window.h"
#include "core/curves/kernels/curve_kernels.h"

namespace subdivd {

template <class Real>
class CurveStep {
 public:
  // `curve` must outlive it.
  explicit CurveStep(const Curve<Real>& curve);

  // Children `wanted` (consecutive, existing) of the points in `from`, which holds as many on either side as
  // the scheme reaches, into `to`; ends of pinned primal curves stay. `children_there`: of the whole curve.
  void split(const Window<Real>& from, Place children_there, Places wanted, Real* to);

 private:
  void split_all(const Real* self, Count points, Real* to);
  void split_in_chunks(const Real* self, Count points, Real* to);

  const Curve<Real>& curve_;
  kernels::SplitPoints<Real> kernel_ = nullptr;  // there is none: wide points, high degrees
  double parameter_ = 0;
  Count chunk_;                       // points between two interleavings
  std::vector<Real> first_, second_;  // scratch: children of a chunk, apart
};

}  // namespace subdivd

#pragma once
// Limits and tangents of a refined curve's points.

#include <vector>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/curves/control_curve.h"
#include "core/curves/curve_window.h"

namespace subdivd {

// Of the scheme of `curves`.
LimitMasks masks_of(const ControlCurves& curves);

// Of one curve on one level; `core` holds its n core points. curve, masks and core must outlive it.
template <class Real>
class LimitPass {
 public:
  LimitPass(const Curve<Real>& curve, const LimitMasks& masks, Index level, const Real* core, Place n);

  // Into `to`, n core points; ends of pinned dual curves are the caller's.
  Result<void> limits(const Budget& budget, Real* to);
  Result<void> tangents(const Budget& budget, Real* to);
  // The tangent at the first or last point of a pinned curve.
  void end_tangent(bool last, Real* to);

 private:
  template <class Body>
  Result<void> in_blocks(const std::vector<double>& mask, const Budget& budget, Real* to, Body&& body);
  template <class Visit>
  void for_each_special(const std::vector<double>& mask, Visit&& visit);
  void mend_limits(Real* to);
  void mend_tangents(Real* to);

  const Curve<Real>& curve_;
  const LimitMasks& masks_;
  double scale_;  // units of the level's parameter in one of the control parameter
  const Real* core_;
  Place n_;
  Window<Real> window_;
};

}  // namespace subdivd

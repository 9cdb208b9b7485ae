#pragma once
// What holds along one direction of a B-spline surface, and its normal: what refinement and evaluation share.
// Inside core/surfaces only.

#include <array>
#include <limits>

#include "core/surfaces/patch.h"

namespace subdivd {

// One of the two directions of a grid: n points, one after the other.
struct Direction {
  CurveWrap wrap;
  Index degree;
  Count n;

  bool open() const { return wrap != CurveWrap::periodic; }
  bool ends_at(Count i) const { return open() && (i == 0 || i + 1 == n); }
  bool pinned_quadratic() const { return wrap == CurveWrap::pinned && degree == 2; }
  Count before(Count i) const { return i == 0 ? n - 1 : i - 1; }
  Count after(Count i) const { return i + 1 == n ? 0 : i + 1; }
  Count segments() const { return open() ? n - 1 : n; }
};

inline Direction u_of(const ControlPatch& patch) { return {patch.u_wrap, patch.u_degree, patch.u_count}; }
inline Direction v_of(const ControlPatch& patch) { return {patch.v_wrap, patch.v_degree, patch.v_count}; }

// A new value as a sum of three old ones. Ends before the middle, so that equal values give exactly
// themselves; a weight of 0 stands at an index that exists.
struct Taps {
  Count at[3];
  double weight[3];
};

// Point i of the next level, its limit, and its tangent by the parameter of this level.
Taps step_taps(const Direction& d, Count i);
Taps limit_taps(const Direction& d, Count i);
Taps tangent_taps(const Direction& d, Count i);

// (du x dv) / |du x dv|, or 0 where rounding alone could have made that product. A component of a tangent is
// off by no more than some units in the last place of the coordinates it is the difference of, and those are
// no larger than the point's and what the tangents lead to; `scale` parameters of the refined grid make one
// of the control grid, and multiply what is lost with them.
std::array<double, 3> normal_of(const std::array<double, 3>& at, const std::array<double, 3>& du,
                                const std::array<double, 3>& dv, double scale, double epsilon);

template <class Real>
std::array<Real, 3> normal_of(const Real* at, const Real* du, const Real* dv, Index level) {
  const auto n =
      normal_of({double(at[0]), double(at[1]), double(at[2])}, {double(du[0]), double(du[1]), double(du[2])},
                {double(dv[0]), double(dv[1]), double(dv[2])}, static_cast<double>(Count{1} << level),
                std::numeric_limits<Real>::epsilon());
  return {static_cast<Real>(n[0]), static_cast<Real>(n[1]), static_cast<Real>(n[2])};
}

}  // namespace subdivd

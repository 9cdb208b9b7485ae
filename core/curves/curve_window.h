#pragma once
// One curve while it is refined: runs of its points on one level, those beyond its ends included.

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/curves/control_curve.h"

namespace subdivd {

// Index of a point; points that continue a curve have places below 0 or from n on.
using Place = std::int64_t;

struct Places {
  Place begin = 0, end = 0;  // [begin, end)
};

// What stays the same over all levels of one curve. Places and counts are those of its *core*: all points,
// but of a pinned dual curve without its two ends.
template <class Real>
struct Curve {
  const ControlCurves* rule;
  CurveSplit split;
  CurveWrap wrap;
  Index width;
  std::vector<Real> ends;  // pinned: the first and the last point

  bool pinned() const { return wrap == CurveWrap::pinned; }
  bool has_outer_ends() const { return pinned() && split.dual; }
  // Children that are missing at the front.
  Place missing() const { return wrap == CurveWrap::nonperiodic ? split.lost / 2 : 0; }
};

// The curve of the control points `control`, a curve of `rule`, which must outlive it; and its core.
template <class Real>
Curve<Real> curve_of(const ControlCurves& rule, std::span<const double> control);
template <class Real>
std::span<const double> core_of(const Curve<Real>& curve, std::span<const double> control);

// A run of points of one level; grows, but keeps its memory.
template <class Real>
struct Window {
  Places places;
  std::vector<Real> scalars;

  void reset(Places wanted, Index width) {
    places = wanted;
    const Count size = static_cast<Count>(wanted.end - wanted.begin) * width;
    if (scalars.size() < size) scalars.resize(size);
  }
  Real* at(Place place, Index width) { return scalars.data() + offset(place, width); }
  const Real* at(Place place, Index width) const { return scalars.data() + offset(place, width); }
  Count offset(Place place, Index width) const { return static_cast<Count>(place - places.begin) * width; }
};

// The places of a level of n points that `wanted` stands for: those that a point can be stored for.
template <class Real>
Places existing(const Curve<Real>& curve, Places wanted, Place n);

// Fills the places of the window below 0 and from n on; those between are there. The sources of a pinned
// curve's lie as far inside an end as they beyond it, and must be in the window.
template <class Real>
void continue_curve(const Curve<Real>& curve, Place n, Window<Real>& window);

// Fills a window from all n points of its level.
template <class Real, class From>
void load(const Curve<Real>& curve, const From* points, Place n, Places wanted, Window<Real>& window);

}  // namespace subdivd

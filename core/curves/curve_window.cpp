#include "core/curves/curve_window.h"

#include <algorithm>

namespace subdivd {
namespace {

// The point at a place beyond the ends of a pinned curve of n core points. The symmetry about both ends gives
// every place: with L = n - 1 steps between the ends (n of dual curves) and place = g L + u, 0 <= u < L,
//   g even   c_u + g (b - a)                                     a, b: first and last point
//   g < 0    (a + (a - c_{L-u})) + (g + 1) (b - a)   g odd       (c_{n-1-u} in either numbering)
//   g > 0    (b + (b - c_{L-u})) + (g - 1) (b - a)
template <class Real>
void continue_at(const Curve<Real>& curve, Place n, Place place, Window<Real>& window) {
  const Place length = curve.split.dual ? n : n - 1;
  Place cell = place / length;
  if (cell * length > place) --cell;
  const Place rest = place - cell * length;
  const bool mirrored = cell % 2 != 0;
  const Real turns = static_cast<Real>(mirrored ? (cell < 0 ? cell + 1 : cell - 1) : cell);
  const Real* source = window.at(mirrored ? n - 1 - rest : rest, curve.width);
  const Real *a = curve.ends.data(), *b = a + curve.width;
  const Real* centre = cell < 0 ? a : b;
  Real* to = window.at(place, curve.width);
  for (Index k = 0; k < curve.width; ++k) {
    to[k] = mirrored ? centre[k] + (centre[k] - source[k]) : source[k];
    if (turns != 0) to[k] += turns * (b[k] - a[k]);
  }
}

}  // namespace

template <class Real>
Curve<Real> curve_of(const ControlCurves& rule, std::span<const double> control) {
  const Index width = rule.width;
  Curve<Real> curve{&rule, split_of(rule), rule.wrap, width, {}};
  if (!curve.pinned()) return curve;
  const auto put = [](double value) { return static_cast<Real>(value); };
  curve.ends.resize(Count{2} * width);
  std::transform(control.begin(), control.begin() + width, curve.ends.begin(), put);
  std::transform(control.end() - width, control.end(), curve.ends.begin() + width, put);
  return curve;
}

template <class Real>
std::span<const double> core_of(const Curve<Real>& curve, std::span<const double> control) {
  const Count outer = curve.has_outer_ends() ? curve.width : 0;
  return control.subspan(outer, control.size() - 2 * outer);
}

// Nonperiodic curves get copies of their ends, which only children take that are thrown away.
template <class Real>
void continue_curve(const Curve<Real>& curve, Place n, Window<Real>& window) {
  const auto fill = [&](Place place) {
    if (curve.pinned())
      continue_at(curve, n, place, window);
    else
      std::copy_n(window.at(place < 0 ? 0 : n - 1, curve.width), curve.width, window.at(place, curve.width));
  };
  for (Place place = window.places.begin; place < std::min<Place>(window.places.end, 0); ++place) fill(place);
  for (Place place = std::max(window.places.begin, n); place < window.places.end; ++place) fill(place);
}

template <class Real>
Places existing(const Curve<Real>& curve, Places wanted, Place n) {
  if (curve.wrap == CurveWrap::periodic) return wanted;
  return {std::max<Place>(wanted.begin, 0), std::min(wanted.end, n)};
}

// Fills a window from all n points of its level.
template <class Real, class From>
void load(const Curve<Real>& curve, const From* points, Place n, Places wanted, Window<Real>& window) {
  window.reset(wanted, curve.width);
  const Places there = existing(curve, wanted, n);
  for (Place place = there.begin; place < there.end;) {
    const Place index = (place % n + n) % n;
    const Place run = std::min(there.end - place, n - index);
    const From* from = points + static_cast<Count>(index) * curve.width;
    std::transform(from, from + static_cast<Count>(run) * curve.width, window.at(place, curve.width),
                   [](From value) { return static_cast<Real>(value); });
    place += run;
  }
  if (curve.wrap != CurveWrap::periodic) continue_curve(curve, n, window);
}

template Curve<float> curve_of(const ControlCurves&, std::span<const double>);
template Curve<double> curve_of(const ControlCurves&, std::span<const double>);
template std::span<const double> core_of(const Curve<float>&, std::span<const double>);
template std::span<const double> core_of(const Curve<double>&, std::span<const double>);
template Places existing(const Curve<float>&, Places, Place);
template Places existing(const Curve<double>&, Places, Place);
template void continue_curve(const Curve<float>&, Place, Window<float>&);
template void continue_curve(const Curve<double>&, Place, Window<double>&);
template void load(const Curve<float>&, const double*, Place, Places, Window<float>&);
template void load(const Curve<float>&, const float*, Place, Places, Window<float>&);
template void load(const Curve<double>&, const double*, Place, Places, Window<double>&);

}  // namespace subdivd

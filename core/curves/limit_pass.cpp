#include "core/curves/limit_pass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/curves/block_refiner.h"

namespace subdivd {
namespace {

// Pairs from the outside inwards, weights before sums; the masks stand in LimitMasks.
template <class Real>
void limits_at(const std::vector<double>& values, std::ptrdiff_t step, const Real* self, Count scalars,
               Real* to) {
  const std::size_t outermost = values.size() - 1;
  for (std::size_t distance = outermost; distance > 0; --distance) {
    const Real weight = static_cast<Real>(values[distance]);
    const std::ptrdiff_t away = static_cast<std::ptrdiff_t>(distance) * step;
    const Real *before = self - away, *after = self + away;
    if (distance == outermost)
      for (Count k = 0; k < scalars; ++k) to[k] = before[k] * weight + after[k] * weight;
    else
      for (Count k = 0; k < scalars; ++k) to[k] += before[k] * weight + after[k] * weight;
  }
  const Real weight = static_cast<Real>(values[0]);
  if (outermost == 0)
    for (Count k = 0; k < scalars; ++k) to[k] = self[k] * weight;
  else
    for (Count k = 0; k < scalars; ++k) to[k] += self[k] * weight;
}

template <class Real>
void tangents_at(const std::vector<double>& slopes, double scale, std::ptrdiff_t step, const Real* self,
                 Count scalars, Real* to) {
  const std::size_t outermost = slopes.size() - 1;
  for (std::size_t distance = outermost; distance > 0; --distance) {
    const Real weight = static_cast<Real>(slopes[distance] * scale);
    const std::ptrdiff_t away = static_cast<std::ptrdiff_t>(distance) * step;
    const Real *before = self - away, *after = self + away;
    if (distance == outermost)
      for (Count k = 0; k < scalars; ++k) to[k] = (after[k] - before[k]) * weight;
    else
      for (Count k = 0; k < scalars; ++k) to[k] += (after[k] - before[k]) * weight;
  }
}

}  // namespace

template <class Real>
LimitPass<Real>::LimitPass(const Curve<Real>& curve, const LimitMasks& masks, Index level, const Real* core,
                           Place n)
    : curve_(curve), masks_(masks), scale_(std::ldexp(1.0, static_cast<int>(level))), core_(core), n_(n) {}

template <class Real>
Result<void> LimitPass<Real>::limits(const Budget& budget, Real* to) {
  auto done = in_blocks(masks_.values, budget, to, [this](Place begin, Count scalars, Real* at) {
    limits_at(masks_.values, curve_.width, window_.at(begin, curve_.width), scalars, at);
  });
  if (done) mend_limits(to);
  return done;
}

template <class Real>
Result<void> LimitPass<Real>::tangents(const Budget& budget, Real* to) {
  auto done = in_blocks(masks_.slopes, budget, to, [this](Place begin, Count scalars, Real* at) {
    tangents_at(masks_.slopes, scale_, curve_.width, window_.at(begin, curve_.width), scalars, at);
  });
  if (done) mend_tangents(to);
  return done;
}

template <class Real>
void LimitPass<Real>::end_tangent(bool last, Real* to) {
  const Index width = curve_.width;
  const Place inwards = last ? -1 : 1, outermost = last ? n_ - 1 : 0;
  const Place away = static_cast<Place>(masks_.end_slopes.size());
  load(curve_, core_, n_, last ? Places{n_ - 1 - away, n_} : Places{0, away + 1}, window_);
  const Real* end = curve_.ends.data() + (last ? width : 0);
  std::fill_n(to, width, Real(0));
  for (Place k = away; k > 0; --k) {
    const Real* point = window_.at(outermost + inwards * (curve_.split.dual ? k - 1 : k), width);
    const Real weight = static_cast<Real>(masks_.end_slopes[static_cast<std::size_t>(k - 1)] * scale_);
    for (Index c = 0; c < width; ++c) to[c] += (last ? end[c] - point[c] : point[c] - end[c]) * weight;
  }
}

template <class Real>
template <class Body>
Result<void> LimitPass<Real>::in_blocks(const std::vector<double>& mask, const Budget& budget, Real* to,
                                        Body&& body) {
  const Place reach = static_cast<Place>(mask.size()) - 1;
  const Place block = static_cast<Place>(points_of_block(curve_.width));
  for (Place begin = 0; begin < n_; begin += block) {
    if (auto stop = budget.poll()) return *stop;
    const Place end = std::min(begin + block, n_);
    load(curve_, core_, n_, {begin - reach, end + reach}, window_);
    Real* at = to + static_cast<Count>(begin) * curve_.width;
    body(begin, static_cast<Count>(end - begin) * curve_.width, at);
  }
  return {};
}

// What is special: the points of a nonperiodic curve that lack neighbours, and the ends of a pinned primal
// curve.
template <class Real>
template <class Visit>
void LimitPass<Real>::for_each_special(const std::vector<double>& mask, Visit&& visit) {
  if (curve_.wrap == CurveWrap::periodic || curve_.has_outer_ends()) return;
  const Place reach = curve_.pinned() ? 1 : static_cast<Place>(mask.size()) - 1;
  for (Place place = 0; place < reach; ++place) visit(place);
  for (Place place = n_ - reach; place < n_; ++place) visit(place);
}

template <class Real>
void LimitPass<Real>::mend_limits(Real* to) {
  for_each_special(masks_.values, [&](Place place) {
    const Count offset = static_cast<Count>(place) * curve_.width;
    std::copy_n(core_ + offset, curve_.width, to + offset);
  });
}

template <class Real>
void LimitPass<Real>::mend_tangents(Real* to) {
  const Index width = curve_.width;
  for_each_special(masks_.slopes, [&](Place place) {
    Real* at = to + static_cast<Count>(place) * width;
    if (curve_.pinned()) return end_tangent(place != 0, at);
    const Real* self = core_ + static_cast<Count>(place) * width;
    const Real* from = place < n_ / 2 ? self : self - width;
    for (Index k = 0; k < width; ++k) at[k] = (from[width + k] - from[k]) * static_cast<Real>(scale_);
  });
}

LimitMasks masks_of(const ControlCurves& curves) {
  return visit_scheme(curves.basis, [](const auto& kind) { return kind.limit_masks(); });
}

template class LimitPass<float>;
template class LimitPass<double>;

}  // namespace subdivd

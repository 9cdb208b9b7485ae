#include "core/curves/block_refiner.h"

#include <algorithm>
#include <limits>

#include "core/base/all_finite.h"
#include "core/base/precision.h"

namespace subdivd {
namespace {

constexpr Count kBlockScalars = 2048;  // of the last level but one, per block: two windows in the first cache
constexpr Count kLeastBlock = 32;      // points, whatever their width

}  // namespace

Count points_of_block(Index width) { return std::max(kLeastBlock, kBlockScalars / width); }

template <class Real>
BlockRefiner<Real>::BlockRefiner(const Curve<Real>& curve, std::span<const double> core, Index level)
    : curve_(curve), core_(core), level_(level), step_(curve) {
  const bool nonperiodic = curve.wrap == CurveWrap::nonperiodic;
  const bool primal_pinned = curve.pinned() && !curve.split.dual;
  const Place fixed = nonperiodic ? curve.split.lost : primal_pinned ? 1 : 0;
  const Place points = static_cast<Place>(core.size() / curve.width);
  for (Index l = 0; l <= level; ++l) counts_[l] = (points - fixed) * (Place{1} << l) + fixed;
}

template <class Real>
Result<void> BlockRefiner<Real>::run(const Budget& budget, Real* to) {
  const Place block = static_cast<Place>(points_of_block(curve_.width)) * (level_ == 0 ? 1 : 2);
  for (Place begin = 0; begin < count(); begin += block) {
    if (auto stop = budget.poll()) return *stop;
    const Places wanted{begin, std::min(begin + block, count())};
    Real* first = to + static_cast<Count>(begin) * curve_.width;
    refine_block(wanted, first);
    const Count size = static_cast<Count>(wanted.end - begin) * curve_.width;
    if (!safe_ && !all_finite(std::span<const Real>(first, size))) return does_not_fit();
  }
  return {};
}

template <class Real>
void BlockRefiner<Real>::refine_block(Places wanted, Real* to) {
  if (level_ == 0) {
    load_block(wanted);
    std::copy_n(window_.at(wanted.begin, curve_.width),
                static_cast<Count>(wanted.end - wanted.begin) * curve_.width, to);
    return;
  }
  plan(wanted);
  load_block(windows_[0]);
  for (Index l = 1; l < level_; ++l) {
    next_.reset(windows_[l], curve_.width);
    const Places there = existing(curve_, windows_[l], counts_[l]);
    step_.split(window_, counts_[l], there, next_.at(there.begin, curve_.width));
    if (curve_.wrap != CurveWrap::periodic) continue_curve(curve_, counts_[l], next_);
    std::swap(window_, next_);
  }
  step_.split(window_, count(), wanted, to);
}

// No point can outgrow Real whose control points are below the largest number by 2^32: the continuation of a
// curve at any level is that of its control points, refined, at most 2^5 times as large for the greatest
// reach; and no step enlarges by more than the sum of its weights' sizes, 1 + 4w < 2^0.84 of the four-point
// scheme: 2^20.2 in all levels.
template <class Real>
void BlockRefiner<Real>::load_block(Places wanted) {
  constexpr Real kLimit = std::numeric_limits<Real>::max() / static_cast<Real>(Count{1} << 32);
  load(curve_, core_.data(), counts_[0], wanted, window_);
  const Places there = existing(curve_, wanted, counts_[0]);
  const Count size = static_cast<Count>(there.end - there.begin) * curve_.width;
  safe_ = all_below(std::span<const Real>(window_.at(there.begin, curve_.width), size), kLimit) &&
          all_below(std::span<const Real>(curve_.ends), kLimit);
}

// windows_[l]: the places of level l that the block takes, those beyond the ends included. The parents'
// sources beyond an end lie as far inside it, so a window that is clipped at one end holds them.
template <class Real>
void BlockRefiner<Real>::plan(Places wanted) {
  const Place reach = curve_.split.reach;
  for (Index l = level_; l-- > 0;) {
    const Place begin = (wanted.begin + curve_.missing()) >> 1;
    const Place end = ((wanted.end + curve_.missing() - 1) >> 1) + 1;
    windows_[l] = {begin - reach, end + reach};
    wanted = existing(curve_, windows_[l], counts_[l]);
  }
}

template class BlockRefiner<float>;
template class BlockRefiner<double>;

}  // namespace subdivd

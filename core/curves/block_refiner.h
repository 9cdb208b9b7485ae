#pragma once
// One curve through all its levels.
//
// A curve is refined in blocks of its *last* level. For each block it is worked out backwards which points of
// every level it takes (a few more on either side, level by level); these few are refined forwards in two
// windows that fit the cache, and the last step writes into the answer. Every point comes out by the same
// operations as if each level were done as a whole, so the bytes do not depend on the blocks.

#include <array>
#include <span>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/curves/curve_step.h"
#include "core/curves/curve_window.h"
#include "core/curves/subdivision.h"

namespace subdivd {

// Points of the last level but one per block, so that two windows fit the first cache; of limits, of the
// last.
Count points_of_block(Index width);

// How one curve is taken through its levels.
template <class Real>
class BlockRefiner {
 public:
  // `core`: its core points.
  BlockRefiner(const Curve<Real>& curve, std::span<const double> core, Index level);

  // Core points of the last level.
  Place count() const { return counts_[level_]; }

  // All of them into `to`. Fails when one outgrows Real and when the budget says stop.
  Result<void> run(const Budget& budget, Real* to);

 private:
  void refine_block(Places wanted, Real* to);
  void plan(Places wanted);
  void load_block(Places wanted);

  const Curve<Real>& curve_;
  std::span<const double> core_;
  Index level_;
  bool safe_ = false;  // no point of the block can outgrow Real on any level
  CurveStep<Real> step_;
  Window<Real> window_, next_;
  std::array<Place, kMaxCurveLevel + 1> counts_{};    // core points of every level
  std::array<Places, kMaxCurveLevel + 1> windows_{};  // what the block takes of every level
};

}  // namespace subdivd

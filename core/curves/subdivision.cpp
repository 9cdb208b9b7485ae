#include "core/curves/subdivision.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "core/curves/corner_cutting.h"
#include "core/curves/four_point.h"
#include "core/curves/lane_riesenfeld.h"
#include "core/curves/piecewise.h"
#include "core/curves/precision.h"

// A curve is refined in blocks of its *last* level. For each block it is worked out backwards which points of
// every level it takes (a few more on either side, level by level); these few are refined forwards in two
// windows that fit the cache, and the last step writes into the answer. Every point comes out by the same
// operations as if each level were done as a whole, so the bytes do not depend on the blocks.

namespace subdivd {
namespace {

using Place =
    std::int64_t;  // index of a point; points that continue a curve have places below 0 or from n on

constexpr Count kBlockScalars = 2048;  // of the last level but one, per block: two windows in the first cache
constexpr Count kLeastBlock = 32;      // points, whatever their width
constexpr Count kChunkScalars = 384;   // children computed between two interleavings

struct Places {
  Place begin = 0, end = 0;  // [begin, end)
};

// --- One curve --------------------------------------------------------------------------------------------

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
  Real* at(Place place, Index width) {
    return scalars.data() + static_cast<Count>(place - places.begin) * width;
  }
};

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

// Fills the places of the window below 0 and from n on; those between are there. Nonperiodic curves get
// copies of their ends, which only children take that are thrown away.
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

// The places of a level that `wanted` stands for.
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

// --- One step ---------------------------------------------------------------------------------------------

template <class Real>
void children(const ControlCurves& rule, const Real* self, Count scalars, Real* first, Real* second) {
  switch (rule.basis) {
    case CurveBasis::four_point:
      return four_point_children(rule.tension, rule.width, self, scalars, first, second);
    case CurveBasis::corner_cutting:
      return corner_cutting_children(rule.ratio, rule.width, self, scalars, first, second);
    default:
      break;
  }
  lane_riesenfeld_children(rule.degree, rule.width, self, scalars, first, second);
}

// first and second child in turn, of `points` points. The width as a constant makes the copies plain moves.
template <Index kWidth, class Real>
void interleave(Index width, Count points, const Real* __restrict first, const Real* __restrict second,
                Real* __restrict to) {
  const Count w = kWidth == 0 ? width : kWidth;
  for (Count i = 0; i < points; ++i, first += w, second += w, to += 2 * w) {
    std::memcpy(to, first, w * sizeof(Real));
    std::memcpy(to + w, second, w * sizeof(Real));
  }
}

template <class Real>
void interleave(Index width, Count points, const Real* first, const Real* second, Real* to) {
  switch (width) {
    case 1:
      return interleave<1>(width, points, first, second, to);
    case 2:
      return interleave<2>(width, points, first, second, to);
    case 3:
      return interleave<3>(width, points, first, second, to);
    case 4:
      return interleave<4>(width, points, first, second, to);
    default:
      return interleave<0>(width, points, first, second, to);
  }
}

// Scratch of a step: the two children of a chunk of points, apart.
template <class Real>
struct Chunk {
  explicit Chunk(Index width)
      : points(std::max<Count>(1, kChunkScalars / width)), first(points * width), second(points * width) {}
  Count points;
  std::vector<Real> first, second;
};

// Children `wanted` (consecutive, existing) of the points in `from` into `to`; ends of pinned curves stay.
template <class Real>
void split_points(const Curve<Real>& curve, Window<Real>& from, Place children_there, Places wanted,
                  Chunk<Real>& chunk, Real* to) {
  const Index width = curve.width;
  // Child c has the place c - missing; parents are c >> 1, of which the outer ones may give one child only.
  const Place begin = wanted.begin + curve.missing(), end = wanted.end + curve.missing();
  Real* at = to;
  for (Place parent = begin >> 1; 2 * parent < end;) {
    const Place left = ((end + 1) >> 1) - parent;
    const Count points = std::min(chunk.points, static_cast<Count>(left));
    children(*curve.rule, from.at(parent, width), points * width, chunk.first.data(), chunk.second.data());
    const Real *first = chunk.first.data(), *second = chunk.second.data();
    Count whole = points;
    if (2 * parent < begin) {  // the first child of the first point is not wanted
      at = std::copy_n(second, width, at);
      first += width, second += width, --whole;
    }
    const Place next = parent + static_cast<Place>(points);
    const bool half = 2 * next > end && whole > 0;  // nor the second of the last
    if (half) --whole;
    interleave(width, whole, first, second, at);
    at += 2 * whole * width;
    if (half) at = std::copy_n(first + whole * width, width, at);
    parent = next;
  }
  if (!curve.pinned() || curve.split.dual) return;
  if (wanted.begin == 0) std::copy_n(curve.ends.data(), width, to);
  if (wanted.end == children_there) std::copy_n(curve.ends.data() + width, width, at - width);
}

// --- All steps --------------------------------------------------------------------------------------------

// NaN and infinity are the numbers whose exponent has all bits set: adding its lowest bit then carries into
// the sign. In integers, because compilers spread these over lanes.
template <class Real>
bool all_finite(std::span<const Real> values) {
  using Bits = std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>;
  constexpr int kMantissa = std::numeric_limits<Real>::digits - 1;
  constexpr Bits kSign = Bits{1} << (sizeof(Real) * 8 - 1), kLowest = Bits{1} << kMantissa;
  constexpr Bits kExponent = kSign - kLowest;
  Bits carries = 0;
  for (const Real value : values) carries |= (std::bit_cast<Bits>(value) & kExponent) + kLowest;
  return (carries & kSign) == 0;
}

// How one curve is taken through its levels.
template <class Real>
class Refiner {
 public:
  // `safe`: no point can outgrow Real (see stays_in_range).
  Refiner(const Curve<Real>& curve, std::span<const double> core, Index level, bool safe)
      : curve_(curve), core_(core), level_(level), safe_(safe), chunk_(curve.width) {
    const bool nonperiodic = curve.wrap == CurveWrap::nonperiodic;
    const bool primal_pinned = curve.pinned() && !curve.split.dual;
    const Place fixed = nonperiodic ? curve.split.lost : primal_pinned ? 1 : 0;
    const Place points = static_cast<Place>(core.size() / curve.width);
    for (Index l = 0; l <= level; ++l) counts_[l] = (points - fixed) * (Place{1} << l) + fixed;
  }

  Place count() const { return counts_[level_]; }

  // All points of the last level, count() of them.
  Result<void> run(const Budget& budget, Real* to) {
    const Count least = std::max(kLeastBlock, kBlockScalars / curve_.width);
    const Place block = static_cast<Place>(level_ == 0 ? least : 2 * least);
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

 private:
  void refine_block(Places wanted, Real* to) {
    if (level_ == 0) {
      load(curve_, core_.data(), count(), wanted, window_);
      std::copy_n(window_.at(wanted.begin, curve_.width),
                  static_cast<Count>(wanted.end - wanted.begin) * curve_.width, to);
      return;
    }
    plan(wanted);
    load(curve_, core_.data(), counts_[0], windows_[0], window_);
    for (Index l = 1; l < level_; ++l) {
      next_.reset(windows_[l], curve_.width);
      const Places there = existing(curve_, windows_[l], counts_[l]);
      split_points(curve_, window_, counts_[l], there, chunk_, next_.at(there.begin, curve_.width));
      if (curve_.wrap != CurveWrap::periodic) continue_curve(curve_, counts_[l], next_);
      std::swap(window_, next_);
    }
    split_points(curve_, window_, count(), wanted, chunk_, to);
  }

  // windows_[l]: the places of level l that the block takes, those beyond the ends included. The parents'
  // sources beyond an end lie as far inside it, so a window that is clipped at one end holds them.
  void plan(Places wanted) {
    const Place reach = curve_.split.reach;
    for (Index l = level_; l-- > 0;) {
      const Place begin = (wanted.begin + curve_.missing()) >> 1;
      const Place end = ((wanted.end + curve_.missing() - 1) >> 1) + 1;
      windows_[l] = {begin - reach, end + reach};
      wanted = existing(curve_, windows_[l], counts_[l]);
    }
  }

  const Curve<Real>& curve_;
  std::span<const double> core_;
  Index level_;
  bool safe_;
  Chunk<Real> chunk_;
  Window<Real> window_, next_;
  std::array<Place, kMaxCurveLevel + 1> counts_{};
  std::array<Places, kMaxCurveLevel + 1> windows_{};
};

// --- Limits -----------------------------------------------------------------------------------------------

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

// Limits or tangents of one refined curve; `core` holds its n core points.
template <class Real>
class LimitPass {
 public:
  LimitPass(const Curve<Real>& curve, const LimitMasks& masks, Index level, const Real* core, Place n)
      : curve_(curve), masks_(masks), scale_(std::ldexp(1.0, static_cast<int>(level))), core_(core), n_(n) {}

  // Into `to`, n core points; ends of pinned curves are theirs.
  Result<void> limits(const Budget& budget, Real* to) {
    return in_blocks(masks_.values, budget, to, [this](Place begin, Count scalars, Real* at) {
      limits_at(masks_.values, curve_.width, window_.at(begin, curve_.width), scalars, at);
    });
  }
  Result<void> tangents(const Budget& budget, Real* to) {
    return in_blocks(masks_.slopes, budget, to, [this](Place begin, Count scalars, Real* at) {
      tangents_at(masks_.slopes, scale_, curve_.width, window_.at(begin, curve_.width), scalars, at);
    });
  }
  // Puts what is special into `to` (n core points): the points of a nonperiodic curve that lack neighbours,
  // and the ends of a pinned primal curve.
  void mend_limits(Real* to) {
    const auto keep = [&](Place place) {
      const Count offset = static_cast<Count>(place) * curve_.width;
      std::copy_n(core_ + offset, curve_.width, to + offset);
    };
    for_each_special(masks_.values, keep);
  }
  void mend_tangents(Real* to) {
    const Index width = curve_.width;
    for_each_special(masks_.slopes, [&](Place place) {
      Real* at = to + static_cast<Count>(place) * width;
      if (curve_.pinned()) return end_tangent(place != 0, at);
      const Real* self = core_ + static_cast<Count>(place) * width;
      const Real* from = place < n_ / 2 ? self : self - width;
      for (Index k = 0; k < width; ++k) at[k] = (from[width + k] - from[k]) * static_cast<Real>(scale_);
    });
  }
  // At an end of a pinned curve.
  void end_tangent(bool last, Real* to) {
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

 private:
  template <class Body>
  Result<void> in_blocks(const std::vector<double>& mask, const Budget& budget, Real* to, Body&& body) {
    const Place reach = static_cast<Place>(mask.size()) - 1;
    const Place block = static_cast<Place>(std::max(kLeastBlock, kBlockScalars / curve_.width));
    for (Place begin = 0; begin < n_; begin += block) {
      if (auto stop = budget.poll()) return *stop;
      const Place end = std::min(begin + block, n_);
      load(curve_, core_, n_, {begin - reach, end + reach}, window_);
      Real* at = to + static_cast<Count>(begin) * curve_.width;
      body(begin, static_cast<Count>(end - begin) * curve_.width, at);
    }
    return {};
  }
  template <class Visit>
  void for_each_special(const std::vector<double>& mask, Visit&& visit) {
    if (curve_.wrap == CurveWrap::periodic || curve_.has_outer_ends()) return;
    const Place reach = curve_.pinned() ? 1 : static_cast<Place>(mask.size()) - 1;
    for (Place place = 0; place < reach; ++place) visit(place);
    for (Place place = n_ - reach; place < n_; ++place) visit(place);
  }

  const Curve<Real>& curve_;
  const LimitMasks& masks_;
  double scale_;  // units of the level's parameter in one of the control parameter
  const Real* core_;
  Place n_;
  Window<Real> window_;
};

LimitMasks masks_of(const ControlCurves& curves) {
  switch (curves.basis) {
    case CurveBasis::four_point:
      return four_point_limits(curves.tension);
    case CurveBasis::corner_cutting:
      return corner_cutting_limits(curves.ratio);
    default:
      break;
  }
  return lane_riesenfeld_limits(curves.degree);
}

// --- The answer -------------------------------------------------------------------------------------------

template <class Real>
bool fits(std::span<const double> control) {
  constexpr double kLargest = static_cast<double>(std::numeric_limits<Real>::max());
  return std::all_of(control.begin(), control.end(),
                     [](double value) { return std::abs(value) <= kLargest; });
}

// Whether no point can outgrow Real on any level. The continuation of a curve at any level is that of its
// control points, refined: at most 2^5 times as large for the greatest reach; and no step enlarges by more
// than the sum of its weights' sizes, 1 + 4w < 2^0.84 of the four-point scheme: 2^20.2 in all levels.
template <class Real>
bool stays_in_range(std::span<const double> control) {
  constexpr double kLargest = static_cast<double>(std::numeric_limits<Real>::max()) / (Count{1} << 32);
  return std::all_of(control.begin(), control.end(),
                     [](double value) { return std::abs(value) <= kLargest; });
}

// The three arrays of one refined curve within the answer; null where they are not asked for.
template <class Real>
struct Target {
  Real *points, *limits, *tangents;
};

template <class Real>
Result<void> refine_one(const ControlCurves& curves, std::span<const double> control, const LimitMasks& masks,
                        Index level, const Budget& budget, Target<Real> to) {
  const Index width = curves.width;
  Curve<Real> curve{&curves, split_of(curves), curves.wrap, width, {}};
  if (curve.pinned()) {
    const auto put = [](double value) { return static_cast<Real>(value); };
    curve.ends.resize(Count{2} * width);
    std::transform(control.begin(), control.begin() + width, curve.ends.begin(), put);
    std::transform(control.end() - width, control.end(), curve.ends.begin() + width, put);
  }
  const Count outer = curve.has_outer_ends() ? width : 0;
  Refiner<Real> refiner(curve, control.subspan(outer, control.size() - 2 * outer), level,
                        stays_in_range<Real>(control));
  const Place n = refiner.count();
  const Count core_size = static_cast<Count>(n) * width, last = outer + core_size;
  if (auto done = refiner.run(budget, to.points + outer); !done) return done;
  LimitPass<Real> pass(curve, masks, level, to.points + outer, n);
  for (Real* ends_kept : {to.points, to.limits}) {
    if (ends_kept == nullptr || outer == 0) continue;
    std::copy_n(curve.ends.data(), width, ends_kept);
    std::copy_n(curve.ends.data() + width, width, ends_kept + last);
  }
  if (to.limits != nullptr) {
    if (auto done = pass.limits(budget, to.limits + outer); !done) return done;
    pass.mend_limits(to.limits + outer);
    if (!all_finite(std::span<const Real>(to.limits, last + outer))) return does_not_fit();
  }
  if (to.tangents != nullptr) {
    if (auto done = pass.tangents(budget, to.tangents + outer); !done) return done;
    pass.mend_tangents(to.tangents + outer);
    if (outer != 0) pass.end_tangent(false, to.tangents), pass.end_tangent(true, to.tangents + last);
    if (!all_finite(std::span<const Real>(to.tangents, last + outer))) return does_not_fit();
  }
  return {};
}

Result<Count> total_points(const ControlCurves& curves, Index level) {
  if (level > kMaxCurveLevel)
    return Error{ErrorCode::out_of_range,
                 "level " + std::to_string(level) + " is over the maximum of " +
                     std::to_string(kMaxCurveLevel) + " for curves",
                 {},
                 level,
                 kMaxCurveLevel};
  // No overflow: at most 2^32 points, 2^24 times as many each.
  const Count total = total_point_count(curves, level);
  if (total <= kMaxIndexCount) return total;
  return Error{
      ErrorCode::too_large,
      "the refined curves would have more points than 32-bit indices can number: choose a lower level",
      {},
      total,
      kMaxIndexCount};
}

}  // namespace

Count total_point_count(const ControlCurves& curves, Index level) {
  if (!is_subdivided(curves.basis)) return refined_piecewise_count(curves, level);
  Count total = 0;
  for (Count c = 0; c < curves.curve_count(); ++c)
    total += refined_point_count(curves, curves.points_of_curve(c), level);
  return total;
}

Count refined_point_count(const ControlCurves& curves, Count points, Index level) {
  const CurveSplit split = split_of(curves);
  const Count n = Count{1} << level;
  switch (curves.wrap) {
    case CurveWrap::nonperiodic:
      return (points - split.lost) * n + split.lost;
    case CurveWrap::periodic:
      return points * n;
    case CurveWrap::pinned:
      break;
  }
  const Count ends = split.dual ? 2 : 1;
  return (points - ends) * n + ends;
}

Count refined_point_count(CurveWrap wrap, Count points, Index level) {
  ControlCurves cubic;
  cubic.wrap = wrap;
  return refined_point_count(cubic, points, level);
}

double point_parameter(const ControlCurves& curves, Count points, Index level, Count point) {
  const CurveSplit split = split_of(curves);
  const double h = std::ldexp(1.0, -static_cast<int>(level)), j = static_cast<double>(point);
  if (curves.wrap == CurveWrap::nonperiodic) return j * h + (split.lost - 1.0) / 2 * (1 - h);
  if (!split.dual) return j * h;
  if (curves.wrap == CurveWrap::periodic) return (j + 0.5) * h - 0.5;
  if (point == 0) return 0;
  if (point + 1 == refined_point_count(curves, points, level)) return static_cast<double>(points - 2);
  return (j - 0.5) * h;
}

template <class Real>
Result<Count> predict_bytes(const ControlCurves& curves, const CurveOptions& options) {
  const Result<Count> points = total_points(curves, options.level);
  if (!points) return points;
  const Count arrays = 1 + (options.limit ? 1 : 0) + (options.tangents ? 1 : 0);
  // At most 2^32 points of 2^12 scalars in three arrays: 2^49 bytes, no overflow.
  Count bytes = *points * curves.width * sizeof(Real) * arrays + curves.curve_count() * sizeof(Index);
  // Knots and weights, the curve in doubles before it is converted, and its pieces.
  if (!is_subdivided(curves.basis)) bytes += *points * (curves.width * (arrays + 2) + 12) * sizeof(double);
  return bytes;
}

namespace {

template <class Real, class To>
bool convert(const std::vector<double>& from, To& to) {
  to.resize(from.size());
  bool fine = true;
  for (Count k = 0; k < from.size(); ++k) {
    to[k] = static_cast<Real>(from[k]);
    fine &= std::isfinite(to[k]);
  }
  return fine;
}

template <class Real>
Result<RefinedCurves<Real>> refine_by_pieces(const ControlCurves& curves, const CurveOptions& options,
                                             const Budget& budget) {
  auto pieces = refine_piecewise(curves, options, budget);
  if (!pieces) return std::move(pieces).error();
  RefinedCurves<Real> refined;
  refined.name = curves.name;
  refined.level = options.level;
  refined.width = curves.width;
  refined.wrap = CurveWrap::nonperiodic;
  refined.basis = pieces->basis;
  refined.vertex_counts = std::move(pieces->vertex_counts);
  refined.orders = std::move(pieces->orders);
  refined.knots = std::move(pieces->knots);
  refined.weights = std::move(pieces->weights);
  if (!convert<Real>(pieces->points, refined.points) ||
      !convert<Real>(pieces->limit_points, refined.limit_points) ||
      !convert<Real>(pieces->tangents, refined.tangents))
    return does_not_fit();
  return refined;
}

}  // namespace

template <class Real>
Result<RefinedCurves<Real>> refine(const ControlCurves& curves, const CurveOptions& options,
                                   const Budget& budget) {
  const Result<Count> bytes = predict_bytes<Real>(curves, options);
  if (!bytes) return bytes.error();
  if (auto allowed = budget.check_bytes(*bytes); !allowed) return allowed.error();
  const std::span<const double> control(curves.points);
  if (auto stop = budget.poll()) return *stop;  // a dead caller costs nothing
  if (!is_subdivided(curves.basis)) return refine_by_pieces<Real>(curves, options, budget);
  if (!fits<Real>(control)) return does_not_fit();

  RefinedCurves<Real> refined;
  refined.name = curves.name;
  refined.level = options.level;
  refined.width = curves.width;
  refined.wrap = curves.wrap;
  refined.basis = curves.basis;
  refined.degree = curves.degree;
  refined.tension = curves.tension;
  refined.ratio = curves.ratio;
  const Count scalars = *total_points(curves, options.level) * curves.width;
  refined.points.resize(scalars);
  if (options.limit) refined.limit_points.resize(scalars);
  if (options.tangents) refined.tangents.resize(scalars);
  refined.vertex_counts.reserve(curves.curve_count());

  const LimitMasks masks = masks_of(curves);
  Count begin = 0, out = 0;
  for (Count c = 0; c < curves.curve_count(); ++c) {
    const Count points = curves.points_of_curve(c), size = points * curves.width;
    const Target<Real> to{refined.points.data() + out,
                          options.limit ? refined.limit_points.data() + out : nullptr,
                          options.tangents ? refined.tangents.data() + out : nullptr};
    const auto done =
        refine_one<Real>(curves, control.subspan(begin, size), masks, options.level, budget, to);
    if (!done) return done.error();
    const Count count = refined_point_count(curves, points, options.level);
    refined.vertex_counts.push_back(static_cast<Index>(count));
    begin += size;
    out += count * curves.width;
  }
  return refined;
}

template Result<Count> predict_bytes<float>(const ControlCurves&, const CurveOptions&);
template Result<Count> predict_bytes<double>(const ControlCurves&, const CurveOptions&);
template Result<RefinedCurves<float>> refine<float>(const ControlCurves&, const CurveOptions&, const Budget&);
template Result<RefinedCurves<double>> refine<double>(const ControlCurves&, const CurveOptions&,
                                                      const Budget&);
}  // namespace subdivd

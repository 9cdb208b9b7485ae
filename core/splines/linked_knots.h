#pragma once
// A spline whose knots go in any order: they and their points are linked to their neighbours, so that what
// goes leaves the others where they are, and costs the same however long the curve is.

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/splines/spline.h"

namespace subdivd {

class LinkedKnots {
 public:
  LinkedKnots(const Spline& spline, const Pace& pace) : pace_(pace), spline_(copy_of(spline, pace)) {
    const Count knots = spline.knots.size();
    before_.reserve(knots);
    behind_.reserve(knots);
    pace.for_each(knots, [&](Count i) {
      before_.push_back(i == 0 ? kNone : static_cast<Index>(i - 1));
      behind_.push_back(i + 1 == knots ? kNone : static_cast<Index>(i + 1));
    });
    gone_.reserve(knots);
    pace.fill(gone_, knots, 0);
  }

  // As often as there was, and is, a knot t inside the domain. Nothing: there never was one.
  std::optional<Index> times(double t) const {
    if (!(t > spline_.begin() && t < spline_.end())) return {};
    const auto [first, last] = equal(t);
    if (first == last) return {};
    return static_cast<Index>(std::count(gone_.begin() + first, gone_.begin() + last, 0));
  }

  // What feels it when the last of the knots t goes, of which there is one.
  const Spline& around(double t) {
    const auto [first, last] = equal(t);
    knot_ = static_cast<Index>(last - 1);
    while (gone_[knot_] != 0) --knot_;
    gather_near();
    const Count points = near_.knots.size() - spline_.degree - 1;
    near_.points.clear();
    for (Count i = 0; i < points; ++i) {
      const auto point = spline_.point(numbers_[i]);
      near_.points.insert(near_.points.end(), point.begin(), point.end());
    }
    return near_;
  }

  // Removes that knot: `without` is what around() has returned, without it.
  void remove(const Spline& without) {
    const Index width = spline_.width;
    gone_[knot_] = 1;
    behind_[before_[knot_]] = behind_[knot_];
    before_[behind_[knot_]] = before_[knot_];
    // Its point goes with it; the others near it take what is left.
    auto from = without.points.begin();
    for (Count i = 0; from != without.points.end(); ++i) {
      if (numbers_[i] == knot_) continue;
      std::copy_n(from, width,
                  spline_.points.begin() + static_cast<std::ptrdiff_t>(Count{numbers_[i]} * width));
      from += width;
    }
  }

  // What is left, moved together.
  Spline finish() {
    const Count points = spline_.point_count(), width = spline_.width;
    Count kept = 0, kept_points = 0;
    pace_.for_each(spline_.knots.size(), [&](Count i) {
      if (gone_[i] != 0) return;
      spline_.knots[kept++] = spline_.knots[i];
      if (i >= points) return;
      if (kept_points != i)
        std::copy_n(spline_.points.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                    spline_.points.begin() + static_cast<std::ptrdiff_t>(kept_points * width));
      ++kept_points;
    });
    spline_.knots.resize(kept);
    spline_.points.resize(kept_points * width);
    return std::move(spline_);
  }

 private:
  static constexpr Index kNone = ~Index{0};

  std::pair<std::ptrdiff_t, std::ptrdiff_t> equal(double t) const {
    const auto [first, last] = std::equal_range(spline_.knots.begin(), spline_.knots.end(), t);
    return {first - spline_.knots.begin(), last - spline_.knots.begin()};
  }

  // The knots that a removal can feel, 2 p on either side, and their numbers.
  void gather_near() {
    const Index reach = 2 * spline_.degree;
    Index begin = knot_;
    for (Index k = 0; k < reach && before_[begin] != kNone; ++k) begin = before_[begin];
    numbers_.clear();
    Index behind = 0;
    for (Index i = begin; i != kNone && behind <= reach; i = behind_[i]) {
      numbers_.push_back(i);
      if (i == knot_ || behind > 0) ++behind;
    }
    near_.degree = spline_.degree;
    near_.width = spline_.width;
    near_.rational = spline_.rational;
    near_.knots.clear();
    for (const Index i : numbers_) near_.knots.push_back(spline_.knots[i]);
  }

  const Pace& pace_;
  Spline spline_;
  std::vector<Index> before_, behind_;
  std::vector<unsigned char> gone_;
  Index knot_ = 0;  // what around() was asked about, what it has returned, and the numbers of its knots
  Spline near_;
  std::vector<Index> numbers_;
};

}  // namespace subdivd

#include "core/splines/knot_removal.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <string>

#include "core/base/all_finite.h"
#include "core/base/pace.h"
#include "core/base/text_of.h"
#include "core/splines/knot_insertion.h"
#include "core/splines/linked_knots.h"
#include "core/splines/passage.h"

namespace subdivd {
namespace {

constexpr Count kSearch = 32;         // steps of a search among all knots
constexpr Count kStepsOfRemoval = 8;  // per number of the points that can feel it

double length(std::span<const double> vector) {
  double result = 0;
  for (const double x : vector) result = std::hypot(result, x);
  return result;
}

// The spline without the last of the knots equal to t: the equations of its insertion,
//   (1 - a_i) Q_{i-1} + a_i Q_i = P_i   [Boehm80],
// one more than there are unknown points, solved by least squares. (From either side to the middle, as it is
// usually done, every step divides by a share that may be small, and rounding grows with the degree.)
Spline without_one(const Spline& spline, double t) {
  const Index p = spline.degree, width = spline.width;
  const auto equal = std::equal_range(spline.knots.begin(), spline.knots.end(), t);
  const auto knot = static_cast<Count>(equal.second - spline.knots.begin()) - 1;
  const auto times = static_cast<Count>(equal.second - equal.first);
  // Q_i = P_i before the first equation, Q_{i-1} = P_i behind the last.
  const Count first = knot - p, last = knot - times;
  Spline shorter = spline;
  shorter.knots.erase(shorter.knots.begin() + static_cast<std::ptrdiff_t>(knot));
  std::vector<double>& q = shorter.points;
  q.erase(q.begin() + static_cast<std::ptrdiff_t>(last * width),
          q.begin() + static_cast<std::ptrdiff_t>((last + 1) * width));
  if (first == last) return shorter;

  // Rotations make an upper triangle of two diagonals, row by row; q holds the right sides.   [Givens58]
  const auto share = [&](Count i) {
    const double low = shorter.knots[i];
    return (t - low) / (shorter.knots[i + p] - low);
  };
  std::vector<double> diagonal(last - first), beside(last - first, 0.0), right(width);
  diagonal[0] = share(first);
  for (Index k = 0; k < width; ++k)
    q[first * width + k] = spline.points[first * width + k] - (1 - diagonal[0]) * q[(first - 1) * width + k];
  for (Count i = first + 1; i <= last; ++i) {
    const double a = share(i);
    for (Index k = 0; k < width; ++k)
      right[k] = spline.points[i * width + k] - (i == last ? a * q[i * width + k] : 0);
    double& above = diagonal[i - 1 - first];
    const double length = std::hypot(above, 1 - a), c = above / length, s = (1 - a) / length;
    above = length;
    beside[i - 1 - first] = i == last ? 0 : s * a;
    if (i < last) diagonal[i - first] = c * a;
    for (Index k = 0; k < width; ++k) {
      double& upper = q[(i - 1) * width + k];
      const double lower = c * right[k] - s * upper;
      upper = c * upper + s * right[k];
      if (i < last) q[i * width + k] = lower;
    }
  }
  for (Count i = last; i-- > first;)
    for (Index k = 0; k < width; ++k) {
      double& value = q[i * width + k];
      if (i + 1 < last) value -= beside[i - first] * q[(i + 1) * width + k];
      value /= diagonal[i - first];
    }
  return shorter;
}

bool is_sound(const Spline& spline) {
  if (!all_finite(std::span<const double>(spline.points))) return false;
  if (!spline.rational) return true;
  for (Count i = 0; i < spline.point_count(); ++i)
    if (!(spline.point(i)[spline.dimension()] > 0)) return false;
  return true;
}

// What is lost by removing t once; empty: there is no such spline.
std::optional<Approximation> removed_once(const Spline& spline, double t) {
  Spline shorter = without_one(spline, t);
  if (!is_sound(shorter)) return {};
  const Result<Spline> again = insert_knot(shorter, t, 1);
  assert(again.ok());
  const double bound = distance_bound(spline, *again);
  if (!std::isfinite(bound)) return {};
  return Approximation{std::move(shorter), bound};
}

Result<void> check_tolerance(double tolerance) {
  if (tolerance >= 0 && std::isfinite(tolerance)) return {};
  return Error{ErrorCode::out_of_range, "the tolerance must be a finite number, 0 or more", {"tolerance"}};
}

}  // namespace

double distance_bound(const Spline& a, const Spline& b, const Pace& pace) {
  assert(a.points.size() == b.points.size() && a.width == b.width);
  const Index dimension = a.dimension();
  double farthest = 0, farthest_point = 0, farthest_weight = 0, lightest = 1;
  if (a.rational) lightest = a.point(0)[dimension];
  std::vector<double> difference(dimension), point(dimension);
  for (Count i = 0; i < a.point_count(); ++i) {
    pace.spend(4 * Count{dimension});
    const auto p = a.point(i), q = b.point(i);
    for (Index k = 0; k < dimension; ++k) difference[k] = p[k] - q[k];
    farthest = std::max(farthest, length(difference));
    if (!a.rational) continue;
    for (Index k = 0; k < dimension; ++k) point[k] = q[k] / q[dimension];
    farthest_point = std::max(farthest_point, length(point));
    farthest_weight = std::max(farthest_weight, std::abs(p[dimension] - q[dimension]));
    lightest = std::min(lightest, p[dimension]);
  }
  return (farthest + farthest_point * farthest_weight) / lightest;
}

namespace {

// Removes the last knot that the passage has come to up to `times` times; what is lost is added to `bound`.
// Only the points that can feel it are looked at.
Index remove_here(Passage& passage, Index times, double tolerance, double& bound, const Pace& pace) {
  Spline& done = passage.done();
  const Index p = done.degree, width = done.width;
  const double t = done.knots.back();
  for (Index removed = 0; removed < times; ++removed) {
    const Count knot = done.knots.size() - 1;
    const Count begin = knot - std::min(knot, Count{2} * p), end = std::min(knot + p, passage.point_count());
    pace.spend(kStepsOfRemoval * (end - begin) * width);
    Spline near{p, width, done.rational, false, {}, {}};
    for (Count i = begin; i < end + p + 1; ++i) near.knots.push_back(passage.knot(i));
    for (Count i = begin; i < end; ++i)
      near.points.insert(near.points.end(), passage.point(i).begin(), passage.point(i).end());
    const auto next = removed_once(near, t);
    if (!next || !(bound + next->bound <= tolerance)) return removed;
    bound += next->bound;
    done.knots.pop_back();
    done.points.resize(done.points.size() - width);
    const Count changed = done.points.size() - begin * width;
    std::copy_n(next->spline.points.begin(), changed,
                done.points.begin() + static_cast<std::ptrdiff_t>(begin * width));
  }
  return times;
}

}  // namespace

namespace {

Error no_such_knot(const Spline& spline, double t) {
  return Error{ErrorCode::out_of_range, "there is no knot " + text_of(t) + " inside the domain, " +
                                            text_of(spline.begin()) + " to " + text_of(spline.end())};
}

}  // namespace

Result<Removal> remove_knot(const Spline& spline, double t, Index times, double tolerance,
                            const Budget& budget) {
  if (auto fine = check_tolerance(tolerance); !fine) return std::move(fine).error();
  return stoppable(budget, [&](const Pace& pace) -> Result<Removal> {
    const Index there = multiplicity(spline.knots, t);
    if (!(t > spline.begin() && t < spline.end()) || there == 0) return no_such_knot(spline, t);
    Passage passage(spline, 0, pace);
    passage.go_to(t);
    double bound = 0;
    const Index removed = remove_here(passage, std::min(times, there), tolerance, bound, pace);
    return Removal{{passage.finish(), bound}, removed};
  });
}

Result<KnotRemovals> remove_knots(const Spline& spline, std::span<const double> knots, double tolerance,
                                  const Budget& budget) {
  if (auto fine = check_tolerance(tolerance); !fine) return std::move(fine).error();
  return stoppable(budget, [&](const Pace& pace) -> Result<KnotRemovals> {
    LinkedKnots linked(spline, pace);
    KnotRemovals removals{{{}, 0}, 0};
    for (Count k = 0; k < knots.size(); ++k) {
      pace.spend(kSearch);
      const auto there = linked.times(knots[k]);
      if (!there) {
        Error error = no_such_knot(spline, knots[k]);
        error.where = {std::uint64_t{k}};
        return error;
      }
      if (*there == 0) continue;  // no fault: earlier removals have taken it
      const Spline& near = linked.around(knots[k]);
      pace.spend(kStepsOfRemoval * near.points.size());
      const auto next = removed_once(near, knots[k]);
      if (!next || !(next->bound <= tolerance - removals.result.bound)) continue;
      linked.remove(next->spline);
      ++removals.removed;
      removals.result.bound += next->bound;
    }
    removals.result.spline = linked.finish();
    return removals;
  });
}

namespace {

// One way through all knots inside the domain: removes those that cost at most `each`, no two neighbours, for
// where a gap grows from one side rounding grows with it. Returns how many.
Count remove_cheap_knots(Approximation& curve, double each, double tolerance, const Pace& pace) {
  const Spline source = std::move(curve.spline);
  Passage passage(source, 0, pace);
  Count all = 0;
  bool skip = false;
  for (auto next = std::ranges::upper_bound(source.knots, source.begin()); *next < source.end();) {
    auto behind = next;
    while (*behind == *next) ++behind;  // there are others behind it
    passage.go_to(*next);
    Index removed = 0;
    if (!skip)
      removed = remove_here(passage, static_cast<Index>(behind - next),
                            std::min(tolerance, curve.bound + each), curve.bound, pace);
    all += removed;
    skip = removed > 0;
    next = behind;
  }
  curve.spline = passage.finish();
  return all;
}

}  // namespace

Result<KnotRemovals> remove_knots(const Spline& spline, double tolerance, const Budget& budget) {
  if (auto fine = check_tolerance(tolerance); !fine) return std::move(fine).error();
  return stoppable(budget, [&](const Pace& pace) {
    KnotRemovals removals{{copy_of(spline, pace), 0}, 0};
    // What costs nothing first: a knot that carries something costs little, too, as long as its neighbours
    // stand close, but they could not go any more.
    constexpr double kFactor = 16;
    double each = std::min(tolerance, 0x1p-50 * extent(spline, pace));
    while (true) {
      const Count removed = remove_cheap_knots(removals.result, each, tolerance, pace);
      removals.removed += removed;
      if (removed > 0) continue;
      if (each >= tolerance) return removals;
      each = each > 0 ? std::min(tolerance, each * kFactor) : tolerance;
    }
  });
}

}  // namespace subdivd

#include "core/splines/edit.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/pace.h"
#include "core/base/text_of.h"
#include "core/splines/degree.h"
#include "core/splines/knot_insertion.h"

namespace subdivd {
namespace {

Error outside(double t, const Spline& spline, Path where) {
  return Error{ErrorCode::out_of_range,
               "the parameter " + text_of(t) + " lies outside the domain, " + text_of(spline.begin()) +
                   " to " + text_of(spline.end()),
               std::move(where)};
}

// Knots that make t stand `degree` times.
std::vector<double> missing(const Spline& spline, double t) {
  const Index there = multiplicity(spline.knots, t);
  return std::vector<double>(there < spline.degree ? spline.degree - there : 0, t);
}

void make_rational(Spline& spline, const Pace& pace) {
  if (spline.rational) return;
  std::vector<double> ones;
  pace.fill(ones, spline.point_count(), 1);
  spline.points = to_homogeneous(spline.points, spline.width, ones, pace);
  spline.rational = true;
  ++spline.width;
}

// Distance of where one ends from where the other starts.
double distance(std::span<const double> a, std::span<const double> b, bool rational) {
  const Count dimension = a.size() - (rational ? 1 : 0);
  double result = 0;
  for (Count k = 0; k < dimension; ++k)
    result = std::hypot(result, rational ? a[k] / a[dimension] - b[k] / b[dimension] : a[k] - b[k]);
  return result;
}

// Brought to the degree, and to start and end at its first and last point: nothing to do for most that were
// joined before.
Result<void> bring_to_ends(Spline& spline, Index degree, const Budget& budget) {
  const bool there = spline.knots.front() == spline.begin() && spline.knots.back() == spline.end();
  if (!there || spline.degree < degree) {
    auto brought = elevate_degree(spline, degree - spline.degree, budget);
    if (!brought) return std::move(brought).error();
    spline = *std::move(brought);
  }
  spline.periodic = false;
  return {};
}

}  // namespace

Result<Spline> part(const Spline& spline, double from, double to, const Budget& budget) {
  if (!(from >= spline.begin() && from < spline.end())) return outside(from, spline, {"from"});
  if (!(to > spline.begin() && to <= spline.end())) return outside(to, spline, {"to"});
  if (!(from < to)) return Error{ErrorCode::out_of_range, "the part must end behind its start", {"to"}};
  std::vector<double> knots = missing(spline, from);
  for (const double t : missing(spline, to)) knots.push_back(t);
  auto refined = refine_knots(spline, knots, budget);
  if (!refined) return std::move(refined).error();
  const Index p = spline.degree, width = spline.width;
  // The last knot at `from` and the first at `to`: the points of the spans between them.
  const auto first =
      static_cast<Count>(std::ranges::upper_bound(refined->knots, from) - refined->knots.begin()) - 1;
  const auto last = static_cast<Count>(std::ranges::lower_bound(refined->knots, to) - refined->knots.begin());
  return stoppable(budget, [&](const Pace& pace) {
    Spline piece{p, width, spline.rational, false, {}, {}};
    piece.knots.reserve(last - first + 2 * Count{p} + 1);
    piece.knots.assign(p + 1, from);
    pace.append(std::span(refined->knots).subspan(first + 1, last - first - 1), piece.knots);
    piece.knots.insert(piece.knots.end(), p + 1, to);
    pace.copy(std::span(refined->points).subspan((first - p) * width, (last - first + p) * width),
              piece.points);
    return piece;
  });
}

Result<std::array<Spline, 2>> split(const Spline& spline, double t, const Budget& budget) {
  if (!(t > spline.begin() && t < spline.end())) return outside(t, spline, {});
  auto before = part(spline, spline.begin(), t, budget);
  if (!before) return std::move(before).error();
  auto behind = part(spline, t, spline.end(), budget);
  if (!behind) return std::move(behind).error();
  return std::array<Spline, 2>{*std::move(before), *std::move(behind)};
}

namespace {

// Both of one degree, the other with its ends at its first and last point.
Result<void> append_brought(Spline& first, Spline& other, double gap, const Pace& pace) {
  const Index degree = first.degree;
  if (first.rational || other.rational) {
    make_rational(first, pace);
    make_rational(other, pace);
    const double scale = first.points.back() / other.points[other.width - 1];
    pace.for_each(other.points.size(), [&](Count k) { other.points[k] *= scale; });
  }
  const Index width = first.width;
  const auto end = first.point(first.point_count() - 1), start = other.point(0);
  if (const double apart = distance(end, start, first.rational); !(apart <= gap))
    return Error{ErrorCode::out_of_range, "the curves are " + text_of(apart) +
                                              " apart where they should meet; " + text_of(gap) +
                                              " are allowed"};
  const double meeting = first.end(), shift = meeting - other.begin();
  if (!std::isfinite(shift + other.end() - first.begin()))
    return Error{ErrorCode::out_of_range, "the parameters of the joined curve would be too large"};
  double* const middle = first.points.data() + (first.points.size() - width);
  for (Index k = 0; k < width; ++k) other.points[k] = middle[k] = middle[k] / 2 + other.points[k] / 2;
  pace.for_each(other.knots.size(),
                [&](Count i) { other.knots[i] = std::max(meeting, other.knots[i] + shift); });
  std::fill_n(other.knots.begin(), degree + 1, meeting);
  pace.append(std::span(other.points).subspan(width), first.points);
  first.knots.pop_back();
  pace.append(std::span(other.knots).subspan(degree + Count{1}), first.knots);
  return {};
}

}  // namespace

Result<void> append(Spline& first, const Spline& second, double gap, const Budget& budget) {
  if (first.dimension() != second.dimension())
    return Error{ErrorCode::wrong_length, "points of " + std::to_string(first.dimension()) + " and of " +
                                              std::to_string(second.dimension()) +
                                              " coordinates cannot be joined"};
  if (!(gap >= 0)) return Error{ErrorCode::out_of_range, "the gap must be 0 or more", {"gap"}};
  const Index degree = std::max(first.degree, second.degree);
  if (auto done = bring_to_ends(first, degree, budget); !done) return done;
  auto other = elevate_degree(second, degree - second.degree, budget);
  if (!other) return std::move(other).error();
  other->periodic = false;
  const auto appended =
      stoppable(budget, [&](const Pace& pace) { return append_brought(first, *other, gap, pace); });
  if (!appended) return appended;
  // What is sound by itself is sound behind a sound curve that ends there; else the whole says what is wrong.
  if (other->check(budget) && first.point_count() < kMaxIndexCount - kMaxDegree - 1) return {};
  return first.check(budget);
}

Result<Spline> join(const Spline& first, const Spline& second, double gap, const Budget& budget) {
  auto joined = stoppable(budget, [&](const Pace& pace) { return copy_of(first, pace); });
  if (!joined) return joined;
  if (auto done = append(*joined, second, gap, budget); !done) return std::move(done).error();
  return joined;
}

Spline reverse(const Spline& spline, const Pace& pace) {
  Spline back = copy_of(spline, pace);
  const Count points = spline.point_count(), knots = spline.knots.size();
  pace.in_blocks(
      points,
      [&](Count first, Count last) {
        for (Count i = first; i < last; ++i)
          std::ranges::copy(spline.point(points - 1 - i),
                            back.points.begin() + static_cast<std::ptrdiff_t>(i * spline.width));
      },
      spline.width);
  const double begin = spline.begin(), end = spline.end();
  pace.for_each(knots, [&](Count i) {
    const double t = spline.knots[knots - 1 - i];
    // The ends exactly, however they round.
    back.knots[i] = t == end ? begin : t == begin ? end : begin + (end - t);
  });
  return back;
}

Result<Spline> reparametrize(const Spline& spline, double begin, double end, const Budget& budget) {
  if (!(begin < end) || !std::isfinite(begin) || !std::isfinite(end) || !std::isfinite(end - begin))
    return Error{ErrorCode::out_of_range, "the new domain must have a finite length above 0"};
  return stoppable(budget, [&](const Pace& pace) -> Result<Spline> {
    Spline moved = copy_of(spline, pace);
    const double old_begin = spline.begin(), old_end = spline.end();
    pace.for_each(moved.knots.size(), [&](Count i) {
      double& t = moved.knots[i];
      const double share = (t - old_begin) / (old_end - old_begin);
      t = t == old_end ? end : begin + share * (end - begin);
      // Knots that are different may have become equal, or have lost their order by a rounding.
      if (i > 0) t = std::max(t, moved.knots[i - 1]);
    });
    if (auto fine = moved.check(budget); !fine) return std::move(fine).error();
    return moved;
  });
}

}  // namespace subdivd

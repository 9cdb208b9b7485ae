#include "core/splines/knot_insertion.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/pace.h"
#include "core/base/text_of.h"
#include "core/splines/passage.h"

namespace subdivd {
namespace {

// Inserts t once where the passage stands; no t before was larger.
//   Q_i = (1 - a_i) P_{i-1} + a_i P_i,  a_i = (t - u_i) / (u_{i+p} - u_i)  for k - p < i < first
// where u_k is the last knot <= t and u_first the first that equals it (k + 1: there is none); points before
// them stay, those behind move up.   [Boehm80]
void insert(Passage& passage, double t) {
  passage.go_to(t);
  Spline& done = passage.done();
  const Index p = done.degree, width = done.width;
  const Count k = done.knots.size() - 1;
  Count first = k + 1;
  while (first > 0 && done.knots[first - 1] == t) --first;
  const auto at = [&](Count i) { return done.points.begin() + static_cast<std::ptrdiff_t>(i * width); };
  const std::vector<double> moved(at(first - 1), at(first));
  done.points.insert(at(first), moved.begin(), moved.end());
  for (Count i = first - 1; i + p > k; --i) {
    const double low = done.knots[i], share = (t - low) / (passage.knot(i + p) - low);
    for (Index x = 0; x < width; ++x) {
      double& value = done.points[i * width + x];
      value = (1 - share) * done.points[(i - 1) * width + x] + share * value;
    }
  }
  done.knots.push_back(t);
}

constexpr Count kSearch = 32;  // steps of a search among all knots

Error too_often(double t, Index degree, Count times, bool at_end) {
  return Error{ErrorCode::out_of_range, "the knot " + text_of(t) + " would stand " + std::to_string(times) +
                                            " times; at most " + std::to_string(degree + (at_end ? 1 : 0)) +
                                            " are possible " +
                                            (at_end ? "at the end of the domain" : "inside the domain") +
                                            " of a curve of degree " + std::to_string(degree)};
}

// Of `times` more knots t.
Result<void> check_room(const Spline& spline, double t, Count times) {
  // Modulo the period there may be several places; a knot has one.
  if (!(t >= spline.begin() && t <= spline.end()))
    return Error{ErrorCode::out_of_range, "the knot " + text_of(t) + " lies outside the domain, " +
                                              text_of(spline.begin()) + " to " + text_of(spline.end())};
  const bool at_end = t == spline.begin() || t == spline.end();
  const Count all = multiplicity(spline.knots, t) + times;
  if (all > Count{spline.degree} + (at_end ? 1 : 0)) return too_often(t, spline.degree, all, at_end);
  return {};
}

}  // namespace

Result<Spline> insert_knot(const Spline& spline, double t, Index times) {
  if (auto room = check_room(spline, t, times); !room) return std::move(room).error();
  const Pace pace;
  Passage passage(spline, times, pace);
  for (Index k = 0; k < times; ++k) insert(passage, t);
  return passage.finish();
}

namespace {

Result<void> check_insertions(const Spline& spline, std::span<const double> knots, const Pace& pace) {
  for (Count first = 0; first < knots.size();) {
    Count next = first;
    while (next < knots.size() && knots[next] == knots[first]) ++next;
    pace.spend(next - first + kSearch);
    if (next == first || (next < knots.size() && knots[next] < knots[first]))
      return Error{ErrorCode::out_of_range,
                   "the knots to insert must be numbers that never fall",
                   {std::uint64_t{next}}};
    if (auto room = check_room(spline, knots[first], next - first); !room) {
      room.error().where = {std::uint64_t{first}};
      return std::move(room).error();
    }
    first = next;
  }
  return {};
}

}  // namespace

Result<Spline> refine_knots(const Spline& spline, std::span<const double> knots, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) -> Result<Spline> {
    if (auto room = check_insertions(spline, knots, pace); !room) return std::move(room).error();
    Passage passage(spline, knots.size(), pace);
    for (const double t : knots) {
      pace.spend(Count{spline.degree} * spline.width);
      insert(passage, t);
    }
    return passage.finish();
  });
}

Count refined_point_count(const Spline& spline, Index level, const Pace& pace) {
  Count spans = 0;
  pace.for_each(spline.point_count() - spline.degree, [&](Count k) {
    spans += spline.knots[spline.degree + k] < spline.knots[spline.degree + k + 1];
  });
  return spline.point_count() + spans * ((Count{1} << level) - 1);
}

namespace {

// The knots that cut every span into 2^level equal ones; `count` of them.
Result<std::vector<double>> knots_between(const Spline& spline, Index level, Count count, const Pace& pace) {
  // Level by level, so that a knot is the middle of its neighbours to the bit; together they ascend.
  std::vector<double> knots, span;
  knots.reserve(count);
  const Count parts = Count{1} << level;
  pace.fill(span, parts + 1, 0);
  for (Count k = spline.degree; k < spline.point_count(); ++k) {
    pace.spend(1);
    if (!(spline.knots[k] < spline.knots[k + 1])) continue;
    span[0] = spline.knots[k];
    span[parts] = spline.knots[k + 1];
    for (Count step = parts; step > 1; step /= 2)
      pace.for_each(parts / step, [&](Count n) {
        const Count i = n * step + step / 2;
        span[i] = span[i - step / 2] + (span[i + step / 2] - span[i - step / 2]) / 2;
      });
    bool rising = true;
    pace.for_each(parts, [&](Count i) { rising = rising && span[i] < span[i + 1]; });
    if (!rising)
      return Error{ErrorCode::out_of_range,
                   "the knots " + text_of(span[0]) + " and " + text_of(span[parts]) +
                       " are too close to put " + std::to_string(parts - 1) + " between them",
                   {"knots", std::uint64_t{k}}};
    pace.append(std::span(span).subspan(1, parts - 1), knots);
  }
  return knots;
}

}  // namespace

Result<Spline> refine_spans(const Spline& spline, Index level, const Budget& budget) {
  const auto knots = stoppable(budget, [&](const Pace& pace) -> Result<std::vector<double>> {
    const Count points = refined_point_count(spline, level, pace);
    if (points > kMaxIndexCount)
      return Error{
          .code = ErrorCode::too_large,
          .message =
              "the refined curve would have more points than 32-bit indices can number: choose a lower level",
          .predicted = points,
          .allowed = kMaxIndexCount};
    if (auto room = budget.check_bytes(points * (spline.width + 1) * sizeof(double)); !room)
      return std::move(room).error();
    return knots_between(spline, level, points - spline.point_count(), pace);
  });
  if (!knots) return knots.error();
  return refine_knots(spline, *knots, budget);
}

}  // namespace subdivd

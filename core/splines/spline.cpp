#include "core/splines/spline.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/text_of.h"

namespace subdivd {
namespace {

Error fault(ErrorCode code, std::string message, Path where) {
  return Error{code, std::move(message), std::move(where)};
}

Result<void> check_multiplicities(std::span<const double> knots, Index degree, Count points,
                                  const Pace& pace) {
  const double begin = knots[degree], end = knots[points];
  for (Count first = 0; first < knots.size();) {
    Count next = first;
    while (next < knots.size() && knots[next] == knots[first]) ++next;
    pace.spend(next - first);
    const bool inside = knots[first] > begin && knots[first] < end;
    const Count allowed = inside ? degree : Count{degree} + 1;
    if (next - first > allowed)
      return fault(ErrorCode::out_of_range,
                   "the knot " + text_of(knots[first]) + " stands " + std::to_string(next - first) +
                       " times; a curve of degree " + std::to_string(degree) + " takes a knot " +
                       (inside ? "inside its domain" : "at its end") + " at most " + std::to_string(allowed) +
                       " times",
                   {"knots", std::uint64_t{first + allowed}});
    first = next;
  }
  return {};
}

// What is wrong with these knots alone, for n points: wrong_length, not_finite, out_of_range at {"knots", i}.
Result<void> check_knots(std::span<const double> knots, Index degree, Count points, const Pace& pace) {
  if (knots.size() != points + degree + 1)
    return fault(ErrorCode::wrong_length,
                 "there are " + std::to_string(knots.size()) + " knots; " + std::to_string(points) +
                     " points of order " + std::to_string(degree + 1) + " take " +
                     std::to_string(points + degree + 1),
                 {"knots"});
  for (Count i = 0; i < knots.size(); ++i) {
    pace.spend(1);
    if (!std::isfinite(knots[i]))
      return fault(ErrorCode::not_finite, "knot " + std::to_string(i) + " is not a finite number",
                   {"knots", std::uint64_t{i}});
    if (i > 0 && knots[i] < knots[i - 1])
      return fault(ErrorCode::out_of_range,
                   "knot " + std::to_string(i) + " is " + text_of(knots[i]) + ", less than the " +
                       text_of(knots[i - 1]) + " before it; knots never fall",
                   {"knots", std::uint64_t{i}});
  }
  if (!(knots[degree] < knots[points]) || !std::isfinite(knots.back() - knots.front()))
    return fault(ErrorCode::out_of_range,
                 "the domain, from knot " + std::to_string(degree) + " to knot " + std::to_string(points) +
                     ", must have a length above 0, and all knots a finite one",
                 {"knots"});
  return check_multiplicities(knots, degree, points, pace);
}

Result<void> check_numbers(const Spline& spline, const Pace& pace) {
  const Index width = spline.width;
  for (Count k = 0; k < spline.points.size(); ++k) {
    pace.spend(1);
    if (!std::isfinite(spline.points[k]))
      return fault(ErrorCode::not_finite,
                   "component " + std::to_string(k % width) + " of point " + std::to_string(k / width) +
                       " is not a finite number",
                   {"points", std::uint64_t{k}});
  }
  if (!spline.rational) return {};
  for (Count i = 0; i < spline.point_count(); ++i) {
    pace.spend(1);
    if (const double weight = spline.point(i)[width - 1]; !(weight > 0))
      return fault(ErrorCode::out_of_range,
                   "weight " + std::to_string(i) + " is " + text_of(weight) + "; weights are above 0",
                   {"pointWeights", std::uint64_t{i}});
  }
  return {};
}

}  // namespace

Result<void> Spline::check(const Budget& budget) const {
  if (degree < 1 || degree > kMaxDegree)
    return fault(
        ErrorCode::out_of_range,
        "the degree is " + std::to_string(degree) + "; it must be 1 to " + std::to_string(kMaxDegree),
        {"degree"});
  if (width < (rational ? 2u : 1u))
    return fault(ErrorCode::out_of_range, "points need a coordinate", {"points"});
  if (points.size() % width != 0)
    return fault(ErrorCode::wrong_length, "the numbers do not make whole points", {"points"});
  if (point_count() <= degree)
    return fault(ErrorCode::too_few_points,
                 "a curve of degree " + std::to_string(degree) + " needs at least " +
                     std::to_string(degree + 1) + " points; this one has " + std::to_string(point_count()),
                 {"points"});
  if (point_count() >= kMaxIndexCount - kMaxDegree - 1)
    return fault(ErrorCode::too_large, "there are more points than 32-bit indices can number", {"points"});
  return stoppable(budget, [&](const Pace& pace) -> Result<void> {
    if (auto fine = check_numbers(*this, pace); !fine) return fine;
    return check_knots(knots, degree, point_count(), pace);
  });
}

Index multiplicity(std::span<const double> knots, double t) {
  const auto [first, last] = std::equal_range(knots.begin(), knots.end(), t);
  return static_cast<Index>(last - first);
}

Count find_span(const Spline& spline, double t) {
  const auto first = spline.knots.begin() + spline.degree;
  const auto last = spline.knots.begin() + static_cast<std::ptrdiff_t>(spline.point_count());
  // The first knot above t; for the domain's end the first one that equals it, before which lies the last
  // span that is not empty.
  const auto above = t < *last ? std::upper_bound(first, last, t) : std::lower_bound(first, last, *last);
  return static_cast<Count>(above - spline.knots.begin()) - 1;
}

Result<double> check_parameter(const Spline& spline, double t) {
  if (!std::isfinite(t)) return fault(ErrorCode::not_finite, "the parameter is not a finite number", {});
  const double begin = spline.begin(), end = spline.end();
  if (t >= begin && t <= end) return t;
  if (!spline.periodic)
    return fault(ErrorCode::out_of_range,
                 "the parameter " + text_of(t) + " lies outside the curve's domain, " + text_of(begin) +
                     " to " + text_of(end),
                 {});
  const double period = end - begin;
  double rest = std::fmod(t - begin, period);
  if (rest < 0) rest += period;
  return std::clamp(begin + rest, begin, end);
}

std::vector<double> to_homogeneous(std::span<const double> points, Index dimension,
                                   std::span<const double> weights, const Pace& pace) {
  const Count count = points.size() / dimension;
  std::vector<double> stored;
  stored.reserve(count * (Count{dimension} + 1));
  for (Count i = 0; i < count; ++i) {
    pace.spend(Count{dimension} + 1);
    for (Index k = 0; k < dimension; ++k) stored.push_back(points[i * dimension + k] * weights[i]);
    stored.push_back(weights[i]);
  }
  return stored;
}

std::vector<double> control_points_of(const Spline& spline, const Pace& pace) {
  std::vector<double> points;
  if (!spline.rational) {
    pace.copy(spline.points, points);
    return points;
  }
  points.reserve(spline.point_count() * spline.dimension());
  for (Count i = 0; i < spline.point_count(); ++i) {
    pace.spend(spline.width);
    for (Index k = 0; k < spline.dimension(); ++k)
      points.push_back(spline.point(i)[k] / spline.point(i)[spline.dimension()]);
  }
  return points;
}

std::vector<double> weights(const Spline& spline, const Pace& pace) {
  std::vector<double> all;
  if (!spline.rational) return all;
  all.reserve(spline.point_count());
  pace.for_each(spline.point_count(),
                [&](Count i) { all.push_back(spline.points[i * spline.width + spline.width - 1]); });
  return all;
}

double extent(const Spline& spline, const Pace& pace) {
  const Index dimension = spline.dimension(), width = spline.width;
  const auto coordinate = [&](Count i, Index k) {
    const double* point = &spline.points[i * width];
    return spline.rational ? point[k] / point[dimension] : point[k];
  };
  double diagonal = 0;  // by hypot: squares overflow long before it does
  for (Index k = 0; k < dimension; ++k) {
    double low = coordinate(0, k), high = low;
    pace.for_each(spline.point_count(), [&](Count i) {
      const double x = coordinate(i, k);
      low = std::min(low, x);
      high = std::max(high, x);
    });
    diagonal = std::hypot(diagonal, high - low);
  }
  return diagonal;
}

Spline copy_of(const Spline& spline, const Pace& pace) {
  Spline copy{spline.degree, spline.width, spline.rational, spline.periodic, {}, {}};
  pace.copy(spline.knots, copy.knots);
  pace.copy(spline.points, copy.points);
  return copy;
}

}  // namespace subdivd

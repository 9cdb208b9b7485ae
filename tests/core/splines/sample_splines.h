#pragma once
// Splines of every kind, for tests that want many of them.

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/splines/bspline.h"
#include "core/splines/spline.h"
#include "tests/shapes/random.h"

namespace subdivd::samples {

struct Named {
  std::string name;
  Spline spline;
};

using shapes::Random;

inline double between(Random& random, double low, double high) { return low + (high - low) * random.unit(); }

// Points in [-1, 1], weights in [1/2, 2]. `clamped`: the ends stand degree + 1 times. Knots inside stand once
// to `most` times.
inline Spline random_spline(unsigned seed, Index degree, Index dimension, bool rational, bool clamped,
                            Index most) {
  Random random(seed);
  Spline spline{degree, dimension, false, false, {}, {}};
  double t = random.centred();
  const auto next = [&] { return t += between(random, 0.2, 1.5); };
  if (clamped)
    spline.knots.assign(degree + 1, t);
  else
    for (Index k = 0; k <= degree; ++k) spline.knots.push_back(next());
  for (int distinct = 0; distinct < 5; ++distinct)
    spline.knots.insert(spline.knots.end(), 1 + random.below(most), next());
  next();
  for (Index k = 0; k <= degree; ++k) spline.knots.push_back(clamped ? t : next());
  const Count count = spline.knots.size() - degree - 1;
  for (Count k = 0; k < count * dimension; ++k) spline.points.push_back(random.centred());
  if (!rational) return spline;
  std::vector<double> weights;
  for (Count k = 0; k < count; ++k) weights.push_back(between(random, 0.5, 2));
  spline.points = to_homogeneous(spline.points, dimension, weights);
  spline.rational = true;
  ++spline.width;
  return spline;
}

// One polynomial piece over [0, 1].
inline Spline bezier(Index dimension, std::vector<double> points) {
  const auto degree = static_cast<Index>(points.size() / dimension - 1);
  std::vector<double> knots(degree + 1, 0.0);
  knots.insert(knots.end(), degree + 1, 1.0);
  return {degree, dimension, false, false, std::move(knots), std::move(points)};
}

// Radius 1 around the origin, over [0, 4], in nine points.   [PieglTiller97]
inline Spline circle() {
  const double s = std::sqrt(0.5);
  const std::vector<double> points{1, 0, 1, 1, 0, 1, -1, 1, -1, 0, -1, -1, 0, -1, 1, -1, 1, 0};
  const std::vector<double> weights{1, s, 1, s, 1, s, 1, s, 1};
  return {2, 3, true, false, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, to_homogeneous(points, 2, weights)};
}

// All degrees up to 9, plane and space, with and without weights, clamped and not, simple knots and such of
// every multiplicity.
inline std::vector<Named> all_splines() {
  std::vector<Named> all{{"circle", circle()}};
  unsigned seed = 1;
  for (const Index degree : {1u, 2u, 3u, 4u, 5u, 7u, 9u})
    for (const bool rational : {false, true})
      for (const bool clamped : {false, true})
        for (const Index most : {1u, degree})
          all.push_back({"degree " + std::to_string(degree) + (rational ? " rational" : "") +
                             (clamped ? " clamped" : "") + (most > 1 ? " multiple" : ""),
                         random_spline(seed++, degree, 2 + degree % 2, rational, clamped, most)});
  return all;
}

// The domain's ends, all knots, and evenly between.
inline std::vector<double> parameters(const Spline& spline, int count = 1000) {
  std::vector<double> ts;
  for (int k = 0; k <= count; ++k)
    ts.push_back(std::min(spline.end(), spline.begin() + (spline.end() - spline.begin()) * k / count));
  for (const double t : spline.knots)
    if (t >= spline.begin() && t <= spline.end()) ts.push_back(t);
  return ts;
}

inline std::vector<double> point_at(const Spline& spline, double t) {
  std::vector<double> point(spline.dimension());
  if (!evaluate(spline, t, point)) point.assign(point.size(), std::nan(""));
  return point;
}

inline double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double result = 0;
  for (std::size_t k = 0; k < a.size(); ++k) result = std::hypot(result, a[k] - b[k]);
  return result;
}

// The largest distance of two curves over the same domain, parameter by parameter.
inline double deviation(const Spline& a, const Spline& b) {
  double worst = 0;
  for (const double t : parameters(a)) {
    const double here = distance(point_at(a, t), point_at(b, t));
    if (!(here <= worst)) worst = here;  // NaN stays
  }
  return worst;
}

}  // namespace subdivd::samples

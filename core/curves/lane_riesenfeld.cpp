#include "core/curves/lane_riesenfeld.h"

#include <array>
#include <cassert>
#include <cstdint>
#include <numeric>
#include <utility>

namespace subdivd {
namespace {

// --- Subdivision ------------------------------------------------------------------------------------------

constexpr int half_width(int degree) { return (degree + 1) / 2; }

// a_k = binom(p+1, k+h) / 2^p; 0 outside -h..p+1-h. Exact: the binomials are below 2^14.
constexpr double mask_weight(int degree, int k) {
  const int chosen = k + half_width(degree);
  if (chosen < 0 || chosen > degree + 1) return 0;
  std::int64_t binomial = 1;
  for (int i = 0; i < chosen; ++i) binomial = binomial * (degree + 1 - i) / (i + 1);
  return static_cast<double>(binomial) / static_cast<double>(std::int64_t{1} << degree);
}

// The most distant neighbour in either child.
constexpr int reach_of(int degree) {
  const int h = half_width(degree);
  return degree % 2 == 1 ? (h % 2 == 1 ? (h + 1) / 2 : h / 2) : (h + 1) / 2;
}

// One child of a point: weights of c_{i-k} and c_{i+k} for k from `kReach` down to 0. Absent neighbours are
// left out rather than multiplied by 0.
template <int kDegree, int kParity, int kOffset, class Real>
inline void add_tap(const Real* self, std::ptrdiff_t step, Real& sum, bool& started) {
  constexpr double kWeight = mask_weight(kDegree, kParity - 2 * kOffset);
  if constexpr (kWeight != 0) {
    const Real tap = self[kOffset * step] * static_cast<Real>(kWeight);
    sum = started ? sum + tap : tap;
    started = true;
  }
}

// The pair c_{i-k}, c_{i+k} of a child at point i: added to each other first, as reversal demands.
template <int kDegree, int kDistance, class Real>
inline void add_pair_around(const Real* self, std::ptrdiff_t step, Real& sum, bool& started) {
  constexpr double kWeight = mask_weight(kDegree, 2 * kDistance);
  if constexpr (kWeight != 0) {
    const Real weight = static_cast<Real>(kWeight);
    const Real pair = self[-kDistance * step] * weight + self[kDistance * step] * weight;
    sum = started ? sum + pair : pair;
    started = true;
  }
}

// The pair c_{i-k}, c_{i+1+k} of a child between points i and i+1.
template <int kDegree, int kDistance, class Real>
inline void add_pair_between(const Real* self, std::ptrdiff_t step, Real& sum, bool& started) {
  constexpr double kWeight = mask_weight(kDegree, 1 + 2 * kDistance);
  if constexpr (kWeight != 0) {
    const Real weight = static_cast<Real>(kWeight);
    const Real pair = self[-kDistance * step] * weight + self[(kDistance + 1) * step] * weight;
    sum = started ? sum + pair : pair;
    started = true;
  }
}

template <int kDegree, class Real, int... kInward>
inline void primal_children(const Real* self, std::ptrdiff_t step, Real& first, Real& second,
                            std::integer_sequence<int, kInward...>) {
  constexpr int kReach = reach_of(kDegree);
  Real sum = 0;
  bool started = false;
  (add_pair_around<kDegree, kReach - kInward>(self, step, sum, started), ...);
  add_tap<kDegree, 0, 0>(self, step, sum, started);
  first = sum;
  started = false;
  (add_pair_between<kDegree, kReach - kInward>(self, step, sum, started), ...);
  add_pair_between<kDegree, 0>(self, step, sum, started);
  second = sum;
}

// Child 2i is child 2i+1 seen from the other side: the same taps in the same order with the step negated.
template <int kDegree, class Real, int... kInward>
inline Real dual_child(const Real* self, std::ptrdiff_t step, std::integer_sequence<int, kInward...>) {
  constexpr int kReach = reach_of(kDegree);
  Real sum = 0;
  bool started = false;
  ((add_tap<kDegree, 1, kInward - kReach>(self, step, sum, started),
    add_tap<kDegree, 1, kReach - kInward>(self, step, sum, started)),
   ...);
  add_tap<kDegree, 1, 0>(self, step, sum, started);
  return sum;
}

template <int kDegree, class Real>
void children(Index width, const Real* __restrict self, Count scalars, Real* __restrict first,
              Real* __restrict second) {
  using Inward = std::make_integer_sequence<int, reach_of(kDegree)>;
  const std::ptrdiff_t step = width;
  for (Count k = 0; k < scalars; ++k) {
    if constexpr (kDegree % 2 == 1) {
      primal_children<kDegree>(self + k, step, first[k], second[k], Inward{});
    } else {
      first[k] = dual_child<kDegree>(self + k, -step, Inward{});
      second[k] = dual_child<kDegree>(self + k, step, Inward{});
    }
  }
}

template <class Real>
using Children = void (*)(Index, const Real*, Count, Real*, Real*);

template <class Real, int... kLess>
constexpr std::array<Children<Real>, sizeof...(kLess)> children_by_degree(
    std::integer_sequence<int, kLess...>) {
  return {&children<kLess + 1, Real>...};
}

// --- Limits -----------------------------------------------------------------------------------------------

// Cardinal B-splines of degree 0 to kMaxCurveDegree on half integers y/2, as integers:
//   W_p(y) = 2^{p+1} p! B_p(y/2),   W_p(y) = (p+1+y) W_{p-1}(y+1) + (p+1-y) W_{p-1}(y-1)
// from B_p(x) = (((p+1)/2 + x) B_{p-1}(x+1/2) + ((p+1)/2 - x) B_{p-1}(x-1/2)) / p.
//   [Cox72; deBoor72; Schoenberg73, centred]
// B_0 at its jumps is 1/2. The largest number, 2^16 15!, is below 2^57.
class Cardinal {
 public:
  explicit Cardinal(Index degree) : degree_(static_cast<int>(degree)) {
    at(scaled_, 0) = 2;
    at(scaled_, -1) = at(scaled_, 1) = 1;
    for (int p = 1; p <= degree_; ++p) raise_to(p);
  }

  double value(int twice) const { return quotient(at(scaled_, twice), scale_); }
  // B_p'(x) = B_{p-1}(x+1/2) - B_{p-1}(x-1/2)
  double slope(int twice) const {
    return quotient(at(lower_, twice + 1) - at(lower_, twice - 1), scale_ / (2 * degree_));
  }

 private:
  static constexpr int kMiddle = static_cast<int>(kMaxCurveDegree) + 4;
  using Row = std::array<std::int64_t, 2 * std::size_t{kMiddle} + 1>;

  static std::size_t place_of(int twice) {
    const int place = kMiddle + twice;
    return static_cast<std::size_t>(place);
  }
  static std::int64_t& at(Row& row, int twice) { return row[place_of(twice)]; }
  static std::int64_t at(const Row& row, int twice) { return row[place_of(twice)]; }
  // In lowest terms both are below 2^53, so that this is the double next to the true quotient.
  static double quotient(std::int64_t above, std::int64_t below) {
    const std::int64_t common = std::gcd(above, below);
    const std::int64_t reduced_above = above / common, reduced_below = below / common;
    return static_cast<double>(reduced_above) / static_cast<double>(reduced_below);
  }
  void raise_to(int p) {
    lower_ = scaled_;
    for (int y = -p - 1; y <= p + 1; ++y)
      at(scaled_, y) = (p + 1 + y) * at(lower_, y + 1) + (p + 1 - y) * at(lower_, y - 1);
    scale_ *= 2 * p;
  }

  int degree_;
  std::int64_t scale_ = 2;  // 2^{p+1} p!
  Row scaled_{}, lower_{};  // W_p, W_{p-1}
};

}  // namespace

CurveSplit lane_riesenfeld_split(Index degree) {
  return {degree % 2 == 0, static_cast<Index>(reach_of(static_cast<int>(degree))), degree};
}

std::vector<double> lane_riesenfeld_mask(Index degree) {
  const int p = static_cast<int>(degree);
  std::vector<double> mask;
  for (int k = -half_width(p); k <= p + 1 - half_width(p); ++k) mask.push_back(mask_weight(p, k));
  return mask;
}

LimitMasks lane_riesenfeld_limits(Index degree) {
  const Cardinal cardinal(degree);
  LimitMasks masks;
  for (int k = 0; cardinal.value(2 * k) != 0; ++k) masks.values.push_back(cardinal.value(2 * k));
  masks.slopes.push_back(0);
  for (int k = 1; cardinal.slope(2 * k) != 0; ++k) masks.slopes.push_back(-cardinal.slope(2 * k));
  // c_k - c_{-k} = 2 (c_k - e) about a pinned end, where dual points are at half integers.
  const bool dual = degree % 2 == 0;
  for (int k = dual ? 1 : 2; cardinal.slope(k) != 0; k += 2)
    masks.end_slopes.push_back(-2 * cardinal.slope(k));
  return masks;
}

template <class Real>
void lane_riesenfeld_children(Index degree, Index width, const Real* self, Count scalars, Real* first,
                              Real* second) {
  static constexpr auto kChildren =
      children_by_degree<Real>(std::make_integer_sequence<int, int{kMaxCurveDegree}>{});
  assert(degree >= 1 && degree <= kMaxCurveDegree);
  kChildren[degree - 1](width, self, scalars, first, second);
}

template void lane_riesenfeld_children<float>(Index, Index, const float*, Count, float*, float*);
template void lane_riesenfeld_children<double>(Index, Index, const double*, Count, double*, double*);

}  // namespace subdivd

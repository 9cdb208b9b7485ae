#include "core/curves/lane_riesenfeld.h"

#include <array>
#include <cassert>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>

namespace subdivd {
namespace {

#include "core/curves/kernels/curve_rules.inc"

template <int kDegree, class Real>
void children(Index width, const Real* __restrict self, Count scalars, Real* __restrict first,
              Real* __restrict second) {
  const std::ptrdiff_t step = width;
  constexpr LaneRiesenfeldRule<Real, kDegree> kRule;
  for (Count k = 0; k < scalars; ++k)
    kRule([=](std::ptrdiff_t away) { return self[away * step + static_cast<std::ptrdiff_t>(k)]; }, first[k],
          second[k]);
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

Result<void> UniformBSpline::check() const {
  if (degree >= 1 && degree <= kMaxCurveDegree) return {};
  return Error{
      ErrorCode::out_of_range,
      "the degree is " + std::to_string(degree) + "; it must be 1 to " + std::to_string(kMaxCurveDegree),
      {"degree"}};
}

std::string UniformBSpline::description() const {
  return degree == 3 ? "cubic curve" : "curve of degree " + std::to_string(degree);
}

CurveSplit UniformBSpline::split() const {
  return {.dual = degree % 2 == 0,
          .reach = static_cast<Index>(reach_of(static_cast<int>(degree))),
          .lost = degree};
}

std::vector<double> lane_riesenfeld_mask(Index degree) {
  const int p = static_cast<int>(degree);
  std::vector<double> mask;
  for (int k = -half_width(p); k <= p + 1 - half_width(p); ++k) mask.push_back(mask_weight(p, k));
  return mask;
}

LimitMasks UniformBSpline::limit_masks() const {
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
void UniformBSpline::children(Index width, const Real* self, Count scalars, Real* first, Real* second) const {
  static constexpr auto kChildren =
      children_by_degree<Real>(std::make_integer_sequence<int, int{kMaxCurveDegree}>{});
  assert(degree >= 1 && degree <= kMaxCurveDegree);
  kChildren[degree - 1](width, self, scalars, first, second);
}

template void UniformBSpline::children<float>(Index, const float*, Count, float*, float*) const;
template void UniformBSpline::children<double>(Index, const double*, Count, double*, double*) const;

}  // namespace subdivd

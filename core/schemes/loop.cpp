#include "core/schemes/loop.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/schemes/creased.h"

namespace subdivd {
namespace {

using std::numbers::pi;

VertexMask smooth_mask(double beta, Index n) { return {1 - n * beta, beta, 0, {0, 0}}; }

}  // namespace

std::span<const SchemeOption<Loop>> Loop::options() {
  static constexpr std::array<std::string_view, 2> kWords = {"loop", "warren"};
  static constexpr std::array kOptions = {SchemeOption<Loop>{
      .name = "loopWeights",
      .short_name = "weights",
      .words = kWords,
      .help = "Weights of the smooth vertex point: Loop 1987 or Warren 1995. They agree at valences 3 and 6 "
              "only.",
      .set = [](Loop& loop, std::size_t word) { loop.weights = static_cast<LoopWeights>(word); },
      .get = [](const Loop& loop) { return static_cast<std::size_t>(loop.weights); }}};
  return kOptions;
}

std::string_view Loop::beyond_opensubdiv() const {
  return weights == LoopWeights::loop
             ? ""
             : "knows Loop's weights only: leave out verify or take loopWeights loop";
}

double Loop::beta(Index n) const {
  if (weights == LoopWeights::warren) return n == 3 ? 3.0 / 16 : 3.0 / (8.0 * n);
  if (n == 6) return 1.0 / 16;  // what the formula gives, without its rounding
  const double a = 3.0 / 8 + std::cos(2 * pi / n) / 4;
  return (5.0 / 8 - a * a) / n;
}

EdgeMask Loop::edge_mask(const EdgeRing& ring) const {
  return creased_edge({3.0 / 8, 1.0 / 8 * 2 / std::max<Index>(ring.face_count, 1)}, ring);
}

VertexMask Loop::vertex_mask(const VertexRing& ring) const {
  return creased_vertex(ring, [&] { return smooth_mask(beta(ring.face_count), ring.face_count); });
}

VertexMask Loop::smooth_limit_mask(Index n) const {
  const double e = 1 / (n + 3 / (8 * beta(n)));
  return {1 - n * e, e, 0, {0, 0}};
}

VertexMask Loop::crease_limit_mask(Index a, Index b) const { return {2.0 / 3, 0, 1.0 / 6, {a, b}}; }

// With weights x for v, a for the crease's end e_0 and y_k for the others, a limit mask reproduces itself:
//   e_k:  y_k = beta x + 3/8 y_k + 1/8 (y_{k-1} + y_{k+1}),  y_0 = y_n = 0 because the crease's edge point
//         takes nothing from its neighbours, so 5 y_k - y_{k-1} - y_{k+1} = 8 beta x;
//   e_0:  a = beta x + a / 2 + 1/8 (y_1 + y_{n-1}).
// With r + 1/r = 5, r = (5 - sqrt(21)) / 2:  y_k = 8/3 beta x (1 - (r^k + r^{n-k}) / (1 + r^n)),
// a = 2 beta x + y_1 / 2 (y_1 = y_{n-1}), and the sum is 1.
RingMask Loop::dart_limit_mask(Index n, const Pace& pace) const {
  const double r = (5 - std::sqrt(21.0)) / 2;
  RingMask mask{1, std::vector<double>(n)};
  for (Index k = 1; k < n; ++k) {
    pace.spend(8);
    mask.edges[k] = 8.0 / 3 * beta(n) * (1 - (std::pow(r, k) + std::pow(r, n - k)) / (1 + std::pow(r, n)));
  }
  mask.edges[0] = 2 * beta(n) + (n > 1 ? mask.edges[1] / 2 : 0);
  const double sum = sum_of(mask);
  mask.self /= sum;
  for (double& weight : mask.edges) weight /= sum;
  return mask;
}

RingMask Loop::smooth_tangent_u(Index n, const Pace& pace) const {
  RingMask mask{0, std::vector<double>(n)};
  pace.for_each(n, [&](Index k) { mask.edges[k] = std::cos(2 * pi * k / n); });
  return mask;
}

RingMask Loop::smooth_tangent_v(Index n, const Pace& pace) const {
  RingMask mask{0, std::vector<double>(n)};
  pace.for_each(n, [&](Index k) { mask.edges[k] = std::sin(2 * pi * k / n); });
  return mask;
}

// Power iteration of m <- m S on the masks that are symmetric about the crease and sum to 0 (so that the
// eigenvalue 1, whose right eigenvector is constant, plays no part).
RingMask Loop::dart_tangent_u(Index n, const Pace& pace) const {
  const double b = beta(n);
  const RingMask limit = dart_limit_mask(n, pace);
  RingMask m = smooth_tangent_u(n, pace);
  for (int step = 0; step < 128; ++step) {
    RingMask next{(1 - n * b) * m.self + m.edges[0] / 2, std::vector<double>(n)};
    next.edges[0] = b * m.self + m.edges[0] / 2;
    for (Index k = 1; k < n; ++k) {
      pace.spend(1);
      next.self += 3.0 / 8 * m.edges[k];
      next.edges[k] += b * m.self + 3.0 / 8 * m.edges[k];
      next.edges[k - 1] += m.edges[k] / 8;
      next.edges[(k + 1) % n] += m.edges[k] / 8;
    }
    const double sum = sum_of(next);
    next.self -= sum * limit.self;
    double largest = 0;
    for (Index k = 0; k < n; ++k) {
      pace.spend(1);
      next.edges[k] -= sum * limit.edges[k];
      largest = std::max(largest, std::abs(next.edges[k]));
    }
    if (largest == 0) return m;
    next.self /= largest;
    for (double& weight : next.edges) weight /= largest;
    m = std::move(next);
  }
  return m;
}

// With weights a for e_0 and e_m and sin(i theta) for the e_i between them, which is what the inner columns
// ask for, the column of e_0 gives a (1 + 2 cos(theta)) = sin(theta) - cot(theta / 2) (weights sum to 0 and
// sum sin(i theta) = cot(theta / 2)). The formula often printed, sin(theta) for the ends and
// (2 cos(theta) - 2) sin(i theta) between, belongs to the other edge rule; it agrees only where m = 2.
RingMask Loop::crease_tangent_across(Index m, const Pace& pace) const {
  RingMask mask{0, std::vector<double>(m + 1)};
  if (m == 1) return {-2, {1, 1}};
  if (m == 2) return {-1, {0, 1, 0}};
  const double theta = pi / m;
  pace.for_each(m - 1, [&](Index i) { mask.edges[i + 1] = std::sin((i + 1) * theta); });
  mask.edges[0] = mask.edges[m] = -std::cos(theta) / std::tan(theta / 2) / (1 + 2 * std::cos(theta));
  mask.self = -sum_of(mask);
  return mask;
}

}  // namespace subdivd

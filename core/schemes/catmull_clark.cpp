#include "core/schemes/catmull_clark.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/schemes/creased.h"

namespace subdivd {
namespace {

using std::numbers::pi;

// A of the header, for the angle t between neighbouring edges.
double edge_weight(double t) { return 1 + std::cos(t) + std::cos(t / 2) * std::sqrt(2 * (9 + std::cos(t))); }

RingMask zero_mask(Index edges, Index faces) {
  return {0, std::vector<double>(edges), std::vector<double>(faces)};
}

// f(k) for cosine or sine of k times the angle between edges.
template <class F>
RingMask smooth_tangent(Index n, F&& f, const Pace& pace) {
  RingMask mask = zero_mask(n, n);
  const double a = edge_weight(2 * pi / n);
  pace.for_each(n, [&](Index k) {
    mask.edges[k] = a * f(k);
    mask.faces[k] = f(k) + f(k + 1);
  });
  return mask;
}

}  // namespace

EdgeMask CatmullClark::edge_mask(const EdgeRing& ring) const {
  EdgeMask smooth{1.0 / 4, 0, 1.0 / 2 / std::max<Index>(ring.face_count, 1)};
  if (triangles == TriangleRule::smooth && ring.face_count == 2 && ring.triangle_count > 0) {
    constexpr double kOfTriangle = 0.470, kOfOther = 1.0 / 4;
    smooth.face = ring.triangle_count == 2 ? kOfTriangle : (kOfTriangle + kOfOther) / 2;
    smooth.end = (1 - 2 * smooth.face) / 2;
  }
  return creased_edge(smooth, ring);
}

VertexMask CatmullClark::vertex_mask(const VertexRing& ring) const {
  return creased_vertex(ring, [&] {
    const double n = ring.face_count;
    return VertexMask{(n - 2) / n, 1 / (n * n), 0, {0, 0}, 1 / (n * n)};
  });
}

VertexMask CatmullClark::smooth_limit_mask(Index valence) const {
  const double n = valence, whole = n * (n + 5);
  return {n * n / whole, 4 / whole, 0, {0, 0}, 1 / whole};
}

VertexMask CatmullClark::crease_limit_mask(Index a, Index b) const { return {2.0 / 3, 0, 1.0 / 6, {a, b}}; }

// With weights x for v, a for the crease's end e_0, z_k for the other e_k (z_0 = z_n = 0) and g_k for d_k, a limit
// mask reproduces itself. Every new d_k is the point of its face, (v + e_k + e_{k+1} + d_k) / 4, and what takes
// that point is v (1/n^2) and the smooth edges (1/4):
//   d_k:  g_k = (g_k + x / n^2 + (z_k + z_{k+1}) / 4) / 4, so g_k = (x / n^2 + (z_k + z_{k+1}) / 4) / 3;
//   e_k:  z_k = x / n^2 + z_k / 4 + g_{k-1} + g_k, so 7 z_k - z_{k-1} - z_{k+1} = 20 x / n^2;
//   e_0:  a = x / n^2 + a / 2 + g_{n-1} + g_0.
// With r + 1/r = 7, r = (7 - sqrt(45)) / 2:  z_k = 4 x / n^2 (1 - (r^k + r^{n-k}) / (1 + r^n)), and the sum is 1.
RingMask CatmullClark::dart_limit_mask(Index n, const Pace& pace) const {
  const double r = (7 - std::sqrt(45.0)) / 2, share = 1 / (static_cast<double>(n) * n);
  RingMask mask = zero_mask(n, n);
  mask.self = 1;
  for (Index k = 1; k < n; ++k) {
    pace.spend(8);
    mask.edges[k] = 4 * share * (1 - (std::pow(r, k) + std::pow(r, n - k)) / (1 + std::pow(r, n)));
  }
  pace.for_each(
      n, [&](Index k) { mask.faces[k] = (share + (mask.edges[k] + mask.edges[(k + 1) % n]) / 4) / 3; });
  mask.edges[0] = 2 * (share + mask.faces[0] + mask.faces[n - 1]);
  const double sum = sum_of(mask);
  mask.self /= sum;
  for (double& weight : mask.edges) weight /= sum;
  for (double& weight : mask.faces) weight /= sum;
  return mask;
}

RingMask CatmullClark::smooth_tangent_u(Index n, const Pace& pace) const {
  if (n == 2) return {0, {1, -1}, {0, 0}};
  return smooth_tangent(
      n, [n](Index k) { return std::cos(2 * pi * k / n); }, pace);
}

RingMask CatmullClark::smooth_tangent_v(Index n, const Pace& pace) const {
  if (n == 2) return {0, {0, 0}, {1, -1}};
  return smooth_tangent(
      n, [n](Index k) { return std::sin(2 * pi * k / n); }, pace);
}

// Power iteration of m <- m S on the masks that are symmetric about the crease and sum to 0 (so that the
// eigenvalue 1, whose right eigenvector is constant, plays no part).
RingMask CatmullClark::dart_tangent_u(Index n, const Pace& pace) const {
  const double share = 1 / (static_cast<double>(n) * n), self = (n - 2.0) / n;
  const RingMask limit = dart_limit_mask(n, pace);
  RingMask m = smooth_tangent_u(n, pace);
  for (int step = 0; step < 256; ++step) {
    const double crease = std::exchange(m.edges[0], 0);
    RingMask next = zero_mask(n, n);
    next.self = self * m.self + crease / 2;
    for (Index k = 0; k < n; ++k) {
      pace.spend(2);
      const Index after = (k + 1) % n;
      const double face = (m.faces[k] + share * m.self + (m.edges[k] + m.edges[after]) / 4) / 4;
      next.self += m.edges[k] / 4 + face;
      next.edges[k] += share * m.self + m.edges[k] / 4 + face;
      next.edges[after] += face;
      next.faces[k] = face;
    }
    next.edges[0] += crease / 2;
    const double sum = sum_of(next);
    next.self -= sum * limit.self;
    double largest = 0;
    for (Index k = 0; k < n; ++k) {
      pace.spend(1);
      next.edges[k] -= sum * limit.edges[k];
      next.faces[k] -= sum * limit.faces[k];
      largest = std::max({largest, std::abs(next.edges[k]), std::abs(next.faces[k])});
    }
    if (largest == 0) return smooth_tangent_u(n, pace);
    next.self /= largest;
    for (double& weight : next.edges) weight /= largest;
    for (double& weight : next.faces) weight /= largest;
    m = std::move(next);
  }
  return m;
}

// With weights x for v, y for e_0 and e_m, z_k for the e_k between them and g_k for d_k, and the eigenvalue l:
//   d_k:  (4 l - 1) g_k = (z_k + z_{k+1}) / 4;     e_k:  (l - 1/4) z_k = l (g_{k-1} + g_k),
// which z_k = A sin(k t), g_k = sin(k t) + sin((k + 1) t), 4 l = 1 + A / 4 solve with A of the header, and
//   e_0:  l y = x / 8 + y / 2 + l g_0.
// Weights sum to 0, sum sin(k t) = cot(t / 2), so y A / 16 = l sin t - (A + 2) cot(t / 2) / 8. The formula often
// printed, with 4 in A's place, belongs to another edge rule; it agrees only where m = 2.
RingMask CatmullClark::crease_tangent_across(Index m, const Pace& pace) const {
  if (m == 1) return {-2, {1, 1}, {0}};
  if (m == 2) return {-4, {-1, 4, -1}, {1, 1}};
  RingMask mask = zero_mask(m + 1, m);
  const double t = pi / m, a = edge_weight(t), eigenvalue = (4 + a) / 16;
  pace.for_each(m, [&](Index k) {
    if (k > 0) mask.edges[k] = a * std::sin(k * t);
    mask.faces[k] = std::sin(k * t) + std::sin((k + 1) * t);
  });
  mask.edges[0] = mask.edges[m] = (eigenvalue * std::sin(t) - (a + 2) / std::tan(t / 2) / 8) * 16 / a;
  mask.self = -sum_of(mask);
  return mask;
}

}  // namespace subdivd

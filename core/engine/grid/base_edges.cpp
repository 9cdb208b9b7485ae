#include "core/engine/grid/base_edges.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/engine/grid/regular_ring.h"
#include "core/lattice/numbering.h"
#include "core/lattice/quads.h"

namespace subdivd {
namespace {

// Of a ring around a point inside an edge, counter-clockwise from the edge: what the edge's two segments at the point
// have, and 0 at all others.
template <class Scheme>
std::array<float, Scheme::regular_valence> on_segments(float ahead, float behind) {
  std::array<float, Scheme::regular_valence> ring{};
  ring[0] = ahead;
  ring[Scheme::regular_valence / 2] = behind;
  return ring;
}

}  // namespace

template <class Scheme, class Real>
void BaseEdges<Scheme, Real>::refine_strip(Index level, std::size_t position, const Real* from,
                                           Real* to) const {
  const SemiSharp &parent = net_.semi_sharp(level), &next = net_.semi_sharp(level + 1);
  const Index e = parent.edges[position];
  const auto found = std::ranges::lower_bound(next.edges, e);
  const bool goes_on = found != next.edges.end() && *found == e;
  const auto child = [&](Count k) {
    return goes_on ? next.segment(static_cast<std::size_t>(found - next.edges.begin()), k) : 0.0f;
  };
  const Numbering numbering(net_.topology(), level);
  const Count n = segments(level);
  const auto sides = net_.topology().edge_sides()[e];
  constexpr Index kValence = Scheme::regular_valence;
  const auto at = [&](Count point) { return from + point * width_; };
  Real* out = to + (net_.topology().vertex_count() + e * (2 * n - 1)) * width_;
  for (Count k = 0; k < n; ++k) {
    if (k > 0) {
      const auto sharp = on_segments<Scheme>(parent.segment(position, k), parent.segment(position, k - 1));
      const auto sharp_next = on_segments<Scheme>(child(2 * k), child(2 * k - 1));
      const VertexMask mask = scheme_.vertex_mask({kValence, net_.crease_method(), 0, 0, sharp, sharp_next});
      const auto around = numbering.ring_on_edge(e, k);
      const Real* here = at(numbering.along(e, k));
      for (Index c = 0; c < width_; ++c) {
        Real sum = static_cast<Real>(mask.self) * here[c];
        for (const Index point : around.edges) sum += static_cast<Real>(mask.each) * at(point)[c];
        for (const Index end : mask.crease_ends)
          sum += static_cast<Real>(mask.crease) * at(around.edges[end])[c];
        for (Index f = 0; f < around.opposite.size(); ++f)
          sum += static_cast<Real>(mask.face / 4) *
                 ((here[c] + at(around.edges[f])[c]) +
                  (at(around.opposite[f])[c] + at(around.edges[(f + 1) % kValence])[c]));
        *out++ = sum;
      }
    }
    const EdgeMask mask =
        scheme_.edge_mask({2, parent.segment(position, k), {child(2 * k), child(2 * k + 1)}});
    const Real *a = at(numbering.along(e, k)), *b = at(numbering.along(e, k + 1));
    if constexpr (kHasFacePoints) {
      const Real* beside[4] = {at(numbering.beside(sides[0], k)), at(numbering.beside(sides[0], k + 1)),
                               at(numbering.beside(sides[1], n - k)),
                               at(numbering.beside(sides[1], n - 1 - k))};
      for (Index c = 0; c < width_; ++c) {
        const Real ends = a[c] + b[c];
        *out++ = static_cast<Real>(mask.end) * ends +
                 static_cast<Real>(mask.face / 4) *
                     ((ends + (beside[0][c] + beside[1][c])) + (ends + (beside[2][c] + beside[3][c])));
      }
    } else {
      const Real *c0 = at(numbering.beside(sides[0], k)), *c1 = at(numbering.beside(sides[1], n - 1 - k));
      for (Index c = 0; c < width_; ++c)
        *out++ =
            static_cast<Real>(mask.end) * (a[c] + b[c]) + static_cast<Real>(mask.opposite) * (c0[c] + c1[c]);
    }
  }
}

template <class Scheme, class Real>
void BaseEdges<Scheme, Real>::refine_semi_sharp(Index level, const Real* from, Real* to, Index begin,
                                                Index end) const {
  const auto& edges = net_.semi_sharp(level).edges;
  for (auto at = std::ranges::lower_bound(edges, begin); at != edges.end() && *at < end; ++at)
    refine_strip(level, static_cast<std::size_t>(at - edges.begin()), from, to);
}

// Every face along the crease is one side of the surface: a regular border at each point.
template <class Scheme, class Real>
void BaseEdges<Scheme, Real>::limit_crease(Index level, const Real* values, const Evaluated<Real>& out,
                                           Index e, const Pace& pace) const {
  const Numbering numbering(net_.topology(), level);
  const Count n = segments(level);
  const VertexMask mask = scheme_.crease_limit_mask(0, 1);
  const RingMask across = scheme_.crease_tangent_across(Scheme::regular_valence / 2);
  const auto along = net_.topology().edge_half_edges(e);
  std::vector<Index> half_edges(along.begin(), along.end());
  if (half_edges.size() == 2 && half_edges[0] > half_edges[1])
    std::swap(half_edges[0], half_edges[1]);  // the lowest's side is the first; of more they ascend
  const Index low = net_.topology().edge_vertices(e)[0];
  for (Count k = 1; k < n; ++k) {
    const Index point = numbering.along(e, k), ahead = numbering.along(e, k + 1),
                behind = numbering.along(e, k - 1);
    const auto at = [&](Count p) { return values + p * width_; };
    if (out.limits != nullptr)
      for (Index c = 0; c < width_; ++c)
        out.limits[Count{point} * width_ + c] =
            static_cast<Real>(mask.self) * at(point)[c] +
            static_cast<Real>(mask.crease) * (at(ahead)[c] + at(behind)[c]);
    if (!out.wants_frames()) continue;
    FrameMean<Real> frames;
    for (std::size_t s = 0; s < half_edges.size(); ++s) {
      pace.spend(8);
      const Index h = half_edges[s];
      const bool forward = net_.topology().corner_vertex(h) == low;
      const Count p = forward ? k : n - k;  // from the half-edge's own start
      const auto ring = numbering.ring_beside(h, p);
      Frame<Real> frame;
      for (int c = 0; c < 3; ++c) {
        frame.u[c] = at(ring.edges.front())[c] - at(ring.edges.back())[c];
        frame.v[c] = 0;
        const auto add = [&](double weight, Index neighbour) {
          frame.v[c] += static_cast<Real>(weight) * (at(neighbour)[c] - at(point)[c]);
        };
        for (std::size_t i = 0; i < ring.edges.size(); ++i) add(across.edges[i], ring.edges[i]);
        for (std::size_t i = 0; i < ring.opposite.size(); ++i) add(across.faces[i], ring.opposite[i]);
      }
      if (set_normal(frame)) {
        frames.add(frame);
        continue;
      }
      Ring<Real> whole;
      whole.center = {at(point), at(point) + 3};
      whole.edge_sharpness.assign(ring.edges.size(), 0.0f);
      whole.edge_sharpness.front() = whole.edge_sharpness.back() = kInfiniteSharpness;
      whole.set_fan(Scheme::regular_valence / 2, false);
      for (const Index neighbour : ring.edges)
        whole.neighbors.insert(whole.neighbors.end(), at(neighbour), at(neighbour) + 3);
      for (const Index neighbour : ring.opposite)
        whole.opposite.insert(whole.opposite.end(), at(neighbour), at(neighbour) + 3);
      frames.add(LimitRing<Scheme, Real>(scheme_, net_.crease_method(), std::move(whole)).frames()[0]);
    }
    write_frames(frames, out, point);
  }
}

template <class Scheme, class Real>
void BaseEdges<Scheme, Real>::limit_semi_sharp(Index level, std::size_t position, const Real* values,
                                               const Evaluated<Real>& out) const {
  const SemiSharp& semi = net_.semi_sharp(level);
  const Index e = semi.edges[position];
  const Numbering numbering(net_.topology(), level);
  for (Count k = 1; k < segments(level); ++k) {
    const Index point = numbering.along(e, k);
    Ring<Real> ring = regular_ring(net_.topology(), level, values, width_, point);
    const auto sharp = on_segments<Scheme>(semi.segment(position, k), semi.segment(position, k - 1));
    ring.edge_sharpness.assign(sharp.begin(), sharp.end());
    if (net_.crease_method() == CreaseMethod::chaikin) ring.around = decay_sums(ring.edge_sharpness);
    const auto far_child = on_segments<Scheme>(net_.segment_sharpness(level + 1, e, 2 * k + 1),
                                               net_.segment_sharpness(level + 1, e, 2 * k - 2));
    ring.far_child.assign(far_child.begin(), far_child.end());
    const LimitRing<Scheme, Real> limit(scheme_, net_.crease_method(), std::move(ring));
    if (out.limits != nullptr) std::ranges::copy(limit.position(), out.limits + Count{point} * width_);
    if (!out.wants_frames()) continue;
    FrameMean<Real> frames;
    limit.for_each_frame([&](const Frame<Real>& frame) { frames.add(frame); });
    write_frames(frames, out, point);
  }
}

template <class Scheme, class Real>
void BaseEdges<Scheme, Real>::limit(Index level, const Real* values, const Evaluated<Real>& out, Index begin,
                                    Index end, const Pace& pace) const {
  const Count n = segments(level);
  if (n < 2) return;
  for (Index e = begin; e < end; ++e) {
    if (net_.edge_rules()[e] == EdgeRule::crease) limit_crease(level, values, out, e, pace);
    if (net_.edge_rules()[e] == EdgeRule::linear && out.limits != nullptr) {
      const Count first = (net_.topology().vertex_count() + e * (n - 1)) * width_;
      std::copy_n(values + first, (n - 1) * width_, out.limits + first);
    }
  }
  const auto& edges = net_.semi_sharp(level).edges;
  for (auto at = std::ranges::lower_bound(edges, begin); at != edges.end() && *at < end; ++at)
    limit_semi_sharp(level, static_cast<std::size_t>(at - edges.begin()), values, out);
}

#define SUBDIVD_INSTANTIATE(S)        \
  template class BaseEdges<S, float>; \
  template class BaseEdges<S, double>;
SUBDIVD_FOR_EACH_GRID_SCHEME(SUBDIVD_INSTANTIATE)
#undef SUBDIVD_INSTANTIATE

}  // namespace subdivd

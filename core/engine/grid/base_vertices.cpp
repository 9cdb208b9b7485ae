#include "core/engine/grid/base_vertices.h"

#include <algorithm>

#include "core/lattice/quads.h"
#include "core/lattice/split.h"

namespace subdivd {

template <class Scheme, class Real>
BaseVertices<Scheme, Real>::BaseVertices(const Net<Faces>& net, const Scheme& scheme, Index width,
                                         Smoothing smoothing)
    : net_(net), scheme_(scheme), width_(width), linear_(smoothing == Smoothing::linear) {
  for (const Index n : net.valences())
    smooth_[n] = scheme.vertex_mask({n, net.crease_method(), 0, 0, {}, {}});
  constexpr std::array<float, 2> kCrease{kInfiniteSharpness, kInfiniteSharpness};
  crease_ = scheme.vertex_mask({1, net.crease_method(), 0, 0, kCrease, kCrease});
}

template <class Scheme, class Real>
VertexMask BaseVertices<Scheme, Real>::smooth_mask(Index valence) const {
  if (valence <= kListedValence) return smooth_[valence];
  return scheme_.vertex_mask({valence, net_.crease_method(), 0, 0, {}, {}});
}

// The two infinitely sharp edges of a crease vertex, as positions among its edges.
template <class Scheme, class Real>
std::array<Index, 2> BaseVertices<Scheme, Real>::crease_edges(Index v) const {
  std::array<Index, 2> found{};
  std::size_t count = 0;
  const auto edges = net_.topology().vertex_edges(v);
  for (std::size_t k = 0; k < edges.size() && count < 2; ++k)
    if (is_infinite(net_.sharpness().edges[edges[k]])) found[count++] = static_cast<Index>(k);
  return found;
}

// Every edge's neighbour in the order of the edges around v, then the crease, then the vertex itself: the
// order of the plain engine, to the bit. Faces come before them: their weights are the smallest, and a
// thousand of them behind a pole's own would each be rounded to its last digit.
template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::weigh(Index level, const Real* from, Index v, const VertexMask& mask,
                                       FaceTerm term, Real* out, const Pace& pace) const {
  const auto& topology = net_.topology();
  const Count n = segments(level);
  const auto edges = topology.vertex_edges(v);
  std::fill_n(out, width_, Real(0));
  const auto add = [&](double weight, Count point) {
    const Real* at = from + point * width_;
    for (Index c = 0; c < width_; ++c) out[c] += static_cast<Real>(weight) * at[c];
  };
  if constexpr (kHasFacePoints) {
    if (mask.face != 0) {
      const Numbering<Quads> numbering(topology, level);
      for (const Index h : topology.vertex_corners(v)) {
        pace.spend(4 + width_);
        if (term == FaceTerm::opposite) {
          add(mask.face, numbering.opposite(h));
          continue;
        }
        const Index along[2] = {topology.half_edge_edge(h), topology.half_edge_edge(Quads::prev(h))};
        for (const Count point :
             {Count{v}, beside(n, along[0], v), Count{numbering.opposite(h)}, beside(n, along[1], v)})
          add(mask.face / 4, point);
      }
    }
  }
  if (mask.each != 0)
    for (const Index e : edges) {
      pace.spend(1 + width_ / 4);
      add(mask.each, beside(n, e, v));
    }
  if (mask.crease != 0)
    for (const Index end : mask.crease_ends) add(mask.crease, beside(n, edges[end], v));
  add(mask.self, v);
}

template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::refine_special(Index level, const Real* from, Real* to, Index v,
                                                const Pace& pace) const {
  const VertexRule rule = net_.vertex_rules()[v];
  VertexMask mask;  // v stays
  if (rule == VertexRule::smooth || rule == VertexRule::dart) {
    mask = smooth_mask(static_cast<Index>(net_.topology().vertex_edges(v).size()));
  } else if (rule == VertexRule::crease) {
    const auto ends = crease_edges(v);
    mask = {crease_.self, crease_.each, crease_.crease, {ends[0], ends[1]}};
  }
  weigh(level, from, v, mask, FaceTerm::points, to + Count{v} * width_, pace);
}

template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::refine_unsettled(Index level, const Real* from, Real* to, Index v,
                                                  const Pace& pace) const {
  const Topology<Faces>& topology = net_.topology();
  if (net_.vertex_rules()[v] == VertexRule::corner) return;
  std::vector<float> sharpness, child;
  for (const Index e : topology.vertex_edges(v)) {
    pace.spend(16);
    sharpness.push_back(net_.sharpness_beside(level, e, v));
    child.push_back(net_.sharpness_beside(level + 1, e, v));
  }
  const float own = net_.semi_sharp(level).vertex(v);
  const VertexMask mask = scheme_.vertex_mask({static_cast<Index>(topology.vertex_corners(v).size()),
                                               net_.crease_method(), own, decay(own), sharpness, child});
  weigh(level, from, v, mask, FaceTerm::points, to + Count{v} * width_, pace);
}

template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::refine(Index level, const Real* from, Real* to, Index begin, Index end,
                                        const Pace& pace) const {
  for_each_in(net_.special_vertices(), begin, end,
              [&](Index v) { refine_special(level, from, to, v, pace); });
  for_each_in(net_.unsettled_vertices(level), begin, end,
              [&](Index v) { refine_unsettled(level, from, to, v, pace); });
}

// The point of a face of v is the mean of v, the ends of two edges and the vertex opposite: a smooth vertex has each
// edge in two faces.
template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::put_weights(const VertexMask& mask, FaceTerm term, Index n, Real* out) {
  const double quarter = term == FaceTerm::points ? mask.face / 4 : 0;
  out[0] = static_cast<Real>(mask.self + n * quarter);
  out[1] = static_cast<Real>(mask.each + 2 * quarter);
  if (kHasFacePoints) out[2] = static_cast<Real>(term == FaceTerm::points ? quarter : mask.face);
}

template <class Scheme, class Real>
std::vector<Real> BaseVertices<Scheme, Real>::smooth_masks() const {
  std::vector<Real> masks(kWeights * smooth_.size(), Real(0));
  for (const Index n : net_.valences()) put_weights(smooth_[n], FaceTerm::points, n, &masks[kWeights * n]);
  return masks;
}

template <class Scheme, class Real>
std::vector<Real> BaseVertices<Scheme, Real>::limit_masks() const {
  std::vector<Real> masks(kWeights * smooth_.size(), Real(0));
  for (const Index n : net_.valences())
    put_weights(scheme_.smooth_limit_mask(n), FaceTerm::opposite, n, &masks[kWeights * n]);
  return masks;
}

template <class Scheme, class Real>
std::vector<Real> BaseVertices<Scheme, Real>::tangent_masks() const {
  constexpr std::size_t kPerEdge = kHasFacePoints ? 4 : 2, kRow = kPerEdge * kListedValence;
  std::vector<Real> weights(kRow * smooth_.size(), Real(0));
  for (const Index n : net_.valences()) {
    const RingMask u = scheme_.smooth_tangent_u(n), v = scheme_.smooth_tangent_v(n);
    for (Index k = 0; k < n; ++k) {
      Real* const at = &weights[kRow * n + kPerEdge * k];
      at[0] = static_cast<Real>(u.edges[k]);
      at[1] = static_cast<Real>(v.edges[k]);
      if (!kHasFacePoints) continue;
      at[2] = static_cast<Real>(u.faces[k]);
      at[3] = static_cast<Real>(v.faces[k]);
    }
  }
  return weights;
}

template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::prepare_limits(Index level, const Pace& pace) {
  if (net_.crease_method() != CreaseMethod::chaikin) return;
  const Net<Faces>& mesh = net_.mesh();
  decay_sums_.clear();
  for (const Index v : mesh.unsettled_vertices(level)) {
    std::vector<float> around;
    for (const Index e : mesh.topology().vertex_edges(v)) {
      pace.spend(16);
      around.push_back(mesh.sharpness_beside(level, e, v));
    }
    decay_sums_.push_back(decay_sums(std::move(around), pace));
  }
}

template <class Scheme, class Real>
Ring<Real> BaseVertices<Scheme, Real>::ring(Index level, const Real* values, Index v,
                                            const Pace& pace) const {
  const Topology<Faces>& topology = net_.topology();
  const Count n = segments(level);
  Ring<Real> ring;
  ring.width = width_;
  const auto append = [&](std::vector<Real>& to, Count point) {
    to.insert(to.end(), values + point * width_, values + (point + 1) * width_);
  };
  append(ring.center, v);
  const float own = net_.sharpness().vertices[v];
  ring.vertex_sharpness = is_infinite(own) ? own : net_.semi_sharp(level).vertex(v);
  const auto edges = topology.vertex_edges(v);
  ring.neighbors.reserve(edges.size() * width_);
  for (const Index e : edges) {
    pace.spend(16 + width_);
    append(ring.neighbors, beside(n, e, v));
    ring.edge_sharpness.push_back(net_.sharpness_beside(level, e, v));
  }
  ring.set_faces(topology, v, pace);
  if constexpr (kHasFacePoints)
    for (const Index h : topology.vertex_corners(v)) {
      pace.spend(4 + width_);
      append(ring.opposite, Numbering(topology, level).opposite(h));
    }
  if (ring.wedges.empty()) return ring;

  if (!decay_sums_.empty()) {
    const Net<Faces>& mesh = net_.mesh();
    const Index mesh_vertex = mesh.topology().corner_vertex(topology.vertex_corners(v)[0]);
    const auto unsettled = mesh.unsettled_vertices(level);
    const auto at = std::ranges::lower_bound(unsettled, mesh_vertex);
    if (at != unsettled.end() && *at == mesh_vertex)
      ring.around = decay_sums_[static_cast<std::size_t>(at - unsettled.begin())];
  }
  for (const Index e : edges) {
    pace.spend(16);
    ring.far_child.push_back(net_.sharpness_far(level, e, v));
  }
  return ring;
}

template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::limit_by_ring(Index level, const Real* values, const Evaluated<Real>& out,
                                               Index v, bool frames_only, const Pace& pace) const {
  const LimitRing<Scheme, Real> limit(scheme_, net_.crease_method(), ring(level, values, v, pace), pace);
  if (out.limits != nullptr && !frames_only)
    std::ranges::copy(limit.position(), out.limits + Count{v} * width_);
  if (!out.wants_frames()) return;
  FrameMean<Real> frames;
  limit.for_each_frame([&](const Frame<Real>& frame) { frames.add(frame); });
  write_frames(frames, out, v);
}

template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::limit_special(Index level, const Real* values, const Evaluated<Real>& out,
                                               Index v, const Pace& pace) const {
  if (out.limits != nullptr) {
    VertexMask mask;  // v stays
    const VertexRule rule = net_.vertex_rules()[v];
    if (rule == VertexRule::smooth) {
      mask = scheme_.smooth_limit_mask(static_cast<Index>(net_.topology().vertex_edges(v).size()));
    } else if (rule == VertexRule::crease) {
      const auto ends = crease_edges(v);
      mask = scheme_.crease_limit_mask(ends[0], ends[1]);
    }
    weigh(level, values, v, mask, FaceTerm::opposite, out.limits + Count{v} * width_, pace);
  }
  if (out.wants_frames()) limit_by_ring(level, values, out, v, true, pace);
}

template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::limit(Index level, const Real* values, const Evaluated<Real>& out,
                                       Index begin, Index end, const Pace& pace) const {
  for_each_in(net_.special_vertices(), begin, end,
              [&](Index v) { limit_special(level, values, out, v, pace); });
  const auto by_ring = [&](Index v) { limit_by_ring(level, values, out, v, false, pace); };
  for_each_in(net_.darts(), begin, end, by_ring);
  for_each_in(net_.unsettled_vertices(level), begin, end, by_ring);
}

#define SUBDIVD_INSTANTIATE(S)           \
  template class BaseVertices<S, float>; \
  template class BaseVertices<S, double>;
SUBDIVD_FOR_EACH_GRID_SCHEME(SUBDIVD_INSTANTIATE)
#undef SUBDIVD_INSTANTIATE

}  // namespace subdivd

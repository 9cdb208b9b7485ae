#include "core/refine/base_vertices.h"

#include <algorithm>
#include <type_traits>

#include "core/mesh/positions.h"
#include "core/refine/split.h"

namespace subdivd {

template <class Real>
void write_frames(std::span<const Frame<Real>> frames, const Evaluated<Real>& out, Count vertex) {
  const Frame<Real> none;
  const Frame<Real>& first = frames.empty() ? none : frames[0];
  if (out.tangents_u != nullptr) std::copy_n(first.u, 3, out.tangents_u + 3 * vertex);
  if (out.tangents_v != nullptr) std::copy_n(first.v, 3, out.tangents_v + 3 * vertex);
  if (out.normals != nullptr) mean_normal<Real>(frames, out.normals + 3 * vertex);
}

template <class Scheme, class Real>
BaseVertices<Scheme, Real>::BaseVertices(const Net& net, const Scheme& scheme, Index width,
                                         Smoothing smoothing)
    : net_(net), scheme_(scheme), width_(width), linear_(smoothing == Smoothing::linear) {
  for (const Index n : net.valences())
    table_[n].vertex = scheme.vertex_mask({n, net.crease_method(), 0, 0, {}, {}});
  constexpr std::array<float, 2> kCrease{kInfiniteSharpness, kInfiniteSharpness};
  crease_ = scheme.vertex_mask({1, net.crease_method(), 0, 0, kCrease, kCrease});
}

template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::prepare_limits(bool frames) {
  for (const Index n : net_.valences()) {
    table_[n].limit = scheme_.smooth_limit_mask(n);
    if (!frames) continue;
    for (auto [mask, to] : {std::pair{scheme_.smooth_tangent_u(n), &table_[n].tangent_u},
                            std::pair{scheme_.smooth_tangent_v(n), &table_[n].tangent_v}})
      to->assign(mask.edges.begin(), mask.edges.end());
  }
}

template <class Scheme, class Real>
VertexMask BaseVertices<Scheme, Real>::smooth_mask(Index valence) const {
  if (valence <= Net::kListedValence) return table_[valence].vertex;
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
// order of the plain engine, to the bit.
template <class Scheme, class Real>
template <class Width>
void BaseVertices<Scheme, Real>::weigh(Count n, const Real* from, Index v, const VertexMask& mask, Real* out,
                                       Width width) const {
  const auto edges = net_.topology().vertex_edges(v);
  for (Index c = 0; c < width; ++c) out[c] = 0;
  const auto add = [&](Real weight, Count point) {
    const Real* at = from + point * width;
    for (Index c = 0; c < width; ++c) out[c] += weight * at[c];
  };
  if (mask.each != 0)
    for (const Index e : edges) add(static_cast<Real>(mask.each), beside(n, e, v));
  if (mask.crease != 0)
    for (const Index end : mask.crease_ends) add(static_cast<Real>(mask.crease), beside(n, edges[end], v));
  add(static_cast<Real>(mask.self), v);
}

template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::refine_special(Count n, const Real* from, Real* to, Index v) const {
  const VertexRule rule = net_.vertex_rules()[v];
  VertexMask mask;  // v stays
  if (rule == VertexRule::smooth || rule == VertexRule::dart) {
    mask = smooth_mask(static_cast<Index>(net_.topology().vertex_edges(v).size()));
  } else if (rule == VertexRule::crease) {
    const auto ends = crease_edges(v);
    mask = {crease_.self, crease_.each, crease_.crease, {ends[0], ends[1]}};
  }
  weigh(n, from, v, mask, to + Count{v} * width_, width_);
}

template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::refine_unsettled(Index level, const Real* from, Real* to, Index v) const {
  const Topology& topology = net_.topology();
  if (net_.vertex_rules()[v] == VertexRule::corner) return;
  std::vector<float> sharpness, child;
  for (const Index e : topology.vertex_edges(v)) {
    sharpness.push_back(net_.sharpness_beside(level, e, v));
    child.push_back(net_.sharpness_beside(level + 1, e, v));
  }
  const float own = net_.semi_sharp(level).vertex(v);
  const VertexMask mask = scheme_.vertex_mask({static_cast<Index>(topology.vertex_corners(v).size()),
                                               net_.crease_method(), own, decay(own), sharpness, child});
  weigh(segments(level), from, v, mask, to + Count{v} * width_, width_);
}

template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::refine(Index level, const Real* from, Real* to, Index begin,
                                        Index end) const {
  const auto each = [&](std::span<const Index> vertices, auto f) {
    for (auto at = std::ranges::lower_bound(vertices, begin); at != vertices.end() && *at < end; ++at) f(*at);
  };
  each(net_.special_vertices(), [&](Index v) { refine_special(segments(level), from, to, v); });
  each(net_.unsettled_vertices(level), [&](Index v) { refine_unsettled(level, from, to, v); });
}

template <class Scheme, class Real>
std::vector<Real> BaseVertices<Scheme, Real>::smooth_masks() const {
  std::vector<Real> masks(2 * table_.size(), Real(0));
  for (const Index n : net_.valences()) {
    masks[2 * n] = static_cast<Real>(table_[n].vertex.self);
    masks[2 * n + 1] = static_cast<Real>(table_[n].vertex.each);
  }
  return masks;
}

template <class Scheme, class Real>
template <class Width>
void BaseVertices<Scheme, Real>::limit_settled(Count n, const Real* values, Index v, Real* out,
                                               Width width) const {
  const auto edges = net_.topology().vertex_edges(v);
  VertexMask mask;
  switch (net_.vertex_rules()[v]) {
    case VertexRule::smooth:
    case VertexRule::dart: {
      const auto valence = static_cast<Index>(edges.size());
      mask = valence <= Net::kListedValence ? table_[valence].limit : scheme_.smooth_limit_mask(valence);
      break;
    }
    case VertexRule::crease: {
      const auto ends = crease_edges(v);
      mask = scheme_.crease_limit_mask(ends[0], ends[1]);
      break;
    }
    case VertexRule::corner:
      break;
  }
  weigh(n, values, v, mask, out, width);
}

// Counter-clockwise from the lowest corner on.
template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::smooth_frame(Count n, const Real* values, Index v,
                                              Frame<Real>& frame) const {
  const Topology& topology = net_.topology();
  const auto edges = topology.vertex_edges(v);
  const auto valence = static_cast<Index>(edges.size());
  const bool listed = valence <= Net::kListedValence;
  RingMask own_u, own_v;
  if (!listed) {
    own_u = scheme_.smooth_tangent_u(valence);
    own_v = scheme_.smooth_tangent_v(valence);
  }
  const Real* center = values + std::size_t{3} * v;
  for (Index k = 0; k < valence; ++k) {
    const Real* at = values + 3 * beside(n, edges[k], v);
    const Real weight_u = listed ? table_[valence].tangent_u[k] : static_cast<Real>(own_u.edges[k]);
    const Real weight_v = listed ? table_[valence].tangent_v[k] : static_cast<Real>(own_v.edges[k]);
    for (int c = 0; c < 3; ++c) {
      frame.u[c] += weight_u * (at[c] - center[c]);
      frame.v[c] += weight_v * (at[c] - center[c]);
    }
  }
}

template <class Scheme, class Real>
Ring<Real> BaseVertices<Scheme, Real>::ring(Index level, const Real* values, Index v) const {
  const Topology& topology = net_.topology();
  const Count n = segments(level);
  Ring<Real> ring;
  ring.width = width_;
  const auto append = [&](std::vector<Real>& to, Count point) {
    to.insert(to.end(), values + point * width_, values + (point + 1) * width_);
  };
  append(ring.center, v);
  const float own = net_.sharpness().vertices[v];
  ring.vertex_sharpness = is_infinite(own) ? own : net_.semi_sharp(level).vertex(v);
  for (const Index e : topology.vertex_edges(v)) {
    append(ring.neighbors, beside(n, e, v));
    ring.edge_sharpness.push_back(net_.sharpness_beside(level, e, v));
  }
  ring.set_faces(topology, v);
  if (ring.wedges.empty()) return ring;

  const Net& mesh = net_.mesh();
  const Index mesh_vertex = mesh.topology().corner_vertex(topology.vertex_corners(v)[0]);
  const auto around = mesh.topology().vertex_edges(mesh_vertex);
  const Positions in_around(around);
  for (const Index e : around) ring.around.push_back(mesh.sharpness_beside(level, e, mesh_vertex));
  for (const Index e : topology.vertex_edges(v)) {
    const Index in_mesh = mesh.topology().half_edge_edge(topology.edge_half_edges(e)[0]);
    ring.in_mesh.push_back(in_around(in_mesh));
    ring.far_child.push_back(net_.sharpness_far(level, e, v));
  }
  return ring;
}

template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::limit_by_ring(Index level, const Real* values, const Evaluated<Real>& out,
                                               Index v, bool frames_only) const {
  const LimitRing<Scheme, Real> limit(scheme_, net_.crease_method(), ring(level, values, v));
  if (out.limits != nullptr && !frames_only)
    std::ranges::copy(limit.position(), out.limits + Count{v} * width_);
  if (out.wants_frames()) write_frames<Real>(limit.frames(), out, v);
}

template <class Scheme, class Real>
void BaseVertices<Scheme, Real>::limit(Index level, const Real* values, const Evaluated<Real>& out,
                                       Index begin, Index end) const {
  if (linear_) {
    if (out.limits != nullptr)
      std::copy(values + Count{begin} * width_, values + Count{end} * width_,
                out.limits + Count{begin} * width_);
    return;
  }
  const Count n = segments(level);
  const auto unsettled = net_.unsettled_vertices(level);
  auto next = std::ranges::lower_bound(unsettled, begin);
  for (Index v = begin; v < end; ++v) {
    const bool settled = next == unsettled.end() || *next != v;
    if (!settled) ++next;
    const VertexRule rule = net_.vertex_rules()[v];
    if (!settled || rule == VertexRule::dart) {
      limit_by_ring(level, values, out, v, false);
      continue;
    }
    if (out.limits != nullptr) {
      if (width_ == 3)
        limit_settled(n, values, v, out.limits + Count{v} * 3, std::integral_constant<Index, 3>{});
      else
        limit_settled(n, values, v, out.limits + Count{v} * width_, width_);
    }
    if (!out.wants_frames()) continue;
    Frame<Real> frame;
    if (rule == VertexRule::smooth) smooth_frame(n, values, v, frame);
    if (rule == VertexRule::smooth && set_normal(frame))
      write_frames<Real>({&frame, 1}, out, v);
    else
      limit_by_ring(level, values, out, v, true);
  }
}

template class BaseVertices<Loop, float>;
template class BaseVertices<Loop, double>;
template void write_frames<float>(std::span<const Frame<float>>, const Evaluated<float>&, Count);
template void write_frames<double>(std::span<const Frame<double>>, const Evaluated<double>&, Count);

}  // namespace subdivd

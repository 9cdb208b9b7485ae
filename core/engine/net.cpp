#include "core/engine/net.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "core/mesh/scan.h"

namespace subdivd {
namespace {

// Position of `item` in an ascending list; its size when it is not there.
std::size_t position(const std::vector<Index>& list, Index item) {
  const auto at = std::ranges::lower_bound(list, item);
  return at != list.end() && *at == item ? static_cast<std::size_t>(at - list.begin()) : list.size();
}

}  // namespace

float SemiSharp::vertex(Index v) const {
  const std::size_t at = position(vertices, v);
  return at == vertices.size() ? 0.0f : vertex_sharpness[at];
}

template <class Faces>
Net<Faces> Net<Faces>::build(const AnyGridScheme& scheme, CreaseMethod method,
                             std::shared_ptr<const Topology<Faces>> topology, Sharpness&& sharpness,
                             Index max_level, const Pace& pace) {
  Net net;
  net.scheme_ = scheme;
  net.method_ = method;
  net.max_level_ = max_level;
  net.topology_ = std::move(topology);
  net.sharpness_ = std::move(sharpness);
  net.set_rules(false, pace);
  net.decay_all(pace);
  net.list_unsettled(pace);
  return net;
}

template <class Faces>
Net<Faces> Net<Faces>::build(std::shared_ptr<const Net> of_mesh, Channel<Faces> channel, const Pace& pace) {
  Net net;
  net.mesh_ = std::move(of_mesh);
  const Net& mesh = *net.mesh_;
  net.scheme_ = mesh.scheme_;
  net.method_ = mesh.method_;
  net.max_level_ = mesh.max_level_;
  net.linear_ = channel.linear;
  net.topology_ = std::move(channel.topology);
  net.sharpness_ = std::move(channel.sharpness);
  net.value_indices_ = std::move(channel.values);
  net.set_rules(channel.linear_borders, pace);
  if (net.linear_) return net;

  // Edges decay as the mesh's: under Chaikin's rule a seam hides edges that take part. Vertices decay alone.
  struct Pair {
    std::size_t in_mesh;
    bool reversed;
  };
  std::vector<Pair> pairs;
  SemiSharp base;
  const auto side = [](const Topology<Faces>& topology, Index h) {
    return topology.edge_vertices(topology.half_edge_edge(h))[0] == topology.corner_vertex(h);
  };
  base.edges = std::move(net.semi_sharp_edges_);
  for (const Index e : base.edges) {
    pace.spend(16);
    const Index h = net.topology_->edge_half_edges(e)[0];
    pairs.push_back({position(mesh.semi_sharp(0).edges, mesh.topology_->half_edge_edge(h)),
                     side(*net.topology_, h) != side(*mesh.topology_, h)});
  }
  net.list_semi_sharp_vertices(base, pace);
  for (Index level = 0; level <= net.max_level_ + 1; ++level) {
    const SemiSharp& from = mesh.semi_sharp(level);
    SemiSharp to;
    to.per_edge = from.per_edge;
    for (std::size_t k = 0; k < base.edges.size(); ++k) {
      pace.spend(16 + from.per_edge);
      const Index mesh_edge = mesh.semi_sharp(0).edges[pairs[k].in_mesh];
      const std::size_t at = position(from.edges, mesh_edge);
      if (at == from.edges.size()) continue;  // it has run out
      to.edges.push_back(base.edges[k]);
      for (Count s = 0; s < from.per_edge; ++s)
        to.segments.push_back(from.segment(at, pairs[k].reversed ? from.per_edge - 1 - s : s));
    }
    pace.for_each(base.vertices.size(), [&](std::size_t k) {
      if (!is_sharp(base.vertex_sharpness[k])) return;
      to.vertices.push_back(base.vertices[k]);
      to.vertex_sharpness.push_back(base.vertex_sharpness[k]);
      base.vertex_sharpness[k] = decay(base.vertex_sharpness[k]);
    });
    if (to.empty()) break;
    net.levels_.push_back(std::move(to));
  }
  net.list_unsettled(pace);
  return net;
}

template <class Faces>
Count Net<Faces>::resident_bytes() const {
  const Count corners = topology_->corner_vertices().size(), edges = topology_->edge_count(),
              vertices = topology_->vertex_count();
  return 2048 + 14 * corners + 32 * edges + 24 * vertices;
}

template <class Faces>
Count Net<Faces>::building_bytes() const {
  return topology_building_bytes(topology_->vertex_count(), topology_->corner_vertices().size());
}

template <class Faces>
const SemiSharp& Net<Faces>::semi_sharp(Index level) const {
  static const SemiSharp none;
  return level < levels_.size() ? levels_[level] : none;
}

template <class Faces>
std::span<const Index> Net<Faces>::unsettled_vertices(Index level) const {
  return level < unsettled_.size() ? std::span<const Index>(unsettled_[level]) : std::span<const Index>();
}

template <class Faces>
float Net<Faces>::segment_sharpness(Index level, Index e, Count from_low) const {
  if (is_infinite(sharpness_.edges[e])) return kInfiniteSharpness;
  if (!is_sharp(sharpness_.edges[e])) return 0;
  const SemiSharp& semi = semi_sharp(level);
  const std::size_t at = position(semi.edges, e);
  return at == semi.edges.size() ? 0 : semi.segment(at, from_low);
}

template <class Faces>
float Net<Faces>::sharpness_beside(Index level, Index e, Index v) const {
  return segment_sharpness(level, e, topology_->edge_vertices(e)[0] == v ? 0 : segments(level) - 1);
}

template <class Faces>
float Net<Faces>::sharpness_far(Index level, Index e, Index v) const {
  return segment_sharpness(level + 1, e, topology_->edge_vertices(e)[0] == v ? 1 : segments(level + 1) - 2);
}

template <class Faces>
void Net<Faces>::set_rules(bool linear_borders, const Pace& pace) {
  pace.fill(vertex_rules_, topology_->vertex_count(), linear_ ? VertexRule::corner : VertexRule::smooth);
  pace.fill(edge_rules_, topology_->edge_count(), linear_ ? EdgeRule::linear : EdgeRule::smooth);
  if (linear_) return;
  // Infinitely sharp edges turn a smooth vertex into a dart, a crease, a corner.
  for_each_set(
      std::span(std::as_const(sharpness_.edges)),
      [&](std::size_t k) {
        const auto e = static_cast<Index>(k);
        if (!is_infinite(sharpness_.edges[e])) {
          semi_sharp_edges_.push_back(e);
          return;
        }
        edge_rules_[e] = linear_borders && topology_->is_boundary(e) ? EdgeRule::linear : EdgeRule::crease;
        for (const Index v : topology_->edge_vertices(e))
          vertex_rules_[v] = static_cast<VertexRule>(
              std::min(static_cast<int>(vertex_rules_[v]) + 1, static_cast<int>(VertexRule::corner)));
      },
      pace);
  for_each_set(
      std::span(std::as_const(sharpness_.vertices)),
      [&](std::size_t v) {
        if (is_infinite(sharpness_.vertices[v])) vertex_rules_[v] = VertexRule::corner;
      },
      pace);
  list_vertices(pace);
}

template <class Faces>
void Net<Faces>::list_vertices(const Pace& pace) {
  std::array<bool, kListedValence + 1> present{};
  pace.for_each(topology_->vertex_count(), [&](Index v) {
    const std::size_t valence = topology_->vertex_corners(v).size();
    if (valence == 0) vertex_rules_[v] = VertexRule::corner;
    if (vertex_rules_[v] <= VertexRule::dart && valence <= kListedValence)
      present[valence] = true;
    else
      special_vertices_.push_back(v);
    if (vertex_rules_[v] == VertexRule::dart) darts_.push_back(v);
  });
  for (Index n = 0; n <= kListedValence; ++n)
    if (present[n]) valences_.push_back(n);
}

template <class Faces>
void Net<Faces>::list_semi_sharp_vertices(SemiSharp& base, const Pace& pace) const {
  for_each_set(
      std::span(sharpness_.vertices),
      [&](std::size_t v) {
        if (!is_semi_sharp(sharpness_.vertices[v])) return;
        base.vertices.push_back(static_cast<Index>(v));
        base.vertex_sharpness.push_back(sharpness_.vertices[v]);
      },
      pace);
}

template <class Faces>
void Net<Faces>::decay_all(const Pace& pace) {
  SemiSharp base;
  base.edges = std::move(semi_sharp_edges_);
  base.segments.reserve(base.edges.size());
  pace.for_each(base.edges.size(),
                [&](std::size_t k) { base.segments.push_back(sharpness_.edges[base.edges[k]]); });
  list_semi_sharp_vertices(base, pace);
  while (!base.empty() && levels_.size() <= max_level_ + 1) {
    levels_.push_back(std::move(base));
    base = decayed(levels_.back(), static_cast<Index>(levels_.size() - 1), pace);
  }
}

// One level on.
template <class Faces>
SemiSharp Net<Faces>::decayed(const SemiSharp& level, Index index, const Pace& pace) const {
  SemiSharp next;
  pace.for_each(level.vertices.size(), [&](std::size_t k) {
    const float s = decay(level.vertex_sharpness[k]);
    if (!is_sharp(s)) return;
    next.vertices.push_back(level.vertices[k]);
    next.vertex_sharpness.push_back(s);
  });
  if (method_ == CreaseMethod::uniform) {
    pace.for_each(level.edges.size(), [&](std::size_t k) {
      const float s = decay(level.segments[k]);
      if (!is_sharp(s)) return;
      next.edges.push_back(level.edges[k]);
      next.segments.push_back(s);
    });
    return next;
  }
  const Count n = segments(index);
  next.per_edge = 2 * n;
  pace.copy(level.edges, next.edges);
  pace.fill(next.segments, next.edges.size() * next.per_edge, 0.0f);
  for (std::size_t k = 0; k < level.edges.size(); ++k) {
    pace.spend(n);
    for (Count i = 1; i < n; ++i) {
      const std::array<float, 2> parent{level.segment(k, i - 1), level.segment(k, i)};
      std::array<float, 2> child{};
      decay_around_vertex(method_, parent, child);
      next.segments[k * next.per_edge + 2 * i - 1] = child[0];
      next.segments[k * next.per_edge + 2 * i] = child[1];
    }
  }
  decay_ends(level, index, next, pace);
  // Leave out the edges that have run out altogether.
  std::size_t kept = 0;
  for (std::size_t k = 0; k < next.edges.size(); ++k) {
    pace.spend(next.per_edge);
    const auto first = next.segments.begin() + static_cast<std::ptrdiff_t>(k * next.per_edge);
    const auto last = first + static_cast<std::ptrdiff_t>(next.per_edge);
    if (std::none_of(first, last, is_sharp)) continue;
    std::copy(first, last, next.segments.begin() + static_cast<std::ptrdiff_t>(kept * next.per_edge));
    next.edges[kept++] = next.edges[k];
  }
  next.edges.resize(kept);
  next.segments.resize(kept * next.per_edge);
  return next;
}

// The halves next to base vertices, around which all edges decay together.
template <class Faces>
void Net<Faces>::decay_ends(const SemiSharp& from, Index level, SemiSharp& to, const Pace& pace) const {
  std::vector<float> parent, child;
  for (const Index v : with_ends({}, from.edges, pace)) {
    const auto edges = topology_->vertex_edges(v);
    parent.clear();
    for (const Index e : edges) {
      pace.spend(16);
      parent.push_back(sharpness_beside(level, e, v));
    }
    child.resize(parent.size());
    decay_around_vertex(method_, parent, child, pace);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      pace.spend(16);
      if (const std::size_t at = position(to.edges, edges[k]); at != to.edges.size())
        to.segments[at * to.per_edge + (topology_->edge_vertices(edges[k])[0] == v ? 0 : to.per_edge - 1)] =
            child[k];
    }
  }
}

// The vertices and the ends of the edges, ascending, each once.
template <class Faces>
std::vector<Index> Net<Faces>::with_ends(std::span<const Index> vertices, std::span<const Index> edges,
                                         const Pace& pace) const {
  std::vector<Index> list;
  list.reserve(vertices.size() + 2 * edges.size());
  pace.for_each(vertices.size(), [&](std::size_t k) { list.push_back(vertices[k]); });
  pace.for_each(edges.size(), [&](std::size_t k) {
    for (const Index v : topology_->edge_vertices(edges[k])) list.push_back(v);
  });
  pace.sort(list.begin(), list.end(), std::less<>());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

template <class Faces>
void Net<Faces>::list_unsettled(const Pace& pace) {
  for (const SemiSharp& level : levels_) unsettled_.push_back(with_ends(level.vertices, level.edges, pace));
}

template class Net<Triangles>;
template class Net<Quads>;

}  // namespace subdivd

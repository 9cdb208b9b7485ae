#include "tests/reference/plain.h"

#include <algorithm>
#include <array>

#include "core/lattice/numbering.h"
#include "core/schemes/loop.h"

namespace subdivd::plain {
namespace {

std::vector<std::array<float, 2>> decayed_halves(const Level& level, CreaseMethod method) {
  std::vector<std::array<float, 2>> halves(level.topology.edge_count());
  std::vector<float> parent, child;
  for (Index v = 0; v < level.topology.vertex_count(); ++v) {
    const auto edges = level.topology.vertex_edges(v);
    parent.clear();
    for (Index e : edges) parent.push_back(level.sharpness.edges[e]);
    child.resize(parent.size());
    decay_around_vertex(method, parent, child);
    for (std::size_t k = 0; k < edges.size(); ++k)
      halves[edges[k]][level.topology.edge_vertices(edges[k])[0] == v ? 0 : 1] = child[k];
  }
  return halves;
}

// Face f = (v0, v1, v2) with edge points e0, e1, e2 becomes (v0 e0 e2) (e0 v1 e1) (e2 e1 v2) (e0 e1 e2). Edge
// e of the parent becomes 2 e (next to its lower-numbered end) and 2 e + 1; inside face f, across its corner
// k, lies edge 2 E + 3 f + k.
Topology child_topology(const Topology& parent) {
  const Index vertices = parent.vertex_count(), inside = 2 * parent.edge_count();
  std::vector<Index> triangles;
  Buffer<Index> half_edge_edges;
  triangles.reserve(parent.triangles().size() * 4);
  half_edge_edges.reserve(parent.triangles().size() * 4);
  Buffer<std::array<Index, 2>> edge_vertices(inside + parent.triangles().size());
  for (Index e = 0; e < parent.edge_count(); ++e)
    for (Index end : {0, 1}) edge_vertices[2 * e + end] = {parent.edge_vertices(e)[end], vertices + e};
  for (Index f = 0; f < parent.face_count(); ++f) {
    Index v[3], e[3], out[3], in[3], across[3];  // out, in: halves of the edges that leave and enter corner k
    for (Index k = 0; k < 3; ++k) {
      const Index h = 3 * f + k, edge = parent.half_edge_edge(h),
                  before = parent.half_edge_edge(Topology::prev(h));
      v[k] = parent.corner_vertex(h);
      e[k] = vertices + edge;
      out[k] = 2 * edge + (parent.edge_vertices(edge)[0] == v[k] ? 0 : 1);
      in[k] = 2 * before + (parent.edge_vertices(before)[0] == v[k] ? 0 : 1);
      across[k] = inside + h;
      edge_vertices[across[k]] = {std::min(vertices + edge, vertices + before),
                                  std::max(vertices + edge, vertices + before)};
    }
    triangles.insert(triangles.end(),
                     {v[0], e[0], e[2], e[0], v[1], e[1], e[2], e[1], v[2], e[0], e[1], e[2]});
    half_edge_edges.insert(half_edge_edges.end(),
                           {out[0], across[0], in[0], in[1], out[1], across[1], across[2], in[2], out[2],
                            across[1], across[2], across[0]});
  }
  return Topology(vertices + parent.edge_count(), std::move(triangles), std::move(half_edge_edges),
                  std::move(edge_vertices));
}

std::vector<GridPoint> child_corners(const std::vector<GridPoint>& corners) {
  std::vector<GridPoint> children;
  children.reserve(corners.size() * 4);
  auto sum = [](GridPoint a, GridPoint b) { return GridPoint{a.i + b.i, a.j + b.j}; };
  for (std::size_t f = 0; f < corners.size(); f += 3) {
    const GridPoint c[3] = {corners[f], corners[f + 1], corners[f + 2]};
    const GridPoint v[3] = {sum(c[0], c[0]), sum(c[1], c[1]), sum(c[2], c[2])};
    const GridPoint e[3] = {sum(c[0], c[1]), sum(c[1], c[2]), sum(c[2], c[0])};
    children.insert(children.end(), {v[0], e[0], e[2], e[0], v[1], e[1], e[2], e[1], v[2], e[0], e[1], e[2]});
  }
  return children;
}

// Of a channel from the mesh over the same faces; borders and what else is infinite stay so.
std::vector<std::array<float, 2>> inherited_halves(const Level& channel, const Level& mesh) {
  const Topology& own = channel.topology;
  std::vector<std::array<float, 2>> halves(own.edge_count());
  auto side = [](const Topology& topology, Index h) {
    return topology.edge_vertices(topology.half_edge_edge(h))[0] == topology.corner_vertex(h) ? 0u : 1u;
  };
  for (Index h = 0; h < own.triangles().size(); ++h) {
    const Index e = own.half_edge_edge(h);
    const auto& from = mesh.halves[mesh.topology.half_edge_edge(h)];
    const unsigned own_side = side(own, h), mesh_side = side(mesh.topology, h);
    halves[e][own_side] = from[mesh_side];
    halves[e][1 - own_side] = from[1 - mesh_side];
    if (is_infinite(channel.sharpness.edges[e])) halves[e] = {kInfiniteSharpness, kInfiniteSharpness};
  }
  return halves;
}

// The next level but for its halves.
Result<Level> split(const Level& level, const Budget& budget) {
  if (auto stop = budget.poll()) return *stop;
  const Topology& parent = level.topology;
  const Index vertices = parent.vertex_count();
  Level next{child_topology(parent),      {}, {}, level.linear, level.linear_borders,
             child_corners(level.corners)};
  if (auto stop = budget.poll()) return *stop;
  next.sharpness.edges.assign(next.topology.edge_count(), 0.0f);  // edges inside faces are smooth
  for (Index e = 0; e < parent.edge_count(); ++e)
    for (Index half : {0, 1}) next.sharpness.edges[2 * e + half] = level.halves[e][half];
  next.sharpness.vertices.assign(next.topology.vertex_count(), 0.0f);
  for (Index v = 0; v < vertices; ++v) next.sharpness.vertices[v] = decay(level.sharpness.vertices[v]);
  if (level.linear_borders)
    for (Index e = 0; e < parent.edge_count(); ++e)
      if (parent.is_boundary(e)) next.sharpness.vertices[vertices + e] = kInfiniteSharpness;
  return next;
}

}  // namespace

Level first_level(Topology topology, Sharpness sharpness, CreaseMethod method) {
  Level level{std::move(topology), std::move(sharpness), {}, false, false, {}};
  level.halves = decayed_halves(level, method);
  for (Index f = 0; f < level.topology.face_count(); ++f)
    level.corners.insert(level.corners.end(), {GridPoint{0, 0}, GridPoint{1, 0}, GridPoint{0, 1}});
  return level;
}

Level first_level(const Channel& channel, const Level& mesh) {
  Level level{*channel.topology, channel.sharpness, {}, channel.linear, channel.linear_borders, mesh.corners};
  level.halves = inherited_halves(level, mesh);
  return level;
}

Result<Level> next_level(const Level& level, CreaseMethod method, const Budget& budget) {
  Result<Level> next = split(level, budget);
  if (next) next->halves = decayed_halves(*next, method);
  return next;
}

Result<Level> next_level(const Level& channel, const Level& next_mesh, const Budget& budget) {
  Result<Level> next = split(channel, budget);
  if (next) next->halves = inherited_halves(*next, next_mesh);
  return next;
}

// One vertex or edge at a time; polled often enough that 50 ms are never exceeded between two polls.
constexpr Index kPollMask = 0xffff;

template <class Scheme, class Real>
Result<std::vector<Real>> refine_values(const Scheme& scheme, CreaseMethod method, const Level& level,
                                        std::span<const Real> values, Index width, bool linear,
                                        const Budget& budget) {
  const Topology& topology = level.topology;
  std::vector<Real> next((std::size_t{topology.vertex_count()} + topology.edge_count()) * width);
  auto add = [&](Real* out, double weight, Index v) {
    for (Index c = 0; c < width; ++c)
      out[c] += static_cast<Real>(weight) * values[std::size_t{v} * width + c];
  };
  linear |= level.linear;

  std::vector<float> sharpness, child_sharpness;
  for (Index v = 0; v < topology.vertex_count(); ++v) {
    if ((v & kPollMask) == 0)
      if (auto stop = budget.poll()) return *stop;
    const auto edges = topology.vertex_edges(v);
    sharpness.clear();
    child_sharpness.clear();
    for (Index e : edges) {
      sharpness.push_back(level.sharpness.edges[e]);
      child_sharpness.push_back(level.halves[e][topology.edge_vertices(e)[0] == v ? 0 : 1]);
    }
    const float own = level.sharpness.vertices[v];
    VertexMask mask;  // v stays
    if (!linear)
      mask = scheme.vertex_mask({static_cast<Index>(topology.vertex_corners(v).size()), method, own,
                                 decay(own), sharpness, child_sharpness});
    Real* out = next.data() + std::size_t{v} * width;
    if (mask.each != 0)
      for (Index e : edges) add(out, mask.each, topology.other_end(e, v));
    if (mask.crease != 0)
      for (Index end : mask.crease_ends) add(out, mask.crease, topology.other_end(edges[end], v));
    add(out, mask.self, v);
  }

  for (Index e = 0; e < topology.edge_count(); ++e) {
    if ((e & kPollMask) == 0)
      if (auto stop = budget.poll()) return *stop;
    const auto faces = topology.edge_half_edges(e);
    EdgeMask mask;  // the midpoint
    if (!linear)
      mask = scheme.edge_mask({static_cast<Index>(faces.size()),
                               level.sharpness.edges[e],
                               {level.halves[e][0], level.halves[e][1]}});
    Real* out = next.data() + (std::size_t{topology.vertex_count()} + e) * width;
    if (mask.opposite != 0)
      for (Index h : faces) add(out, mask.opposite, topology.corner_vertex(Topology::prev(h)));
    for (Index v : topology.edge_vertices(e)) add(out, mask.end, v);
  }
  return next;
}

std::vector<Index> closed_form_numbers(const Topology& base, Index depth, const Level& level) {
  const Numbering numbering(base, depth);
  std::vector<Index> numbers(level.topology.vertex_count());
  for (Index v = 0; v < base.vertex_count(); ++v) numbers[v] = v;
  for (Index h = 0; h < level.corners.size(); ++h) {
    const Index face = (h / 3) >> (2 * depth);
    numbers[level.topology.corner_vertex(h)] = numbering.vertex(face, level.corners[h].i, level.corners[h].j);
  }
  return numbers;
}

template Result<std::vector<float>> refine_values(const Loop&, CreaseMethod, const Level&,
                                                  std::span<const float>, Index, bool, const Budget&);
template Result<std::vector<double>> refine_values(const Loop&, CreaseMethod, const Level&,
                                                   std::span<const double>, Index, bool, const Budget&);

}  // namespace subdivd::plain

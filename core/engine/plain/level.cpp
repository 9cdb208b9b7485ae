#include "core/engine/plain/level.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace subdivd::plain {
namespace {

// Which of its halves edge e has at v.
Index half_at(const Adjacency& faces, Index e, Index v) { return faces.edge_vertices(e)[0] == v ? 0 : 1; }

std::vector<std::array<float, 2>> decayed_halves(const Level& level, CreaseMethod method, const Pace& pace) {
  std::vector<std::array<float, 2>> halves(level.faces.edge_count());
  std::vector<float> parent, child;
  pace.for_each(level.faces.vertex_count(), [&](Index v) {
    const auto edges = level.faces.vertex_edges(v);
    pace.spend(edges.size());
    parent.clear();
    for (const Index e : edges) parent.push_back(level.sharpness.edges[e]);
    child.resize(parent.size());
    decay_around_vertex(method, parent, child, pace);
    for (std::size_t k = 0; k < edges.size(); ++k)
      halves[edges[k]][half_at(level.faces, edges[k], v)] = child[k];
  });
  return halves;
}

// Of a channel from the mesh over the same faces; borders and what else is infinite stay so.
std::vector<std::array<float, 2>> inherited_halves(const Level& channel, const Level& mesh,
                                                   const Pace& pace) {
  std::vector<std::array<float, 2>> halves(channel.faces.edge_count());
  const auto lower_half = [](const Adjacency& faces, Index h) {
    return half_at(faces, faces.half_edge_edge(h), faces.corner_vertex(h));
  };
  pace.for_each(channel.faces.half_edge_count(), [&](Index h) {
    const Index e = channel.faces.half_edge_edge(h);
    const auto& from = mesh.halves[mesh.faces.half_edge_edge(h)];
    const Index own = lower_half(channel.faces, h), theirs = lower_half(mesh.faces, h);
    halves[e][own] = from[theirs];
    halves[e][1 - own] = from[1 - theirs];
    if (is_infinite(channel.sharpness.edges[e])) halves[e] = {kInfiniteSharpness, kInfiniteSharpness};
  });
  return halves;
}

// Face f = (v0, v1, v2) with edge points e0, e1, e2 becomes (v0 e0 e2) (e0 v1 e1) (e2 e1 v2) (e0 e1 e2).
Adjacency split_triangles(const Adjacency& parent, const Pace& pace) {
  const Index vertices = parent.vertex_count(), inside = 2 * parent.edge_count();
  const Count corner_count = Count{4} * parent.half_edge_count();
  std::vector<Index> offsets, corners, edges;
  std::vector<std::array<Index, 2>> ends;
  pace.fill(offsets, corner_count / 3 + 1, Index{0});
  pace.for_each(offsets.size(), [&](Count f) { offsets[f] = static_cast<Index>(3 * f); });
  corners.reserve(corner_count);
  edges.reserve(corner_count);
  pace.fill(ends, Count{inside} + parent.half_edge_count(), {});
  pace.for_each(parent.edge_count(), [&](Index e) {
    for (const Index end : {0u, 1u}) ends[2 * e + end] = {parent.edge_vertices(e)[end], vertices + e};
  });
  pace.for_each(parent.face_count(), [&](Index f) {
    assert(parent.face_size(f) == 3);
    pace.spend(24);
    Index v[3], e[3], out[3], in[3], across[3];  // out, in: halves of the edges that leave and enter corner k
    for (Index k = 0; k < 3; ++k) {
      const Index h = parent.face_begin(f) + k, edge = parent.half_edge_edge(h),
                  before = parent.half_edge_edge(parent.prev(h));
      v[k] = parent.corner_vertex(h);
      e[k] = vertices + edge;
      out[k] = 2 * edge + half_at(parent, edge, v[k]);
      in[k] = 2 * before + half_at(parent, before, v[k]);
      across[k] = inside + h;
      ends[across[k]] = {vertices + std::min(edge, before), vertices + std::max(edge, before)};
    }
    corners.insert(corners.end(), {v[0], e[0], e[2], e[0], v[1], e[1], e[2], e[1], v[2], e[0], e[1], e[2]});
    edges.insert(edges.end(), {out[0], across[0], in[0], in[1], out[1], across[1], across[2], in[2], out[2],
                               across[1], across[2], across[0]});
  });
  return Adjacency(vertices + parent.edge_count(), Polygons(std::move(offsets), std::move(corners), pace),
                   std::move(edges), std::move(ends), pace);
}

// The next level but for its halves.
Level split(const Level& level, const Pace& pace) {
  const Adjacency& parent = level.faces;
  Level next{split_triangles(parent, pace), {}, {}, level.linear, level.linear_borders};
  pace.fill(next.sharpness.edges, next.faces.edge_count(), 0.0f);  // edges inside faces are smooth
  pace.fill(next.sharpness.vertices, next.faces.vertex_count(), 0.0f);
  pace.for_each(parent.edge_count(), [&](Index e) {
    for (const Index half : {0u, 1u}) next.sharpness.edges[2 * e + half] = level.halves[e][half];
    if (level.linear_borders && parent.edge_half_edges(e).size() == 1)
      next.sharpness.vertices[parent.vertex_count() + e] = kInfiniteSharpness;
  });
  pace.for_each(parent.vertex_count(),
                [&](Index v) { next.sharpness.vertices[v] = decay(level.sharpness.vertices[v]); });
  return next;
}

// The masks of one level, written as rows.
template <class Scheme>
class Rows {
 public:
  Rows(const Scheme& scheme, CreaseMethod method, const Level& level, bool linear, const Pace& pace)
      : scheme_(scheme), method_(method), level_(level), linear_(linear || level.linear), pace_(pace) {}

  SparseRows run() {
    pace_.for_each(level_.faces.vertex_count(), [&](Index v) { add_vertex_point(v); });
    pace_.for_each(level_.faces.edge_count(), [&](Index e) { add_edge_point(e); });
    return std::move(rows_);
  }

 private:
  VertexMask vertex_mask(Index v) {
    if (linear_) return {};  // v stays
    sharpness_.clear();
    child_sharpness_.clear();
    for (const Index e : level_.faces.vertex_edges(v)) {
      sharpness_.push_back(level_.sharpness.edges[e]);
      child_sharpness_.push_back(level_.halves[e][half_at(level_.faces, e, v)]);
    }
    const float own = level_.sharpness.vertices[v];
    return scheme_.vertex_mask({static_cast<Index>(level_.faces.vertex_corners(v).size()), method_, own,
                                decay(own), sharpness_, child_sharpness_});
  }

  void add_vertex_point(Index v) {
    const auto edges = level_.faces.vertex_edges(v);
    pace_.spend(edges.size());
    const VertexMask mask = vertex_mask(v);
    if (mask.each != 0)
      for (const Index e : edges) rows_.add(level_.faces.other_end(e, v), mask.each);
    if (mask.crease != 0)
      for (const Index end : mask.crease_ends) rows_.add(level_.faces.other_end(edges[end], v), mask.crease);
    rows_.add(v, mask.self);
    rows_.end_row();
  }

  void add_edge_point(Index e) {
    const auto along = level_.faces.edge_half_edges(e);
    pace_.spend(along.size());
    EdgeMask mask;  // the midpoint
    if (!linear_)
      mask = scheme_.edge_mask({static_cast<Index>(along.size()),
                                level_.sharpness.edges[e],
                                {level_.halves[e][0], level_.halves[e][1]}});
    if (mask.opposite != 0)
      for (const Index h : along) rows_.add(level_.faces.corner_vertex(level_.faces.prev(h)), mask.opposite);
    for (const Index v : level_.faces.edge_vertices(e)) rows_.add(v, mask.end);
    rows_.end_row();
  }

  const Scheme& scheme_;
  CreaseMethod method_;
  const Level& level_;
  bool linear_;
  const Pace& pace_;
  SparseRows rows_;
  std::vector<float> sharpness_, child_sharpness_;
};

}  // namespace

Level first_level(Adjacency faces, Sharpness sharpness, CreaseMethod method, const Pace& pace) {
  Level level{std::move(faces), std::move(sharpness), {}, false, false};
  level.halves = decayed_halves(level, method, pace);
  return level;
}

Level first_level(Adjacency faces, Sharpness sharpness, bool linear, bool linear_borders, const Level& mesh,
                  const Pace& pace) {
  Level level{std::move(faces), std::move(sharpness), {}, linear, linear_borders};
  level.halves = inherited_halves(level, mesh, pace);
  return level;
}

Level next_level(const Level& level, CreaseMethod method, const Pace& pace) {
  Level next = split(level, pace);
  next.halves = decayed_halves(next, method, pace);
  return next;
}

Level next_level(const Level& channel, const Level& next_mesh, const Pace& pace) {
  Level next = split(channel, pace);
  next.halves = inherited_halves(next, next_mesh, pace);
  return next;
}

SparseRows rows_of(const AnyScheme& scheme, CreaseMethod method, const Level& level, bool linear,
                   const Pace& pace) {
  return std::visit(
      [&](const auto& one) {
        static_assert(std::remove_cvref_t<decltype(one)>::split == Split::triangles);
        return Rows(one, method, level, linear, pace).run();
      },
      scheme);
}

}  // namespace subdivd::plain

#include "core/engine/plain/split.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>
#include <vector>

namespace subdivd::plain {
namespace {

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

// Face f = (v0, v1, ...) with edge points e0, e1, ... and its own point becomes (v0 e0 f e_last) (v1 e1 f e0) ...
Adjacency split_quads(const Adjacency& parent, const Pace& pace) {
  const Index vertices = parent.vertex_count(), half_edges = parent.half_edge_count(),
              face_points = vertices + parent.edge_count(), inside = 2 * parent.edge_count();
  std::vector<Index> offsets, corners, edges;
  std::vector<std::array<Index, 2>> ends;
  pace.fill(offsets, Count{half_edges} + 1, Index{0});
  pace.for_each(offsets.size(), [&](Count f) { offsets[f] = static_cast<Index>(4 * f); });
  corners.reserve(Count{4} * half_edges);
  edges.reserve(Count{4} * half_edges);
  pace.fill(ends, Count{inside} + half_edges, {});
  pace.for_each(parent.edge_count(), [&](Index e) {
    for (const Index end : {0u, 1u}) ends[2 * e + end] = {parent.edge_vertices(e)[end], vertices + e};
  });
  pace.for_each(half_edges, [&](Index h) {
    pace.spend(8);
    const Index before = parent.prev(h), v = parent.corner_vertex(h), edge = parent.half_edge_edge(h),
                edge_before = parent.half_edge_edge(before), face = face_points + parent.face_of(h);
    corners.insert(corners.end(), {v, vertices + edge, face, vertices + edge_before});
    edges.insert(edges.end(), {2 * edge + half_at(parent, edge, v), inside + h, inside + before,
                               2 * edge_before + half_at(parent, edge_before, v)});
    ends[inside + h] = {vertices + edge, face};
  });
  return Adjacency(face_points + parent.face_count(), Polygons(std::move(offsets), std::move(corners), pace),
                   std::move(edges), std::move(ends), pace);
}

}  // namespace

Adjacency split_faces(Split split, const Adjacency& parent, const Pace& pace) {
  assert(split == Split::triangles || split == Split::quads);
  return split == Split::triangles ? split_triangles(parent, pace) : split_quads(parent, pace);
}

Count child_count(Split split, const Adjacency& parent) {
  const Count points = Count{parent.vertex_count()} + parent.edge_count();
  return split == Split::triangles ? points : points + parent.face_count();
}

}  // namespace subdivd::plain

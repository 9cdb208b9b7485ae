#include "core/engine/plain/adjacency.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace subdivd::plain {
namespace {

// Numbers in rows by key: `of_key(k, add)` calls add(key) for each row that item k goes to. Rows ascend.
template <class OfKey>
void sort_into_rows(Index row_count, Index item_count, std::vector<Index>& items, std::vector<Index>& offsets,
                    const Pace& pace, OfKey&& of_key) {
  pace.fill(offsets, Count{row_count} + 1, Index{0});
  pace.for_each(item_count, [&](Index k) { of_key(k, [&](Index key) { ++offsets[key + 1]; }); });
  pace.for_each(row_count, [&](Index r) { offsets[r + 1] += offsets[r]; });
  std::vector<Index> at;
  pace.copy(offsets, at);
  pace.fill(items, offsets.back(), Index{0});
  pace.for_each(item_count, [&](Index k) { of_key(k, [&](Index key) { items[at[key]++] = k; }); });
}

}  // namespace

Adjacency::Adjacency(Index vertex_count, Polygons faces, const Pace& pace)
    : vertex_count_(vertex_count), faces_(std::move(faces)) {
  find_edges(pace);
  connect(pace);
}

Adjacency::Adjacency(Index vertex_count, Polygons faces, std::vector<Index> half_edge_edges,
                     std::vector<std::array<Index, 2>> edge_vertices, const Pace& pace)
    : vertex_count_(vertex_count),
      faces_(std::move(faces)),
      half_edge_edges_(std::move(half_edge_edges)),
      edge_vertices_(std::move(edge_vertices)) {
  connect(pace);
}

// Half-edges are sorted by their lower end; within a row, `first_to` holds for each other end the first
// half-edge that went there. It is not cleared between rows: what another row left is told by its lower end.
void Adjacency::find_edges(const Pace& pace) {
  const auto low = [&](Index h) { return std::min(corner_vertex(h), corner_vertex(next(h))); };
  const auto high = [&](Index h) { return std::max(corner_vertex(h), corner_vertex(next(h))); };
  std::vector<Index> by_low, offsets, first_to, first;
  sort_into_rows(vertex_count_, half_edge_count(), by_low, offsets, pace,
                 [&](Index h, auto&& add) { add(low(h)); });
  pace.fill(first_to, vertex_count_, kNoIndex);
  pace.fill(first, half_edge_count(), kNoIndex);
  pace.for_each(half_edge_count(), [&](Index k) {
    const Index h = by_low[k];
    Index& seen = first_to[high(h)];
    if (seen == kNoIndex || low(seen) != low(h)) seen = h;
    first[h] = seen;
  });
  pace.fill(half_edge_edges_, half_edge_count(), kNoIndex);
  pace.for_each(half_edge_count(), [&](Index h) {
    if (first[h] == h) {
      half_edge_edges_[h] = edge_count();
      edge_vertices_.push_back({low(h), high(h)});
    } else {
      half_edge_edges_[h] = half_edge_edges_[first[h]];
    }
  });
}

void Adjacency::connect(const Pace& pace) {
  sort_into_rows(edge_count(), half_edge_count(), edge_half_edges_, edge_offsets_, pace,
                 [&](Index h, auto&& add) { add(half_edge_edges_[h]); });
  sort_into_rows(vertex_count_, half_edge_count(), vertex_corners_, vertex_corner_offsets_, pace,
                 [&](Index h, auto&& add) { add(corner_vertex(h)); });
  sort_into_rows(vertex_count_, edge_count(), vertex_edges_, vertex_edge_offsets_, pace,
                 [&](Index e, auto&& add) {
                   add(edge_vertices_[e][0]);
                   add(edge_vertices_[e][1]);
                 });
  order_edges(pace);
}

Index Adjacency::mate(Index h) const {
  const auto along = edge_half_edges(half_edge_edges_[h]);
  if (along.size() != 2 || corner_vertex(along[0]) == corner_vertex(along[1])) return kNoIndex;
  return along[0] == h ? along[1] : along[0];
}

// The edges at v counter-clockwise; false when the faces there are not one fan.
bool Adjacency::order_fan(Index v, std::vector<Index>& edges, const Pace& pace) const {
  const auto corners = vertex_corners(v);
  const std::size_t edge_count = vertex_edges(v).size();
  for (const Index h : corners)
    for (const Index side : {h, prev(h)}) {
      pace.spend(4);
      const Index e = half_edge_edges_[side];
      if (edge_half_edges(e).size() != 1 && mate(side) == kNoIndex) return false;
    }
  Index start = corners[0];
  bool closed = false;
  for (Index across = mate(start); across != kNoIndex && !closed; across = mate(start)) {  // clockwise
    pace.spend(2);
    start = next(across);
    closed = start == corners[0];
  }
  edges.clear();
  Index h = start;
  do {
    pace.spend(2);
    edges.push_back(half_edge_edges_[h]);
    const Index last = prev(h);
    h = mate(last);
    if (h == kNoIndex) edges.push_back(half_edge_edges_[last]);
  } while (h != kNoIndex && h != start);
  return edges.size() == edge_count;
}

void Adjacency::order_edges(const Pace& pace) {
  std::vector<Index> edges;
  pace.for_each(vertex_count_, [&](Index v) {
    if (!vertex_corners(v).empty() && order_fan(v, edges, pace))
      std::ranges::copy(edges, vertex_edges_.begin() + vertex_edge_offsets_[v]);
  });
}

template <class Faces>
Adjacency adjacency_of(const Topology<Faces>& topology, const Pace& pace) {
  std::vector<Index> half_edge_edges;
  pace.copy(topology.half_edge_edges(), half_edge_edges);
  std::vector<std::array<Index, 2>> ends;
  pace.copy(topology.edge_vertices(), ends);
  Polygons polygons;
  if constexpr (std::is_same_v<Faces, Polygons>) {
    polygons = topology.faces();
  } else {
    std::vector<Index> begins, corners;
    begins.reserve(Count{topology.face_count()} + 1);
    pace.for_each(Count{topology.face_count()} + 1,
                  [&](Count f) { begins.push_back(static_cast<Index>(f * Faces::size)); });
    pace.copy(topology.corner_vertices(), corners);
    polygons = Polygons(std::move(begins), std::move(corners), pace);
  }
  return Adjacency(topology.vertex_count(), std::move(polygons), std::move(half_edge_edges), std::move(ends),
                   pace);
}

template Adjacency adjacency_of(const Topology<Triangles>&, const Pace&);
template Adjacency adjacency_of(const Topology<Quads>&, const Pace&);
template Adjacency adjacency_of(const Topology<Polygons>&, const Pace&);

}  // namespace subdivd::plain

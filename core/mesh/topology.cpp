#include "core/mesh/topology.h"

#include <numeric>

namespace subdivd {
namespace {

// Compressed rows: row k holds the items for which key(item) == k, in ascending order of items.
template <class Key>
void group(Count item_count, Index row_count, Key key, std::vector<Index>& items,
           std::vector<Count>& offsets) {
  offsets.assign(Count{row_count} + 1, 0);
  for (Count item = 0; item < item_count; ++item) ++offsets[Count{key(static_cast<Index>(item))} + 1];
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  items.resize(item_count);
  std::vector<Count> fill(offsets.begin(), offsets.end() - 1);
  for (Count item = 0; item < item_count; ++item)
    items[fill[key(static_cast<Index>(item))]++] = static_cast<Index>(item);
}

}  // namespace

Topology::Topology(Index vertex_count, std::vector<Index> triangles)
    : vertex_count_(vertex_count), triangles_(std::move(triangles)) {
  number_edges();
  connect();
}

Topology::Topology(Index vertex_count, std::vector<Index> triangles, std::vector<Index> half_edge_edges,
                   std::vector<std::array<Index, 2>> edge_vertices)
    : vertex_count_(vertex_count),
      triangles_(std::move(triangles)),
      half_edge_edges_(std::move(half_edge_edges)),
      edge_vertices_(std::move(edge_vertices)) {
  connect();
}

void Topology::connect() {
  const Count half_edges = triangles_.size();
  group(
      half_edges, edge_count(), [&](Index h) { return half_edge_edges_[h]; }, edge_half_edges_,
      edge_offsets_);
  group(
      half_edges, vertex_count_, [&](Index h) { return triangles_[h]; }, vertex_corners_,
      vertex_corner_offsets_);
  group(
      Count{2} * edge_count(), vertex_count_, [&](Index k) { return edge_vertices_[k / 2][k % 2]; },
      vertex_edges_, vertex_edge_offsets_);
  for (Index& item : vertex_edges_) item /= 2;
  find_non_manifold_vertices();
}

void Topology::number_edges() {
  const auto half_edges = static_cast<Index>(triangles_.size());
  auto low = [&](Index h) { return std::min(triangles_[h], triangles_[next(h)]); };
  auto high = [&](Index h) { return std::max(triangles_[h], triangles_[next(h)]); };
  // Half-edges with the same lower end stand together; sorting them by the higher end brings together those
  // of one edge, the first of which (lowest h) names the edge.
  std::vector<Index> by_low;
  std::vector<Count> offsets;
  group(half_edges, vertex_count_, low, by_low, offsets);
  std::vector<Index> first(half_edges);
  for (Index v = 0; v < vertex_count_; ++v) {
    const auto begin = by_low.begin() + static_cast<std::ptrdiff_t>(offsets[v]);
    const auto end = by_low.begin() + static_cast<std::ptrdiff_t>(offsets[v + 1]);
    std::stable_sort(begin, end, [&](Index a, Index b) { return high(a) < high(b); });
    for (auto it = begin; it != end; ++it)
      first[*it] = it != begin && high(*(it - 1)) == high(*it) ? first[*(it - 1)] : *it;
  }
  half_edge_edges_.resize(half_edges);
  for (Index h = 0; h < half_edges; ++h) {
    if (first[h] == h) {
      half_edge_edges_[h] = edge_count();
      edge_vertices_.push_back({low(h), high(h)});
    } else {
      half_edge_edges_[h] = half_edge_edges_[first[h]];
    }
  }
}

bool Topology::is_non_manifold_edge(Index e) const {
  const auto half_edges = edge_half_edges(e);
  return half_edges.size() > 2 ||
         (half_edges.size() == 2 && triangles_[half_edges[0]] == triangles_[half_edges[1]]);
}

Index Topology::mate(Index h) const {
  const auto half_edges = edge_half_edges(half_edge_edges_[h]);
  if (half_edges.size() != 2) return kNoIndex;
  const Index other = half_edges[0] == h ? half_edges[1] : half_edges[0];
  return triangles_[other] == triangles_[next(h)] ? other : kNoIndex;
}

void Topology::find_non_manifold_vertices() {
  non_manifold_vertices_.assign(vertex_count_, 0);
  for (Index e = 0; e < edge_count(); ++e)
    if (is_non_manifold_edge(e)) {
      non_manifold_vertices_[edge_vertices_[e][0]] = 1;
      non_manifold_vertices_[edge_vertices_[e][1]] = 1;
    }
  for (Index v = 0; v < vertex_count_; ++v) {
    const auto corners = vertex_corners(v);
    if (corners.empty() || non_manifold_vertices_[v] != 0) continue;
    // One fan holds every corner: walk from a border corner, or all the way round.
    Index start = corners[0];
    for (Index h : corners)
      if (mate(h) == kNoIndex) start = h;
    std::size_t count = 0;
    Index h = start;
    do {
      ++count;
      h = mate(prev(h));
    } while (h != kNoIndex && h != start);
    non_manifold_vertices_[v] = count != corners.size();
  }
}

}  // namespace subdivd

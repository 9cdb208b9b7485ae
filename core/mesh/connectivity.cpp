#include "core/mesh/connectivity.h"

#include <algorithm>
#include <functional>

namespace subdivd {
namespace {

// Where the row of every vertex's corners begins, and the last ends.
std::vector<Index> corner_offsets(Index vertex_count, std::span<const Index> corners, const Pace& pace) {
  std::vector<Index> offsets;
  pace.fill(offsets, Count{vertex_count} + 1, 0);
  pace.for_each(corners.size(), [&](std::size_t h) { ++offsets[corners[h] + 1]; });
  pace.for_each(Count{vertex_count}, [&](Count v) { offsets[v + 1] += offsets[v]; });
  return offsets;
}

// The vertices that have faces, ascending.
std::vector<Index> used_vertices(std::span<const Index> corners, const Pace& pace) {
  std::vector<Index> used;
  pace.copy(corners, used);
  pace.sort(used.begin(), used.end(), std::less<>());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

// Under numbers that leave out the unused vertices, and are in the same order, the edges are the same.
template <class Faces>
Edges find_edges_of_used(const Faces& faces, const Pace& pace) {
  const std::vector<Index> used = used_vertices(faces.corners(), pace);
  std::vector<Index> renumbered;
  pace.copy(faces.corners(), renumbered);
  pace.for_each(renumbered.size(), [&](std::size_t h) {
    renumbered[h] = static_cast<Index>(std::ranges::lower_bound(used, renumbered[h]) - used.begin());
  });
  const auto count = static_cast<Index>(used.size());
  const std::vector<Index> offsets = corner_offsets(count, renumbered, pace);
  Edges edges = find_edges(count, faces.with_corners(std::move(renumbered)), offsets, pace);
  pace.for_each(edges.vertices.size(), [&](std::size_t e) {
    for (Index& end : edges.vertices[e]) end = used[end];
  });
  return edges;
}

}  // namespace

template <class Faces>
Connectivity<Faces>::Connectivity(Index vertex_count, Faces faces, const Pace& pace)
    : vertex_count_(vertex_count), faces_(std::move(faces)) {
  edges_ =
      vertex_count_ > corner_vertices().size()
          ? find_edges_of_used(faces_, pace)
          : find_edges(vertex_count_, faces_, corner_offsets(vertex_count_, corner_vertices(), pace), pace);
}

template class Connectivity<Triangles>;
template class Connectivity<Quads>;
template class Connectivity<Polygons>;

}  // namespace subdivd

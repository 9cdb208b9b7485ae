#include "core/mesh/creases.h"

#include <algorithm>

namespace subdivd {
namespace {

// The pairs that have the same lower vertex, together and in their order: no search for each pair along the
// edges of a hub, and no hashing of numbers that a caller chose.
class PairsByVertex {
 public:
  PairsByVertex(Index vertex_count, std::span<const VertexPair> pairs, const Pace& pace) {
    pace.fill(offsets_, Count{vertex_count} + 1, 0);
    const auto low = [&](Count k) { return std::min(pairs[k][0], pairs[k][1]); };
    const auto is_known = [&](Count k) { return std::max(pairs[k][0], pairs[k][1]) < vertex_count; };
    pace.for_each(pairs.size(), [&](Count k) {
      if (is_known(k)) ++offsets_[low(k) + 1];
    });
    pace.for_each(Count{vertex_count}, [&](Count v) { offsets_[v + 1] += offsets_[v]; });
    std::vector<Index> ends;
    pace.copy(offsets_, ends);
    pace.fill(pairs_, offsets_.back(), 0);
    pace.for_each(pairs.size(), [&](Count k) {
      if (is_known(k)) pairs_[ends[low(k)]++] = static_cast<Index>(k);
    });
  }

  // Numbers of the pairs whose lower vertex is v, ascending.
  std::span<const Index> at(Index v) const {
    return std::span(pairs_).subspan(offsets_[v], offsets_[v + 1] - offsets_[v]);
  }

 private:
  std::vector<Index> offsets_, pairs_;
};

}  // namespace

std::vector<unsigned char> are_edges(Index vertex_count, std::span<const Index> counts,
                                     std::span<const Index> corners, std::span<const VertexPair> pairs,
                                     const Pace& pace) {
  std::vector<unsigned char> found;
  pace.fill(found, pairs.size(), 0);
  const PairsByVertex wanted(vertex_count, pairs, pace);
  // The half-edges at vertices that pairs have as their lower one: their higher ends, vertex by vertex.
  std::vector<Index> ends, offsets;
  pace.fill(offsets, Count{vertex_count} + 1, 0);
  const auto for_each_wanted = [&](auto&& f) {
    Count begin = 0;
    pace.for_each(counts.empty() ? corners.size() / 3 : counts.size(), [&](Count face) {
      const Count size = counts.empty() ? 3 : counts[face];
      pace.spend(size);
      for (Count k = 0; k < size; ++k) {
        const Index a = corners[begin + k], b = corners[begin + (k + 1 == size ? 0 : k + 1)];
        const Index low = std::min(a, b), high = std::max(a, b);
        if (high < vertex_count && !wanted.at(low).empty()) f(low, high);
      }
      begin += size;
    });
  };
  for_each_wanted([&](Index low, Index) { ++offsets[low + 1]; });
  pace.for_each(Count{vertex_count}, [&](Count v) { offsets[v + 1] += offsets[v]; });
  pace.fill(ends, offsets.back(), 0);
  for_each_wanted([&](Index low, Index high) { ends[offsets[low]++] = high; });  // offsets: now ends of rows

  std::vector<Index> reached;  // per vertex the last one that was found to have an edge to it
  pace.fill(reached, vertex_count, kNoIndex);
  Index begin = 0;
  for (Index v = 0; v < vertex_count; begin = offsets[v++]) {
    const auto here = wanted.at(v);
    pace.spend(1);
    if (here.empty()) continue;
    pace.for_each(Count{offsets[v]} - begin, [&](Count k) { reached[ends[begin + k]] = v; });
    pace.for_each(here.size(), [&](std::size_t k) {
      found[here[k]] = reached[std::max(pairs[here[k]][0], pairs[here[k]][1])] == v;
    });
  }
  return found;
}

namespace {

// A pair whose lower vertex has no more edges than this is looked for among them; at hubs that could be a
// million steps for each of a million pairs.
constexpr std::size_t kFewEdges = 32;

// Sets, in `found`, the edges of those pairs whose lower vertex is a hub.
template <class Faces>
void find_at_hubs(const Topology<Faces>& topology, std::span<const VertexPair> pairs,
                  std::vector<Index>& found, const Pace& pace) {
  const PairsByVertex wanted(topology.vertex_count(), pairs, pace);
  std::vector<Index> edge_to;  // per vertex the edge that last was found to lead to it
  pace.fill(edge_to, topology.vertex_count(), kNoIndex);
  for (Index v = 0; v < topology.vertex_count(); ++v) {
    const auto here = wanted.at(v);
    const auto edges = topology.vertex_edges(v);
    pace.spend(1);
    if (here.empty() || edges.size() <= kFewEdges) continue;
    pace.for_each(edges.size(), [&](std::size_t k) { edge_to[topology.other_end(edges[k], v)] = edges[k]; });
    pace.for_each(here.size(), [&](std::size_t k) {
      const auto [a, b] = pairs[here[k]];
      const VertexPair ends{std::min(a, b), std::max(a, b)};
      if (const Index e = edge_to[ends[1]]; e != kNoIndex && topology.edge_vertices(e) == ends)
        found[here[k]] = e;
    });
  }
}

}  // namespace

template <class Faces>
std::vector<Index> edges_between(const Topology<Faces>& topology, std::span<const VertexPair> pairs,
                                 const Pace& pace) {
  std::vector<Index> found;
  pace.fill(found, pairs.size(), kNoIndex);
  bool any_hub = false;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [a, b] = pairs[k];
    const VertexPair ends{std::min(a, b), std::max(a, b)};
    pace.spend(8);
    if (ends[1] >= topology.vertex_count()) continue;
    const auto edges = topology.vertex_edges(ends[0]);
    any_hub |= edges.size() > kFewEdges;
    if (edges.size() > kFewEdges) continue;
    for (const Index e : edges)
      if (topology.edge_vertices(e) == ends) found[k] = e;
  }
  if (any_hub) find_at_hubs(topology, pairs, found, pace);
  return found;
}

template std::vector<Index> edges_between(const Topology<Triangles>&, std::span<const VertexPair>,
                                          const Pace&);
template std::vector<Index> edges_between(const Topology<Quads>&, std::span<const VertexPair>, const Pace&);
template std::vector<Index> edges_between(const Topology<Polygons>&, std::span<const VertexPair>,
                                          const Pace&);

std::vector<VertexPair> crease_edges(const Cage& cage, const Pace& pace) {
  std::vector<VertexPair> pairs;
  pairs.reserve(cage.crease_indices.size());
  for_each_crease_edge(cage, [&](Count, Index a, Index b, float) {
    pace.spend(1);
    pairs.push_back({a, b});
  });
  return pairs;
}

}  // namespace subdivd

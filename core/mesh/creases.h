#pragma once
// Creases as edges: the one walk along the polylines of a control mesh, and the one look-up of what they run
// along.

#include <array>
#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/mesh/cage.h"
#include "core/mesh/topology.h"

namespace subdivd {

// Calls f(position, a, b, sharpness) for every edge of every crease in the order given: from point a =
// crease_indices[position] to b, the next. The creases' lengths and sharpnesses must fit, as check() has it.
template <class F>
void for_each_crease_edge(const Cage& cage, F&& f) {
  const bool per_crease = cage.crease_sharpnesses.size() == cage.crease_lengths.size();
  Count position = 0, edge = 0;
  for (Count crease = 0; crease < cage.crease_lengths.size(); ++crease, ++position)
    for (Index k = 1; k < cage.crease_lengths[crease]; ++k, ++position, ++edge)
      f(position, cage.crease_indices[position], cage.crease_indices[position + 1],
        cage.crease_sharpnesses[per_crease ? crease : edge]);
}

using VertexPair = std::array<Index, 2>;

// For each of the pairs 1 where a face has an edge between the two, else 0. `counts`: corners of every face, which must
// add up; empty: 3 each. Indices from vertex_count on are on no edge. Linear, whatever the pairs are.
std::vector<unsigned char> are_edges(Index vertex_count, std::span<const Index> counts,
                                     std::span<const Index> corners, std::span<const VertexPair> pairs,
                                     const Pace& pace);

// The edge between the two vertices of each pair; kNoIndex: there is none. Linear, whatever the pairs are.
template <class Faces>
std::vector<Index> edges_between(const Topology<Faces>& topology, std::span<const VertexPair> pairs,
                                 const Pace& pace);

// Those that f(position, ...) above is called for.
std::vector<VertexPair> crease_edges(const Cage& cage, const Pace& pace);

}  // namespace subdivd

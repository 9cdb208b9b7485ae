#pragma once
// Sharpness of edges and vertices, how it decays, and which rule it asks for.  [DeRose98, section 4; Far 3.5]

#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/mesh/cage.h"
#include "core/mesh/topology.h"

namespace subdivd {

enum class Rule {
  smooth,  // no sharp edge
  dart,    // one: the crease ends here; the vertex point is that of a smooth vertex
  crease,  // two
  corner,  // more, or the vertex itself is sharp
};

inline bool is_sharp(float s) { return s > 0; }
inline bool is_infinite(float s) { return s >= kInfiniteSharpness; }
inline bool is_semi_sharp(float s) { return s > 0 && s < kInfiniteSharpness; }

Rule rule_of(float vertex_sharpness, std::span<const float> edge_sharpness);

// Sharpness of a vertex, or of an edge under the uniform method, one level on: s - 1, never below 0; infinite
// stays infinite.
float decay(float s);

// Sharpness one level on of the child edges at a vertex, from the edges around it (any order, same order in
// `child`). uniform: decay of each. chaikin, for semi-sharp edges: 3/4 of the edge's own + 1/4 of the mean of
// the other semi-sharp edges' sharpness, minus 1.
void decay_around_vertex(CreaseMethod method, std::span<const float> parent, std::span<float> child,
                         const Pace& pace = {});

// What Chaikin's rule has to know of all edges at a vertex to decay one of them: the sum and the number of
// the semi-sharp ones. The way of one that is semi-sharp, one level on.
struct DecaySum {
  float sum = 0;
  Index count = 0;
};
float decay_beside(float s, DecaySum all);
// Those sums at this level and the following ones, until nothing at the vertex is semi-sharp: at most 10.
std::vector<DecaySum> decay_sums(std::vector<float> around, const Pace& pace = {});

// Weight of the parent's rule where parent and child differ: the mean of the sharpnesses that run out at this
// step, at most 1.
float fractional_weight(CreaseMethod method, float parent_vertex, float child_vertex,
                        std::span<const float> parent_edges, std::span<const float> child_edges);

struct Sharpness {
  std::vector<float> edges, vertices;  // one per edge / vertex of a Topology; infinite is kInfiniteSharpness
};

// Of the control mesh: the caller's creases and corners; borders and non-manifold edges are infinitely sharp,
// and so are pinned border corners and non-manifold vertices, but for those inside a non-manifold crease
// (exactly two non-manifold edges, no border, and more faces than edges). Creases along pairs that are no
// edges are skipped.
template <class Faces>
Sharpness control_sharpness(const Cage& cage, const Topology<Faces>& topology, const Pace& pace = {});

// 1 for faces that are not output: holeIndices, and with interpolateBoundary none every face at a border
// vertex that has a border edge the caller did not make infinitely sharp.
template <class Faces>
std::vector<unsigned char> hole_flags(const Cage& cage, const Topology<Faces>& topology,
                                      const Pace& pace = {});

}  // namespace subdivd

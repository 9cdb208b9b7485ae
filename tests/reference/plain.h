#pragma once
// Refinement level by level, with the topology of every level in full: slow, and plain enough to be believed.

#include <array>
#include <span>
#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/lattice/split.h"
#include "core/mesh/channel.h"
#include "core/mesh/sharpness.h"
#include "core/mesh/topology.h"

namespace subdivd::plain {

// One level of a mesh or channel. Vertices of the next level: the vertex points in the order of the vertices,
// then the edge points in the order of the edges. Face f has the children 4 f + k at its corners k and 4 f +
// 3 between.
struct Level {
  Topology topology;
  Sharpness sharpness;
  // Sharpness of the halves of every edge, one level on: [e][0] next to its lower-numbered end, [e][1] to the
  // other.
  std::vector<std::array<float, 2>> halves;
  bool linear = false, linear_borders = false;  // see Channel
  std::vector<GridPoint> corners;  // per half-edge: where its corner lies on the grid of the base face
};

Level first_level(Topology topology, Sharpness sharpness, CreaseMethod method);
// Channels have the mesh's sharpness but for their borders, at every level: under Chaikin's rule it decays
// with the edges around a point of the *mesh*, of which a channel's vertex at a seam sees only some. `mesh`:
// the level of the mesh that the channel's level belongs to.
Level first_level(const Channel& channel, const Level& mesh);
Result<Level> next_level(const Level& level, CreaseMethod method, const Budget& budget);
Result<Level> next_level(const Level& channel, const Level& next_mesh, const Budget& budget);

// Values of the next level's vertices: width scalars each. `linear`: midpoints, whatever the level's own
// rules.
template <class Scheme, class Real>
Result<std::vector<Real>> refine_values(const Scheme& scheme, CreaseMethod method, const Level& level,
                                        std::span<const Real> values, Index width, bool linear,
                                        const Budget& budget);

// For every vertex of `level` (after `depth` steps from `base`) its number by the closed form; unreferenced
// points keep theirs.
std::vector<Index> closed_form_numbers(const Topology& base, Index depth, const Level& level);

}  // namespace subdivd::plain

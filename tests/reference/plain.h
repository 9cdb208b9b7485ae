#pragma once
// The plain engine's levels (core/engine/plain), as the limit masks and the closed form take them.

#include <vector>

#include "core/base/index.h"
#include "core/engine/plain/level.h"
#include "core/mesh/channel.h"
#include "core/mesh/topology.h"

namespace subdivd::plain {

// Level 0 of a mesh, and of a channel of it.
Level first_level(const Topology<Triangles>& topology, Sharpness sharpness, CreaseMethod method);
Level first_level(const Channel<Triangles>& channel, const Level& mesh);

// The faces of a level of triangles as a topology, numbers and all.
Topology<Triangles> topology_of(const Adjacency& faces);

// For every vertex of the level `depth` steps from `base` its number by the closed form; unreferenced points
// keep theirs.
std::vector<Index> closed_form_numbers(const Topology<Triangles>& base, Index depth, const Adjacency& faces);

}  // namespace subdivd::plain

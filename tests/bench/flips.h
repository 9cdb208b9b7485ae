#pragma once
// Makes a regular mesh irregular, as scanned and simplified meshes are.

#include <vector>

#include "core/base/index.h"
#include "tests/shapes/random.h"

namespace subdivd::bench {

// Flips random edges of a closed manifold until `share` of the points have another valence than 6, keeping
// all valences within 4 to 9 and the mesh manifold. Faces keep their places, so that their order stays
// natural.
void flip_edges(std::vector<Index>& triangles, Index point_count, double share, shapes::Random& random);

}  // namespace subdivd::bench

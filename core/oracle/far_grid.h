#pragma once
// The place of every refined face corner on its base face, followed through Far's parent relations alone.

#include "core/base/buffer.h"
#include "core/base/pace.h"
#include "core/lattice/split.h"
#include "core/oracle/far_refiner.h"

namespace subdivd::oracle {

// Per face of a level: its base face, and where each of its three corners lies on that face's grid.
struct FarGrid {
  Buffer<GridPoint> corners;
  Buffer<Index> base_faces;
};

// Of level `depth` of a refiner that has been refined that far. Throws Stopped.
FarGrid grid_of(const OpenSubdiv::Far::TopologyRefiner& refiner, Index depth, const Pace& pace);

}  // namespace subdivd::oracle

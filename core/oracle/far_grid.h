#pragma once
// The place of every refined corner on its base face, followed through Far's parent relations alone.

#include "core/base/buffer.h"
#include "core/base/pace.h"
#include "core/lattice/split.h"
#include "core/oracle/far_refiner.h"
#include "core/oracle/grids.h"

namespace subdivd::oracle {

// Per face of a level: its base face, and where each of its corners lies on that face's grid (grids.h). A
// corner whose vertex is no child of what Far calls the face's parent lies at (kNoIndex, kNoIndex).
struct FarGrid {
  Buffer<GridPoint> corners;
  Buffer<Index> base_faces;
  // Of GridShape::corners, from level 1 on: the corner of the base face whose quad they lie on; 0 on faces of
  // four.
  Buffer<Index> base_corners;
};

// Of level `depth` of a refiner that has been refined that far. Throws Stopped.
FarGrid grid_of(const OpenSubdiv::Far::TopologyRefiner& refiner, GridShape shape, Index depth,
                const Pace& pace);

}  // namespace subdivd::oracle

#pragma once
// A mesh or channel that `plain` refines level by level, where the lattice numbers every level in closed form: schemes that
// cut triangles into four or quads into four, and whose points depend on more than the engines on grids look at. The
// rows of its steps are made once, in the lattice's numbering, and serve any values.

#include <memory>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/engine/plain/level.h"
#include "core/engine/plain/step_rows.h"
#include "core/lattice/lattice.h"
#include "core/schemes/all.h"

namespace subdivd {

struct Steps {
  std::shared_ptr<const Lattice> lattice;
  std::vector<plain::StepRows> rows;  // the k-th leads from level k to k + 1
  std::vector<plain::StepRows>
      tangents;               // of levels from 0 on, two rows a vertex, empty where none are known
  std::vector<Index> values;  // of a channel: see Channel
  bool linear = false;        // see Channel: no rows
};

// Of levels 0 to `max_level`. `frames`: whether tangents will be asked for. Vertices stay where they are, so that limits
// need no rows.
Steps interpolating_steps(const AnyInterpolatingScheme& scheme, plain::Level base,
                          std::shared_ptr<const Lattice> lattice, Index max_level, bool frames,
                          const Pace& pace);

// Bytes of what the steps hold, and of what making them takes at most, of a mesh of so many corners.
Count steps_bytes(Count corners, Index max_level, bool frames);

}  // namespace subdivd

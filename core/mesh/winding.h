#pragma once
// From clockwise faces to counter-clockwise ones and back.

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/mesh/control_mesh.h"

namespace subdivd {

// Turns every face round its first corner, (0,1,2) to (0,2,1), its face-varying indices and render faces with
// it: the same surface, whose normals point to the other side. The mesh has passed check(), and still would.
// Takes memory for the indices of face-varying values that had none. Stopped by the budget, it leaves the mesh
// in any state.
Result<void> reverse_windings(ControlMesh& mesh, const Budget& budget = {});

}  // namespace subdivd

#pragma once
// refine() as it was before it was fast: level by level, every level's topology in full. The reference of the
// engine in core/engine/tri_grid, with the same answer.

#include "core/refine/refine.h"

namespace subdivd::plain {

// As subdivd::refine, for meshes known to be good: the scheme is Loop, sizes are small. Ignores `threads`,
// fills everything.
template <class Real>
Result<RefinedMesh<Real>> refine(const ControlMesh& mesh, const RefineOptions& options);

}  // namespace subdivd::plain

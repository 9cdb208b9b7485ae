#pragma once
// Refined render meshes: connectivity only, numbered like everything else (split.h) over the render mesh's
// own vertices, in which a seam of any attribute is a border.

#include <memory>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/mesh/control_mesh.h"
#include "core/refine/plan.h"
#include "core/refine/refined_mesh.h"

namespace subdivd {

// `lattice`: the plan's, of this render mesh. `face_begin`: output faces of the base faces before this render mesh's.
// Takes time and memory for its own faces and vertices alone: a mesh may have a hundred thousand of them.
Result<RefinedRenderMesh> refine_render_mesh(const RenderMesh& mesh,
                                             const std::shared_ptr<const Lattice>& lattice, const Plan& plan,
                                             Index level, Index face_begin, const Budget& budget);

}  // namespace subdivd

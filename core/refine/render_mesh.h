#pragma once
// Refined render meshes: connectivity only, numbered like everything else (split.h) over the render mesh's
// own vertices, in which a seam of any attribute is a border.

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/mesh/control_mesh.h"
#include "core/refine/plan.h"
#include "core/refine/refined_mesh.h"

namespace subdivd {

Result<RefinedRenderMesh> refine_render_mesh(const RenderMesh& mesh, const Plan& plan, Index level,
                                             Index threads, const Budget& budget);

// Vertices that refine_render_mesh would make.
Result<Count> count_render_vertices(const RenderMesh& mesh, Index level, const Budget& budget);

}  // namespace subdivd

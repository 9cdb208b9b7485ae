#pragma once
// Refined render meshes: connectivity only, numbered like everything else (split.h) over the render mesh's
// own vertices, in which a seam of any attribute is a border.

#include <span>

#include "core/mesh/control_mesh.h"
#include "core/refine/refined_mesh.h"

namespace subdivd {

// `holes`: per base face of the control mesh, 1 = not output.
RefinedRenderMesh refine_render_mesh(const RenderMesh& mesh, Index level,
                                     std::span<const unsigned char> holes);

// Vertices that refine_render_mesh would make.
Count count_render_vertices(const RenderMesh& mesh, Index level);

}  // namespace subdivd

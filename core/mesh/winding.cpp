#include "core/mesh/winding.h"

#include <utility>
#include <vector>

#include "core/base/pace.h"

namespace subdivd {

Result<void> reverse_windings(ControlMesh& mesh, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) -> Result<void> {
    const auto turn = [&](std::vector<Index>& corners) {
      pace.for_each(corners.size() / 3, [&](Count f) { std::swap(corners[3 * f + 1], corners[3 * f + 2]); });
    };
    for (Primvar& primvar : mesh.primvars) {
      pace.spend(1);
      if (primvar.interpolation != Interpolation::face_varying) continue;
      if (primvar.indices.empty()) {  // values in the corners' order: name them before it changes
        const Count corners = mesh.face_vertex_indices.size();
        if (auto taken = budget.take_memory(corners * sizeof(Index)); !taken) return taken;
        primvar.indices.reserve(corners);
        pace.for_each(corners, [&](Count c) { primvar.indices.push_back(static_cast<Index>(c)); });
      }
      turn(primvar.indices);
    }
    for (RenderMesh& render : mesh.render_meshes) turn(render.indices);
    turn(mesh.face_vertex_indices);
    return {};
  });
}

}  // namespace subdivd

#include "core/mesh/winding.h"

#include <algorithm>
#include <vector>

#include "core/base/pace.h"

namespace subdivd {

Result<void> reverse_windings(ControlMesh& mesh, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) -> Result<void> {
    // The first corner of every face stays the first. `first_face`: of those that the corners belong to.
    const auto turn = [&](std::vector<Index>& corners, Index first_face = 0) {
      auto begin = corners.begin();
      for (Index f = first_face; begin != corners.end(); ++f) {
        const Index size = mesh.face_size(f);
        pace.spend(size);
        std::reverse(begin + 1, begin + size);
        begin += size;
      }
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
    for (RenderMesh& render : mesh.render_meshes) turn(render.indices, render.face_begin);
    turn(mesh.face_vertex_indices);
    return {};
  });
}

}  // namespace subdivd

#include "core/mesh/cage.h"

#include <algorithm>

#include "core/mesh/control_mesh.h"

namespace subdivd {

Cage::Cage(const ControlMesh& mesh)
    : subdivision_scheme(mesh.subdivision_scheme),
      point_count(static_cast<Index>(mesh.point_count())),
      face_vertex_counts(mesh.face_vertex_counts),
      face_vertex_indices(mesh.face_vertex_indices),
      interpolate_boundary(mesh.interpolate_boundary),
      face_varying_linear_interpolation(mesh.face_varying_linear_interpolation),
      triangle_subdivision_rule(mesh.triangle_subdivision_rule),
      crease_indices(mesh.crease_indices),
      crease_lengths(mesh.crease_lengths),
      crease_sharpnesses(mesh.crease_sharpnesses),
      corner_indices(mesh.corner_indices),
      corner_sharpnesses(mesh.corner_sharpnesses),
      hole_indices(mesh.hole_indices),
      render_meshes(mesh.render_meshes) {
  for (const Primvar& primvar : mesh.primvars) {
    if (primvar.interpolation != Interpolation::face_varying) continue;
    const Index width = std::max<Index>(1, primvar.element_size);  // check() walks creases of unsound meshes
    channels.push_back({static_cast<Index>(primvar.values.size() / width), primvar.indices});
  }
}

}  // namespace subdivd

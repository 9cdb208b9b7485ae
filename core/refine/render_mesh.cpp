#include "core/refine/render_mesh.h"

#include <algorithm>

#include "core/mesh/topology.h"
#include "core/refine/numbering.h"

namespace subdivd {

RefinedRenderMesh refine_render_mesh(const RenderMesh& mesh, Index level,
                                     std::span<const unsigned char> holes) {
  const Topology topology(mesh.vertex_count, mesh.indices);
  const Numbering numbering(topology, level);
  const Count n = numbering.segment_count();
  RefinedRenderMesh refined;
  refined.vertex_count = static_cast<Index>(numbering.vertex_count());
  const auto output_faces = [&](Index begin, Index end) {
    return static_cast<Count>(std::count(holes.begin() + begin, holes.begin() + end, 0));
  };
  refined.triangle_begin = static_cast<Index>(output_faces(0, mesh.face_begin) * n * n);
  refined.triangle_end =
      static_cast<Index>(refined.triangle_begin + output_faces(mesh.face_begin, mesh.face_end) * n * n);
  refined.indices.reserve(3 * (Count{refined.triangle_end} - refined.triangle_begin));
  for (Index f = mesh.face_begin; f < mesh.face_end; ++f) {
    if (holes[f] != 0) continue;
    const Index own = f - mesh.face_begin;
    for_each_triangle(n, [&](Count i0, Count j0, Count i1, Count j1, Count i2, Count j2) {
      refined.indices.push_back(numbering.vertex(own, i0, j0));
      refined.indices.push_back(numbering.vertex(own, i1, j1));
      refined.indices.push_back(numbering.vertex(own, i2, j2));
    });
  }
  refined.source_corner.assign(refined.vertex_count, kNoIndex);
  for (Count k = refined.indices.size(); k-- > 0;)  // backwards: the first corner wins
    refined.source_corner[refined.indices[k]] = static_cast<Index>(3 * Count{refined.triangle_begin} + k);
  return refined;
}

Count count_render_vertices(const RenderMesh& mesh, Index level) {
  const Topology topology(mesh.vertex_count, mesh.indices);
  return refined_counts(topology.vertex_count(), topology.edge_count(), topology.face_count(), level)
      .vertices;
}

}  // namespace subdivd

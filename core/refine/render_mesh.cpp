#include "core/refine/render_mesh.h"

#include <algorithm>

#include "core/mesh/topology.h"
#include "core/refine/numbering.h"
#include "core/refine/triangles.h"

namespace subdivd {
namespace {

// For every refined vertex of the render mesh the refined vertex of `net` at the same place of the same face.
Result<Buffer<Index>> sources_of(const Topology& render, const Topology& net, Index first_face, Index level,
                                 std::span<const unsigned char> holes, Count vertex_count,
                                 const Budget& budget) {
  const Count n = segments(level);
  Buffer<Index> sources(vertex_count);
  std::ranges::fill(sources, kNoIndex);
  const Count faces_per_poll = std::max<Count>(1, (Count{1} << 18) / (n * n));
  for (Index face = 0; face < render.face_count(); ++face) {
    if (face % faces_per_poll == 0)
      if (auto stop = budget.poll()) return *stop;
    if (holes[face] != 0) continue;
    const FaceNumbers to(render, n, face), from(net, n, first_face + face);
    for (int k = 0; k < 3; ++k) {
      sources[to.corner[k]] = from.corner[k];
      for (Index p = 0; p + 1 < n; ++p)
        sources[static_cast<Index>(to.side[k] + p * to.step[k])] = from.side[k] + p * from.step[k];
    }
    for (Index p = 0; p < inner_points(n); ++p) sources[to.inside + p] = from.inside + p;
  }
  return sources;
}

}  // namespace

Result<RefinedRenderMesh> refine_render_mesh(const RenderMesh& mesh, const Plan& plan, Index level,
                                             Index threads, const Budget& budget) {
  const auto topology = Topology::build(mesh.vertex_count, mesh.indices, budget);
  if (!topology) return topology.error();
  const Count n = segments(level);
  const auto holes = plan.holes();
  const auto own_holes = holes.subspan(mesh.face_begin, mesh.face_end - mesh.face_begin);
  RefinedRenderMesh refined;
  refined.vertex_count = static_cast<Index>(Numbering(*topology, level).vertex_count());
  const auto triangles = [&](std::span<const unsigned char> faces) {
    return static_cast<Count>(std::ranges::count(faces, 0)) * n * n;
  };
  refined.triangle_begin = static_cast<Index>(triangles(holes.first(mesh.face_begin)));
  refined.triangle_end = static_cast<Index>(refined.triangle_begin + triangles(own_holes));
  refined.indices.resize(3 * Count{refined.triangle_end - refined.triangle_begin});
  if (auto done = write_triangles(*topology, level, own_holes, refined.indices.data(), threads, budget);
      !done)
    return std::move(done).error();
  const auto sources = [&](const Net& net) {
    return sources_of(*topology, net.topology(), mesh.face_begin, level, own_holes, refined.vertex_count,
                      budget);
  };
  auto vertices = sources(plan.mesh());
  if (!vertices) return std::move(vertices).error();
  refined.source_vertices = std::move(*vertices);
  for (std::size_t k = 0; k < plan.channel_count(); ++k) {
    auto values = sources(plan.channel(k));
    if (!values) return std::move(values).error();
    refined.source_values.push_back(std::move(*values));
  }
  return refined;
}

Result<Count> count_render_vertices(const RenderMesh& mesh, Index level, const Budget& budget) {
  const auto topology = Topology::build(mesh.vertex_count, mesh.indices, budget);
  if (!topology) return topology.error();
  return refined_counts(topology->vertex_count(), topology->edge_count(), topology->face_count(), level)
      .vertices;
}

}  // namespace subdivd

#include "core/refine/render_mesh.h"

#include <algorithm>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/mesh/topology.h"
#include "core/refine/numbering.h"
#include "core/refine/triangles.h"

namespace subdivd {
namespace {

// For every refined vertex of the render mesh the refined vertex of `net` at the same place of the same face.
Buffer<Index> sources_of(const Topology& render, const Topology& net, Index first_face, Index level,
                         std::span<const unsigned char> holes, Count vertex_count, const Pace& pace) {
  const Count n = segments(level);
  Buffer<Index> sources;
  pace.fill(sources, vertex_count, kNoIndex);
  for (Index face = 0; face < render.face_count(); ++face) {
    pace.spend(3 * n);
    if (holes[face] != 0) continue;
    const FaceNumbers to(render, n, face), from(net, n, first_face + face);
    for (int k = 0; k < 3; ++k) {
      sources[to.corner[k]] = from.corner[k];
      for (Index p = 0; p + 1 < n; ++p)
        sources[static_cast<Index>(to.side[k] + p * to.step[k])] = from.side[k] + p * from.step[k];
    }
    pace.for_each(inner_points(n),
                  [&](Count p) { sources[to.inside + p] = static_cast<Index>(from.inside + p); });
  }
  return sources;
}

// Edges of the triangles, of whose vertex numbers most may be unused.
Count count_edges(Index vertex_count, std::span<const Index> triangles, const Pace& pace) {
  std::vector<Index> indices;
  pace.copy(triangles, indices);
  if (vertex_count > triangles.size()) {
    std::vector<Index> used;
    pace.copy(triangles, used);
    pace.sort(used.begin(), used.end(), std::less<>());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    pace.for_each(indices.size(), [&](std::size_t k) {
      indices[k] = static_cast<Index>(std::ranges::lower_bound(used, indices[k]) - used.begin());
    });
    vertex_count = static_cast<Index>(used.size());
  }
  return Topology(vertex_count, std::move(indices), pace).edge_count();
}

Result<RefinedRenderMesh> refine(const RenderMesh& mesh, const Plan& plan, Index level, Index triangle_begin,
                                 Index threads, const Budget& budget, const Pace& pace) {
  std::vector<Index> indices;
  pace.copy(mesh.indices, indices);
  const Topology topology(mesh.vertex_count, std::move(indices), pace);
  const auto holes = plan.holes().subspan(mesh.face_begin, mesh.face_end - mesh.face_begin);
  RefinedRenderMesh refined;
  refined.vertex_count = static_cast<Index>(Numbering(topology, level).vertex_count());
  const auto faces = static_cast<Count>(std::ranges::count(holes, 0));
  refined.triangle_begin = triangle_begin;
  refined.triangle_end = static_cast<Index>(triangle_begin + (faces << (2 * level)));
  refined.indices.resize(3 * Count{refined.triangle_end - refined.triangle_begin});
  if (auto done = write_triangles(topology, level, holes, refined.indices.data(), threads, budget); !done)
    return std::move(done).error();
  const auto sources = [&](const Net& net) {
    return sources_of(topology, net.topology(), mesh.face_begin, level, holes, refined.vertex_count, pace);
  };
  refined.source_vertices = sources(plan.mesh());
  refined.source_values.reserve(plan.channel_count());
  for (std::size_t k = 0; k < plan.channel_count(); ++k)
    refined.source_values.push_back(sources(plan.channel(k)));
  return refined;
}

}  // namespace

Result<RefinedRenderMesh> refine_render_mesh(const RenderMesh& mesh, const Plan& plan, Index level,
                                             Index triangle_begin, Index threads, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) {
    return refine(mesh, plan, level, triangle_begin, threads, budget, pace);
  });
}

Count count_render_vertices(const RenderMesh& mesh, Index level, const Pace& pace) {
  return refined_counts(mesh.vertex_count, count_edges(mesh.vertex_count, mesh.indices, pace),
                        mesh.face_end - mesh.face_begin, level)
      .vertices;
}

}  // namespace subdivd

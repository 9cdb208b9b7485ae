#include "core/refine/render_mesh.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "core/base/pace.h"
#include "core/refine/numbering.h"
#include "core/refine/triangles.h"

namespace subdivd {
namespace {

// For every refined vertex of the render mesh the refined vertex of `net` at the same place of the same face.
Buffer<Index> sources_of(const Connectivity& render, const Connectivity& net, Index first_face, Index level,
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

Result<RefinedRenderMesh> refine(const RenderMesh& mesh, const Connectivity& connectivity, const Plan& plan,
                                 Index level, Index triangle_begin, Index threads, const Budget& budget,
                                 const Pace& pace) {
  const auto holes = plan.holes().subspan(mesh.face_begin, mesh.face_end - mesh.face_begin);
  RefinedRenderMesh refined;
  refined.vertex_count = static_cast<Index>(Numbering(connectivity, level).vertex_count());
  const auto faces = static_cast<Count>(std::ranges::count(holes, 0));
  refined.triangle_begin = triangle_begin;
  refined.triangle_end = static_cast<Index>(triangle_begin + (faces << (2 * level)));
  refined.indices.resize(3 * Count{refined.triangle_end - refined.triangle_begin});
  if (auto done = write_triangles(connectivity, level, holes, refined.indices.data(), threads, budget); !done)
    return std::move(done).error();
  const auto sources = [&](const Net& net) -> Buffer<Index> {
    if (&connectivity == &net.topology()) return {};
    return sources_of(connectivity, net.topology(), mesh.face_begin, level, holes, refined.vertex_count,
                      pace);
  };
  refined.source_vertices = sources(plan.net());
  refined.source_values.reserve(plan.channel_count());
  for (std::size_t k = 0; k < plan.channel_count(); ++k)
    refined.source_values.push_back(sources(plan.channel_net(k)));
  return refined;
}

}  // namespace

Result<RefinedRenderMesh> refine_render_mesh(const RenderMesh& mesh, const Connectivity& connectivity,
                                             const Plan& plan, Index level, Index triangle_begin,
                                             Index threads, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) {
    return refine(mesh, connectivity, plan, level, triangle_begin, threads, budget, pace);
  });
}

}  // namespace subdivd

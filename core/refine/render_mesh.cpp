#include "core/refine/render_mesh.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "core/base/pace.h"
#include "core/lattice/numbering.h"
#include "core/lattice/sources.h"
#include "core/lattice/triangles.h"

namespace subdivd {
namespace {

Result<RefinedRenderMesh> refine(const RenderMesh& mesh, const Connectivity<Triangles>& connectivity,
                                 const Plan& plan, Index level, Index triangle_begin, Index threads,
                                 const Budget& budget, const Pace& pace) {
  const auto holes = plan.holes().subspan(mesh.face_begin, mesh.face_end - mesh.face_begin);
  RefinedRenderMesh refined;
  refined.vertex_count = static_cast<Index>(Numbering(connectivity, level).vertex_count());
  const auto faces = static_cast<Count>(std::ranges::count(holes, 0));
  refined.triangle_begin = triangle_begin;
  refined.triangle_end = static_cast<Index>(triangle_begin + faces * triangles_per_face(level));
  refined.indices.resize(3 * Count{refined.triangle_end - refined.triangle_begin});
  if (auto done = write_triangles(connectivity, level, holes, refined.indices.data(), threads, budget); !done)
    return std::move(done).error();
  const auto sources = [&](const Net& net) -> Buffer<Index> {
    if (&connectivity == &net.topology()) return {};
    return vertex_sources(connectivity, net.topology(), mesh.face_begin, level, holes, pace);
  };
  refined.source_vertices = sources(plan.net());
  refined.source_values.reserve(plan.channel_count());
  for (std::size_t k = 0; k < plan.channel_count(); ++k)
    refined.source_values.push_back(sources(plan.channel_net(k)));
  return refined;
}

}  // namespace

Result<RefinedRenderMesh> refine_render_mesh(const RenderMesh& mesh,
                                             const Connectivity<Triangles>& connectivity, const Plan& plan,
                                             Index level, Index triangle_begin, Index threads,
                                             const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) {
    return refine(mesh, connectivity, plan, level, triangle_begin, threads, budget, pace);
  });
}

}  // namespace subdivd

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

RefinedRenderMesh refine(const RenderMesh& mesh, std::shared_ptr<const Connectivity<Triangles>> shared,
                         const Plan& plan, Index level, Index triangle_begin, const Pace& pace) {
  const Connectivity<Triangles>& connectivity = *shared;
  const auto holes = plan.holes().subspan(mesh.face_begin, mesh.face_end - mesh.face_begin);
  RefinedRenderMesh refined;
  refined.vertex_count = static_cast<Index>(Numbering(connectivity, level).vertex_count());
  refined.triangles = TriangleStream(std::move(shared), level, holes);
  refined.triangle_begin = triangle_begin;
  refined.triangle_end = static_cast<Index>(triangle_begin + refined.triangles.index_count() / 3);
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
                                             std::shared_ptr<const Connectivity<Triangles>> connectivity,
                                             const Plan& plan, Index level, Index triangle_begin,
                                             const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) {
    return refine(mesh, std::move(connectivity), plan, level, triangle_begin, pace);
  });
}

}  // namespace subdivd

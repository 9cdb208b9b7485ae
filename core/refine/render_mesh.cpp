#include "core/refine/render_mesh.h"

#include <span>
#include <utility>

#include "core/base/pace.h"
#include "core/lattice/sources.h"

namespace subdivd {
namespace {

RefinedRenderMesh refine(const RenderMesh& mesh, const std::shared_ptr<const Lattice>& lattice,
                         const Plan& plan, Index level, Index face_begin, const Pace& pace) {
  const auto holes = plan.holes().subspan(mesh.face_begin, mesh.face_end - mesh.face_begin);
  RefinedRenderMesh refined;
  refined.vertex_count = static_cast<Index>(lattice->vertex_count(level));
  refined.triangles = TriangleStream(lattice, level, holes, pace);
  refined.face_begin = face_begin;
  refined.face_end = static_cast<Index>(face_begin + lattice->face_count(level, holes, pace));
  const auto sources = [&](const Refinable& part) -> Buffer<Index> {
    if (lattice == part.lattice()) return {};
    return vertex_sources(*lattice, *part.lattice(), mesh.face_begin, level, holes, pace);
  };
  refined.source_vertices = sources(plan.mesh());
  refined.source_values.reserve(plan.channel_count());
  for (std::size_t k = 0; k < plan.channel_count(); ++k)
    refined.source_values.push_back(sources(plan.channel(k)));
  return refined;
}

}  // namespace

Result<RefinedRenderMesh> refine_render_mesh(const RenderMesh& mesh,
                                             const std::shared_ptr<const Lattice>& lattice, const Plan& plan,
                                             Index level, Index face_begin, const Budget& budget) {
  return stoppable(budget,
                   [&](const Pace& pace) { return refine(mesh, lattice, plan, level, face_begin, pace); });
}

}  // namespace subdivd

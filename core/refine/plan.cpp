#include "core/refine/plan.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "core/schemes/all.h"

namespace subdivd {
namespace {

std::vector<Index> corner_values(const ControlMesh& mesh, const Primvar& primvar) {
  if (!primvar.indices.empty()) return primvar.indices;
  std::vector<Index> corners(mesh.face_vertex_indices.size());
  std::iota(corners.begin(), corners.end(), Index{0});
  return corners;
}

}  // namespace

Result<Plan> Plan::build(const ControlMesh& mesh, const PlanOptions& options, const Budget& budget) {
  std::optional<AnyScheme> scheme;
  visit_scheme(mesh.subdivision_scheme,
               [&]<class S>(std::type_identity<S>) { scheme = S{options.loop_weights}; });
  if (!scheme)
    return Error{ErrorCode::bad_enum,
                 "\"" + mesh.subdivision_scheme + "\" is no scheme of this version; valid: \"loop\"",
                 {"subdivisionScheme"},
                 0,
                 0};
  Plan plan;
  auto topology = Topology::build(static_cast<Index>(mesh.point_count()), mesh.face_vertex_indices, budget);
  if (!topology) return std::move(topology).error();
  Sharpness sharpness = control_sharpness(mesh, *topology);
  plan.holes_ = hole_flags(mesh, *topology);
  plan.output_faces_ = static_cast<Count>(std::ranges::count(plan.holes_, 0));
  auto net = Net::build(*scheme, options.crease_method, std::move(*topology), std::move(sharpness),
                        options.max_level, budget);
  if (!net) return std::move(net).error();
  plan.nets_.push_back(std::make_shared<const Net>(std::move(*net)));
  for (const Primvar& primvar : mesh.primvars) {
    if (primvar.interpolation != Interpolation::face_varying) continue;
    if (auto stop = budget.poll()) return *stop;
    Channel channel = make_channel(mesh, options.crease_method, plan.mesh().topology(),
                                   plan.mesh().sharpness(), corner_values(mesh, primvar),
                                   static_cast<Index>(primvar.values.size() / primvar.element_size));
    auto own = Net::build(plan.nets_[0], std::move(channel), budget);
    if (!own) return std::move(own).error();
    plan.nets_.push_back(std::make_shared<const Net>(std::move(*own)));
  }
  return plan;
}

LevelCounts Plan::counts(Index level) const {
  const Topology& topology = mesh().topology();
  LevelCounts counts =
      refined_counts(topology.vertex_count(), topology.edge_count(), topology.face_count(), level);
  counts.triangles = output_faces_ << (2 * level);
  return counts;
}

}  // namespace subdivd

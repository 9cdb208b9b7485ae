#include "core/refine/plan.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/pace.h"

namespace subdivd {
namespace {

Error no_such_scheme(std::string_view name) {
  std::string known;
  for (const std::string_view one : kSchemeNames)
    known += (known.empty() ? "\"" : ", \"") + std::string(one) + '"';
  return Error{ErrorCode::bad_enum,
               '"' + std::string(name) + "\" is no scheme of this version; valid: " + known,
               {"subdivisionScheme"}};
}

// Of every corner in turn.
std::vector<Index> corner_values(const Cage& cage, const Cage::Seams& seams, const Pace& pace) {
  std::vector<Index> corners;
  if (seams.corner_values.empty())
    pace.for_each(static_cast<Index>(cage.face_vertex_indices.size()),
                  [&](Index k) { corners.push_back(k); });
  else
    pace.copy(seams.corner_values, corners);
  return corners;
}

bool are_alike(const Cage::Seams& a, const Cage::Seams& b, const Pace& pace) {
  return a.value_count == b.value_count && pace.equal(a.corner_values, b.corner_values);
}

bool connects_alike(const Topology<Triangles>& topology, const RenderMesh& render, const Pace& pace) {
  return topology.vertex_count() == render.vertex_count &&
         pace.equal(topology.corner_vertices(), render.indices) &&
         pace.all_blocks(topology.vertex_count(), [&](Count begin, Count end) {
           for (Count v = begin; v < end; ++v)
             if (topology.vertex_corners(static_cast<Index>(v)).empty()) return false;
           return true;
         });
}

}  // namespace

Result<void> check_level(Index level) {
  if (level <= kMaxLevel) return {};
  return Error{.code = ErrorCode::out_of_range,
               .message = "level must be 0 to " + std::to_string(kMaxLevel),
               .predicted = level,
               .allowed = kMaxLevel};
}

// Measured on closed meshes, separate triangles, hubs and many channels.
constexpr Count kBytesPerFace = 336, kBytesPerPoint = 64;

Count plan_bytes(const Cage& cage, const PlanOptions& options) {
  const Count nets = 1 + cage.channels.size();
  Count bytes = (kBytesPerFace * cage.face_count() + kBytesPerPoint * cage.point_count) *
                (nets + (cage.render_meshes.empty() ? 0 : 1));
  if (options.crease_method == CreaseMethod::chaikin) {
    const Count edges = std::min<Count>(cage.crease_indices.size(), 3 * cage.face_count());
    bytes += nets * chaikin_bytes(edges, options.max_level);
  }
  return bytes;
}

Result<Plan> Plan::build(const Cage& cage, const PlanOptions& options, const Budget& budget) {
  const std::optional<AnyScheme> scheme = scheme_of_mesh(cage.subdivision_scheme, options.schemes);
  if (!scheme) return no_such_scheme(cage.subdivision_scheme);
  if (auto allowed = check_level(options.max_level); !allowed) return std::move(allowed).error();
  return stoppable(budget, [&](const Pace& pace) -> Result<Plan> {
    Plan plan;
    std::vector<Index> triangles;
    pace.copy(cage.face_vertex_indices, triangles);
    auto shared =
        std::make_shared<const Topology<Triangles>>(cage.point_count, Triangles(std::move(triangles)), pace);
    const Topology<Triangles>& topology = *shared;
    // Sharpness that varies along edges takes memory at every level: not more than points alone would.
    const LevelCounts counts = refined_counts(topology.vertex_count(), topology.edge_count(),
                                              topology.face_count(), options.max_level);
    if (auto fits = budget.check_bytes(counts.vertices * 3 * sizeof(float)); !fits)
      return std::move(fits).error();
    Sharpness sharpness = control_sharpness(cage, topology, pace);
    plan.holes_ = hole_flags(cage, topology, pace);
    pace.for_each(plan.holes_.size(), [&](std::size_t f) { plan.output_faces_ += plan.holes_[f] == 0; });
    plan.nets_.push_back(std::make_shared<const Net>(Net::build(
        *scheme, options.crease_method, std::move(shared), std::move(sharpness), options.max_level, pace)));
    plan.add_channels(cage, options.crease_method, pace);
    plan.add_render_meshes(cage, pace);
    return plan;
  });
}

void Plan::add_channels(const Cage& cage, CreaseMethod method, const Pace& pace) {
  const Net& points = net();
  std::vector<Index> vertices;
  // Compared with the one before, not with all earlier ones: there may be a hundred thousand.
  const Cage::Seams* previous = nullptr;
  for (const Cage::Seams& seams : cage.channels) {
    pace.spend(64);
    const Cage::Seams* const before = std::exchange(previous, &seams);
    if (before != nullptr && are_alike(*before, seams, pace)) {
      nets_.push_back(nets_.back());
      continue;
    }
    if (is_as_mesh(cage, points.topology(), seams.corner_values, seams.value_count, pace)) {
      nets_.push_back(nets_.front());
      continue;
    }
    if (vertices.empty()) vertices = vertices_with_faces(points.topology(), pace);
    Channel channel = make_channel(cage, method, points.shared_topology(), points.sharpness(), vertices,
                                   corner_values(cage, seams, pace), seams.value_count, pace);
    nets_.push_back(std::make_shared<const Net>(Net::build(nets_[0], std::move(channel), pace)));
  }
}

std::shared_ptr<const Connectivity<Triangles>> Plan::connectivity_of(const RenderMesh& render,
                                                                     const Pace& pace) const {
  const Index faces = net().topology().face_count();
  const bool is_whole = render.face_end - render.face_begin == faces && output_faces_ == faces;
  for (std::size_t k = 0; is_whole && k < nets_.size(); ++k) {
    pace.spend(4);
    if (connects_alike(nets_[k]->topology(), render, pace)) return nets_[k]->shared_topology();
  }
  std::vector<Index> indices;
  pace.copy(render.indices, indices);
  return std::make_shared<const Connectivity<Triangles>>(render.vertex_count, Triangles(std::move(indices)),
                                                         pace);
}

void Plan::add_render_meshes(const Cage& cage, const Pace& pace) {
  render_meshes_.reserve(cage.render_meshes.size());
  for (const RenderMesh& render : cage.render_meshes) {
    pace.spend(64);
    render_meshes_.push_back(connectivity_of(render, pace));
  }
}

LevelCounts Plan::counts(Index level) const {
  const Topology<Triangles>& topology = net().topology();
  LevelCounts counts =
      refined_counts(topology.vertex_count(), topology.edge_count(), topology.face_count(), level);
  counts.triangles = output_faces_ * triangles_per_face(level);
  return counts;
}

}  // namespace subdivd

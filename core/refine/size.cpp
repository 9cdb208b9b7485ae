#include <algorithm>
#include <string>
#include <string_view>

#include "core/base/pace.h"
#include "core/refine/refine.h"

namespace subdivd {
namespace {

Result<void> check_count(std::string_view what, Count predicted) {
  if (predicted <= kMaxIndexCount) return {};
  return Error{.code = ErrorCode::too_large,
               .message = "the level would make " + std::to_string(predicted) + " " + std::string(what) +
                          "; 32-bit indices number " + std::to_string(kMaxIndexCount) +
                          ": choose a lower level or split the mesh",
               .predicted = predicted,
               .allowed = kMaxIndexCount};
}

// Per crease point while nets are built; per value of a channel while it is numbered; and of objects, of which there
// may be a hundred thousand, whatever they hold.
constexpr Count kCreaseBytesPerPoint = 32, kValueBytes = 16, kBytesPerPrimvar = 512,
                kBytesPerRenderMesh = 512, kBytesPerSource = 64, kBytesPerRenderCorner = 45;

// What refine() needs beside its answer: the nets one after the other, then values one after the other.
template <class Real>
Count working_bytes(const ControlMesh& mesh, const RefineOptions& options, const Plan& plan,
                    const Pace& pace) {
  const bool limits = options.limit || options.tangents || options.normals;
  Count resident = 0, building = 0, evaluation = 0;
  const auto evaluation_of = [&](const Refinable& part, Count width) {
    return part.evaluation_bytes(options.level, static_cast<Index>(width), sizeof(Real), limits, pace);
  };
  const auto add_part = [&](const Refinable& part, Count width) {
    resident += part.resident_bytes();
    building = std::max(building, part.building_bytes());
    evaluation = std::max(evaluation, evaluation_of(part, width));
  };
  add_part(plan.mesh(), 3);
  if (!mesh.crease_lengths.empty())
    building += kCreaseBytesPerPoint * mesh.crease_indices.size() + 12 * mesh.point_count();
  std::size_t channel = 0;
  for (const Primvar& primvar : mesh.primvars) {
    pace.spend(64);
    resident += kBytesPerPrimvar;
    if (primvar.interpolation == Interpolation::face_varying) {
      const Refinable& part = plan.channel(channel++);
      add_part(part, primvar.element_size);
      building = std::max(building, part.building_bytes() + kValueBytes * part.value_count(0) +
                                        4 * mesh.face_vertex_indices.size() + 4 * mesh.point_count());
    } else if (primvar.interpolation == Interpolation::uniform) {
      evaluation = std::max(evaluation, plan.counts(options.level).faces * Count{sizeof(Index)});
    } else if (primvar.interpolation != Interpolation::constant) {
      evaluation = std::max(evaluation, evaluation_of(plan.mesh(), primvar.element_size));
    }
  }
  for (const RenderMesh& render : mesh.render_meshes) {
    const Count faces = render.face_end - render.face_begin, corners = render.indices.size();
    resident += kBytesPerRenderMesh + kBytesPerSource * plan.channel_count() + faces +
                kBytesPerRenderCorner * corners;
    building = std::max(building, topology_building_bytes(render.vertex_count, corners));
  }
  return resident + std::max(building, evaluation);
}

template <class Real>
Result<RefinedSize> size_of_refined(const ControlMesh& mesh, const RefineOptions& options, const Plan& plan,
                                    const Pace& pace) {
  RefinedSize size;
  size.counts = plan.counts(options.level);
  size.corners = plan.corner_count(options.level);
  if (auto fits = check_count("vertices", size.counts.vertices); !fits) return std::move(fits).error();
  const Lattice& lattice = *plan.mesh().lattice();
  if (auto fits = check_count("face corners", lattice.corner_count(options.level)); !fits)
    return std::move(fits).error();

  const Count indices = options.connectivity ? sizeof(Index) * size.corners : 0;
  const Count vectors = 1 + Count{options.limit} + 2 * Count{options.tangents} + Count{options.normals};
  size.bytes = size.counts.vertices * 3 * vectors * sizeof(Real) + indices;
  if (options.connectivity && lattice.face_size(options.level) == 0)
    size.bytes += sizeof(Index) * size.counts.faces;
  if (options.provenance)
    size.bytes += size.counts.vertices * sizeof(Provenance) + size.counts.faces * sizeof(Index);
  std::size_t channel = 0;
  for (const Primvar& primvar : mesh.primvars) {
    pace.spend(16);
    Count values = 1;
    bool has_limit = false;
    switch (primvar.interpolation) {
      case Interpolation::constant:
        break;
      case Interpolation::uniform:
        values = size.counts.faces;
        break;
      case Interpolation::varying:
        values = size.counts.vertices;
        break;
      case Interpolation::vertex:
        values = size.counts.vertices;
        has_limit = options.limit;
        break;
      case Interpolation::face_varying:
        values = plan.channel(channel++).value_count(options.level);
        if (auto fits = check_count("values of a face-varying primvar", values); !fits)
          return std::move(fits).error();
        size.channel_values.push_back(values);
        size.bytes += indices;
        has_limit = options.limit;
        break;
    }
    size.bytes += values * primvar.element_size * sizeof(Real) * (has_limit ? 2 : 1);
  }
  for (std::size_t k = 0; k < mesh.render_meshes.size(); ++k) {
    pace.spend(64);
    const std::shared_ptr<const Lattice>& render = plan.render_lattice(k);
    const Count vertices = render->vertex_count(options.level);
    if (auto fits = check_count("render vertices", vertices); !fits) return std::move(fits).error();
    size.render_vertices.push_back(vertices);
    const RenderMesh& faces = mesh.render_meshes[k];
    const auto holes = plan.holes().subspan(faces.face_begin, faces.face_end - faces.face_begin);
    size.render_triangles.push_back(render->triangle_count(options.level, holes, pace));
    if (auto fits = check_count("triangle corners", 3 * size.render_triangles.back()); !fits)
      return std::move(fits).error();
    Count sources = render != plan.mesh().lattice();
    for (std::size_t c = 0; c < plan.channel_count(); ++c) sources += render != plan.channel(c).lattice();
    size.bytes += vertices * sizeof(Index) * sources;
  }
  size.working_bytes = working_bytes<Real>(mesh, options, plan, pace);
  return size;
}

}  // namespace

template <class Real>
Result<RefinedSize> predict_size(const ControlMesh& mesh, const Plan& plan, const RefineOptions& options,
                                 const Budget& budget) {
  if (auto allowed = check_level(options.level); !allowed) return std::move(allowed).error();
  return stoppable(budget,
                   [&](const Pace& pace) { return size_of_refined<Real>(mesh, options, plan, pace); });
}

template <class Real>
Result<RefinedSize> predict_size(const ControlMesh& mesh, const RefineOptions& options,
                                 const Budget& budget) {
  if (auto allowed = check_level(options.level); !allowed) return std::move(allowed).error();
  const auto scheme =
      stoppable(budget, [&](const Pace& pace) { return scheme_of(mesh, options.schemes, pace); });
  if (!scheme) return scheme.error();
  // Grids need no level to know what it would take; rows of steps are counted when they stand.
  const bool by_steps = as_one_of<AnyInterpolatingScheme>(*scheme).has_value();
  const auto plan = Plan::build(
      mesh, by_steps ? plan_options(options) : PlanOptions{options.schemes, options.crease_method, 0},
      budget);
  if (!plan) return plan.error();
  return predict_size<Real>(mesh, *plan, options, budget);
}

template Result<RefinedSize> predict_size<float>(const ControlMesh&, const Plan&, const RefineOptions&,
                                                 const Budget&);
template Result<RefinedSize> predict_size<double>(const ControlMesh&, const Plan&, const RefineOptions&,
                                                  const Budget&);
template Result<RefinedSize> predict_size<float>(const ControlMesh&, const RefineOptions&, const Budget&);
template Result<RefinedSize> predict_size<double>(const ControlMesh&, const RefineOptions&, const Budget&);

}  // namespace subdivd

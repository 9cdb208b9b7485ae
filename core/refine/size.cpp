#include "core/refine/size.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "core/base/pace.h"
#include "core/refine/render_mesh.h"

namespace subdivd {
namespace {

Result<void> check_count(std::string_view what, Count predicted) {
  if (predicted <= kMaxIndexCount) return {};
  return Error{ErrorCode::too_large,
               "the level would make " + std::to_string(predicted) + " " + std::string(what) +
                   "; 32-bit indices number " + std::to_string(kMaxIndexCount) +
                   ": choose a lower level or split the mesh",
               {},
               predicted,
               kMaxIndexCount};
}

template <class Real>
Result<RefinedSize> measured(const ControlMesh& mesh, const RefineOptions& options, const Plan& plan,
                             const Pace& pace) {
  RefinedSize size;
  size.counts = plan.counts(options.level);
  if (auto fits = check_count("vertices", size.counts.vertices); !fits) return std::move(fits).error();
  const Count all_triangles = Count{plan.mesh().topology().face_count()} << (2 * options.level);
  if (auto fits = check_count("triangle corners", 3 * all_triangles); !fits) return std::move(fits).error();

  const Count indices = options.connectivity ? 3 * sizeof(Index) * size.counts.triangles : 0;
  const Count vectors = 1 + Count{options.limit} + 2 * Count{options.tangents} + Count{options.normals};
  size.bytes = size.counts.vertices * 3 * vectors * sizeof(Real) + indices;
  if (options.provenance)
    size.bytes += size.counts.vertices * sizeof(Provenance) + size.counts.triangles * sizeof(Index);
  std::size_t channel = 0;
  for (const Primvar& primvar : mesh.primvars) {
    pace.spend(16);
    Count values = 1;
    bool has_limit = false;
    switch (primvar.interpolation) {
      case Interpolation::constant:
        break;
      case Interpolation::uniform:
        values = size.counts.triangles;
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
  for (const RenderMesh& render : mesh.render_meshes) {
    pace.spend(64);
    const Count vertices = count_render_vertices(render, options.level, pace);
    if (auto fits = check_count("render vertices", vertices); !fits) return std::move(fits).error();
    const auto faces =
        std::ranges::count(plan.holes().subspan(render.face_begin, render.face_end - render.face_begin), 0);
    size.render_vertices.push_back(vertices);
    size.bytes += vertices * sizeof(Index) * (1 + plan.channel_count()) +
                  3 * sizeof(Index) * (static_cast<Count>(faces) << (2 * options.level));
  }
  return size;
}

}  // namespace

Result<void> check_level(Index level) {
  if (level <= kMaxLevel) return {};
  return Error{
      ErrorCode::out_of_range, "level must be 0 to " + std::to_string(kMaxLevel), {}, level, kMaxLevel};
}

template <class Real>
Result<RefinedSize> size_of(const ControlMesh& mesh, const RefineOptions& options, const Plan& plan,
                            const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) { return measured<Real>(mesh, options, plan, pace); });
}

template <class Real>
Result<RefinedSize> predict_size(const ControlMesh& mesh, const RefineOptions& options,
                                 const Budget& budget) {
  if (auto allowed = check_level(options.level); !allowed) return std::move(allowed).error();
  const auto plan = Plan::build(mesh, {options.loop_weights, options.crease_method, 0}, budget);
  if (!plan) return plan.error();
  return size_of<Real>(mesh, options, *plan, budget);
}

template Result<RefinedSize> size_of<float>(const ControlMesh&, const RefineOptions&, const Plan&,
                                            const Budget&);
template Result<RefinedSize> size_of<double>(const ControlMesh&, const RefineOptions&, const Plan&,
                                             const Budget&);
template Result<RefinedSize> predict_size<float>(const ControlMesh&, const RefineOptions&, const Budget&);
template Result<RefinedSize> predict_size<double>(const ControlMesh&, const RefineOptions&, const Budget&);

}  // namespace subdivd

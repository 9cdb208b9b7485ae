#include "core/refine/control.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>

#include "core/refine/render_mesh.h"

namespace subdivd {
namespace {

std::vector<Index> corner_values(const ControlMesh& mesh, const Primvar& primvar) {
  if (!primvar.indices.empty()) return primvar.indices;
  std::vector<Index> corners(mesh.face_vertex_indices.size());
  std::iota(corners.begin(), corners.end(), Index{0});
  return corners;
}

LevelCounts counts_of(const Topology& topology, Index level) {
  return refined_counts(topology.vertex_count(), topology.edge_count(), topology.face_count(), level);
}

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

}  // namespace

Control make_control(const ControlMesh& mesh, CreaseMethod method) {
  Control control;
  control.topology = Topology(static_cast<Index>(mesh.point_count()), mesh.face_vertex_indices);
  control.sharpness = control_sharpness(mesh, control.topology);
  control.holes = hole_flags(mesh, control.topology);
  for (const Primvar& primvar : mesh.primvars)
    if (primvar.interpolation == Interpolation::face_varying)
      control.channels.push_back(
          make_channel(mesh, method, control.topology, control.sharpness, corner_values(mesh, primvar),
                       static_cast<Index>(primvar.values.size() / primvar.element_size)));
  return control;
}

template <class Real>
Result<RefinedSize> size_of(const ControlMesh& mesh, const RefineOptions& options, const Control& control) {
  if (options.level > kMaxLevel)
    return Error{ErrorCode::out_of_range,
                 "level must be 0 to " + std::to_string(kMaxLevel),
                 {},
                 options.level,
                 kMaxLevel};
  RefinedSize size;
  size.counts = counts_of(control.topology, options.level);
  if (auto fits = check_count("vertices", size.counts.vertices); !fits) return std::move(fits).error();
  if (auto fits = check_count("triangle corners", 3 * size.counts.triangles); !fits)
    return std::move(fits).error();
  size.counts.triangles = static_cast<Count>(std::ranges::count(control.holes, 0)) << (2 * options.level);

  const Count vectors = 1 + Count{options.limit} + 2 * Count{options.tangents} + Count{options.normals};
  size.bytes = size.counts.vertices * (3 * vectors * sizeof(Real) + sizeof(Provenance)) +
               size.counts.triangles * 4 * sizeof(Index);
  std::size_t channel = 0;
  for (const Primvar& primvar : mesh.primvars) {
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
        values = counts_of(control.channels[channel++].topology, options.level).vertices;
        if (auto fits = check_count("values of a face-varying primvar", values); !fits)
          return std::move(fits).error();
        size.channel_values.push_back(values);
        size.bytes += 3 * sizeof(Index) * size.counts.triangles;
        has_limit = options.limit;
        break;
    }
    size.bytes += values * primvar.element_size * sizeof(Real) * (has_limit ? 2 : 1);
  }
  for (const RenderMesh& render : mesh.render_meshes) {
    const Count vertices = count_render_vertices(render, options.level);
    if (auto fits = check_count("render vertices", vertices); !fits) return std::move(fits).error();
    const auto faces =
        std::count(control.holes.begin() + render.face_begin, control.holes.begin() + render.face_end, 0);
    size.render_vertices.push_back(vertices);
    size.bytes +=
        vertices * sizeof(Index) + 3 * sizeof(Index) * (static_cast<Count>(faces) << (2 * options.level));
  }
  return size;
}

template <class Real>
Result<RefinedSize> predict_size(const ControlMesh& mesh, const RefineOptions& options) {
  return size_of<Real>(mesh, options, make_control(mesh, options.crease_method));
}

template Result<RefinedSize> size_of<float>(const ControlMesh&, const RefineOptions&, const Control&);
template Result<RefinedSize> size_of<double>(const ControlMesh&, const RefineOptions&, const Control&);
template Result<RefinedSize> predict_size<float>(const ControlMesh&, const RefineOptions&);
template Result<RefinedSize> predict_size<double>(const ControlMesh&, const RefineOptions&);

}  // namespace subdivd

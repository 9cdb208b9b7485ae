#include <algorithm>
#include <string>
#include <string_view>

#include "core/base/pace.h"
#include "core/lattice/numbering.h"
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

// The two levels below the last, the control values, and what is semi-sharp along edges under Chaikin's rule.
template <class Real>
Count evaluation_bytes(const Net& net, const RefineOptions& options, Count width) {
  const Index level = options.level;
  Count values = net.value_count(0);
  for (Index below = 1; below <= 2 && below < level; ++below) values += net.value_count(level - below);
  return values * width * sizeof(Real) + net.topology().edge_count();
}

// Per semi-sharp edge and crease point while nets are built; per value of a channel while it is numbered; and
// of objects, of which there may be a hundred thousand, whatever they hold.
constexpr Count kSemiSharpBytes = 64, kCreaseBytesPerPoint = 32, kValueBytes = 16, kBytesPerPrimvar = 512,
                kBytesPerRenderMesh = 512, kBytesPerSource = 64, kBytesPerRenderFace = 136;

// While the ring of a hub is looked at, which is as large as the mesh.
constexpr Count kHub = 4096, kBytesPerRingCorner = 176;

Count ring_bytes(const Topology<Triangles>& topology, const Pace& pace) {
  Count corners = 0;
  pace.for_each(topology.vertex_count(), [&](Index v) {
    if (const Count here = topology.vertex_corners(v).size(); here > kHub) corners += here;
  });
  return corners * kBytesPerRingCorner;
}

// What refine() needs beside its answer: the nets one after the other, then values one after the other.
template <class Real>
Count working_bytes(const ControlMesh& mesh, const RefineOptions& options, const Plan& plan,
                    const Pace& pace) {
  const bool limits = options.limit || options.tangents || options.normals;
  const Count rings_of_mesh = limits ? ring_bytes(plan.net().topology(), pace) : 0;
  Count resident = 0, building = 0, evaluation = 0;
  const auto add_net = [&](const Net& net, Count width) {
    resident += net.resident_bytes();
    if (options.crease_method == CreaseMethod::chaikin)
      resident += chaikin_bytes(net.semi_sharp(0).edges.size(), std::max(net.max_level(), options.level));
    building = std::max(building, net.building_bytes() + kSemiSharpBytes * net.semi_sharp(0).edges.size());
    evaluation = std::max(evaluation, evaluation_bytes<Real>(net, options, width) +
                                          (limits ? ring_bytes(net.topology(), pace) : 0));
  };
  add_net(plan.net(), 3);
  if (!mesh.crease_lengths.empty())
    building += kCreaseBytesPerPoint * mesh.crease_indices.size() + 12 * mesh.point_count();
  std::size_t channel = 0;
  for (const Primvar& primvar : mesh.primvars) {
    pace.spend(64);
    resident += kBytesPerPrimvar;
    if (primvar.interpolation == Interpolation::face_varying) {
      add_net(plan.channel_net(channel++), primvar.element_size);
      building = std::max(building, plan.channel_net(channel - 1).building_bytes() +
                                        kValueBytes * plan.channel_net(channel - 1).value_count(0) +
                                        4 * mesh.face_vertex_indices.size() + 4 * mesh.point_count());
    } else if (primvar.interpolation == Interpolation::uniform) {
      evaluation = std::max(evaluation, plan.counts(options.level).triangles * Count{sizeof(Index)});
    } else if (primvar.interpolation != Interpolation::constant) {
      evaluation = std::max(
          evaluation, evaluation_bytes<Real>(plan.net(), options, primvar.element_size) + rings_of_mesh);
    }
  }
  for (const RenderMesh& render : mesh.render_meshes) {
    const Count faces = render.face_end - render.face_begin;
    resident +=
        kBytesPerRenderMesh + kBytesPerSource * plan.channel_count() + (kBytesPerRenderFace + 1) * faces;
    building = std::max(building, topology_building_bytes(render.vertex_count, faces));
  }
  return resident + std::max(building, evaluation);
}

template <class Real>
Result<RefinedSize> size_of_refined(const ControlMesh& mesh, const RefineOptions& options, const Plan& plan,
                                    const Pace& pace) {
  RefinedSize size;
  size.counts = plan.counts(options.level);
  if (auto fits = check_count("vertices", size.counts.vertices); !fits) return std::move(fits).error();
  const Count all_triangles = plan.net().topology().face_count() * triangles_per_face(options.level);
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
        values = plan.channel_net(channel++).value_count(options.level);
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
    const Count vertices = Numbering(plan.render_mesh(k), options.level).vertex_count();
    if (auto fits = check_count("render vertices", vertices); !fits) return std::move(fits).error();
    size.render_vertices.push_back(vertices);
    const Connectivity<Triangles>& connectivity = plan.render_mesh(k);
    Count sources = &connectivity != &plan.net().topology();
    for (std::size_t c = 0; c < plan.channel_count(); ++c)
      sources += &connectivity != &plan.channel_net(c).topology();
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
  const auto plan = Plan::build(mesh, {options.schemes, options.crease_method, 0}, budget);
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

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/refine/refine.h"
#include "core/refine/split.h"
#include "proto/json/json.h"
#include "proto/options.h"

namespace subdivd::proto::json {
namespace {

using Json = nlohmann::ordered_json;

// Edges of the control mesh. The number of refined points tells it without finding every edge again, which
// would take longer than writing the answer; 0 points: there is no refined mesh.
std::optional<Count> edge_count(const ControlMesh& mesh, Index level, Count refined_points) {
  if (level > 0 && refined_points > 0) {
    const Count on_edge = (Count{1} << level) - 1;  // points inside each
    const Count without = refined_counts(mesh.point_count(), 0, mesh.face_count(), level).vertices;
    return (refined_points - without) / on_edge;
  }
  const auto size = predict_size<float>(mesh, {.level = 0});
  if (!size) return {};
  return size->counts.edges;
}

// Holes count here: they are refined, too.
Json mesh_levels(const ControlMesh& mesh, Index level, Count refined_points) {
  Json levels = Json::array();
  const std::optional<Count> edges = edge_count(mesh, level, refined_points);
  if (!edges) return levels;
  for (Index l = 0; l <= level; ++l) {
    const LevelCounts counts = refined_counts(mesh.point_count(), *edges, mesh.face_count(), l);
    levels.push_back({{"level", l},
                      {"vertices", counts.vertices},
                      {"edges", counts.edges},
                      {"triangles", counts.triangles}});
  }
  return levels;
}

Json curve_levels(const ControlCurves& curves, Index level) {
  Json levels = Json::array();
  for (Index l = 0; l <= level; ++l) {
    levels.push_back({{"level", l}, {"points", total_point_count(curves, l)}});
  }
  return levels;
}

Json mesh_statistics(const ControlMesh& mesh, Index level, Count refined_points) {
  Json json;
  if (!mesh.name.empty()) json["name"] = mesh.name;
  json["input"] = {{"points", mesh.point_count()}, {"faces", mesh.face_count()}};
  json["levels"] = mesh_levels(mesh, level, refined_points);
  return json;
}

Json curve_statistics(const ControlCurves& curves, Index level) {
  Json json;
  if (!curves.name.empty()) json["name"] = curves.name;
  json["input"] = {{"points", curves.point_count()},
                   {"curves", curves.vertex_counts.empty() ? 1 : curves.vertex_counts.size()}};
  json["levels"] = curve_levels(curves, level);
  return json;
}

Json surface_statistics(const ControlPatch& surface, Index level) {
  const auto counts = [&](Index l) {
    const Count u = refined_grid_count(surface.u_wrap, surface.u_degree, surface.u_count, l);
    const Count v = refined_grid_count(surface.v_wrap, surface.v_degree, surface.v_count, l);
    return Json{{"uVertexCount", u}, {"vVertexCount", v}, {"points", u * v}};
  };
  Json json;
  if (!surface.name.empty()) json["name"] = surface.name;
  json["input"] = counts(0);
  for (Index l = 0; l <= level; ++l) {
    Json one = {{"level", l}};
    one.update(counts(l));
    json["levels"].push_back(std::move(one));
  }
  return json;
}

// `refined_points`: of every mesh; empty when nothing was refined.
Json statistics(const RefineRequest& request, const std::vector<Count>& refined_points) {
  Json json = Json::object();
  const Index level = request.options.level;
  for (std::size_t i = 0; i < request.meshes.size(); ++i)
    json["meshes"].push_back(
        mesh_statistics(request.meshes[i], level, i < refined_points.size() ? refined_points[i] : 0));
  for (const ControlCurves& curves : request.curves)
    json["curves"].push_back(curve_statistics(curves, level));
  for (const ControlPatch& surface : request.surfaces)
    json["surfaces"].push_back(surface_statistics(surface, level));
  return json;
}

template <class Real>
void add_outputs(Json& json, const RefineAnswer<Real>& answer) {
  for (std::size_t i = 0; i < answer.meshes.size() && i < json["meshes"].size(); ++i)
    json["meshes"][i]["output"] = {{"points", answer.meshes[i].points.size() / 3},
                                   {"triangles", answer.meshes[i].triangle_count}};
  for (std::size_t i = 0; i < answer.curves.size() && i < json["curves"].size(); ++i)
    json["curves"][i]["output"] = {{"points", answer.curves[i].points.size() / answer.curves[i].width}};
  for (std::size_t i = 0; i < answer.surfaces.size() && i < json["surfaces"].size(); ++i) {
    const RefinedPatch<Real>& surface = answer.surfaces[i];
    json["surfaces"][i]["output"] = {{"points", surface.points.size() / surface.width},
                                     {surface.corners_per_face == 4 ? "quads" : "triangles",
                                      surface.faces.size() / std::max<Index>(surface.corners_per_face, 1)}};
  }
}

Json warnings(const RefineRequest& request, bool refined) {
  Json texts = request.warnings;
  if (refined && request.input != Format::json && answer_format(request) == Format::json)
    texts.push_back(
        "a JSON answer holds geometry only: nodes, materials, textures and animations of the glTF are left "
        "out");
  if (!request.surfaces.empty() && request.options.faces == Faces::quads &&
      answer_faces(request) != Faces::quads)
    texts.push_back("glTF knows no quads: the faces of surfaces are triangles; take format json for quads");
  if (refined && request.options.normals &&
      std::ranges::any_of(request.surfaces, [](const ControlPatch& surface) { return surface.width != 3; }))
    texts.push_back("normals exist for surfaces of 3 numbers per point only; others get none");
  return texts;
}

// Everything but the verification, which is already text.
std::string assemble(const RefineRequest& request, const Json& numbers, bool refined,
                     const oracle::Report* verification) {
  std::string text = std::string("{\"options\":") + effective_options(request) +
                     ",\"statistics\":" + numbers.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (const Json texts = warnings(request, refined); !texts.empty())
    text += ",\"warnings\":" + texts.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (verification != nullptr) text += std::string(",\"verification\":") + report(*verification, &request);
  return text + '}';
}

}  // namespace

std::string envelope(const RefineRequest& request, const AnyAnswer& answer) {
  return std::visit(
      [&](const auto& typed) {
        std::vector<Count> points;
        for (const auto& mesh : typed.meshes) points.push_back(mesh.points.size() / 3);
        Json numbers = statistics(request, points);
        add_outputs(numbers, typed);
        const auto* verification = typed.verification ? &*typed.verification : nullptr;
        return assemble(request, numbers, true, verification);
      },
      answer);
}

std::string report_envelope(const RefineRequest& request, const oracle::Report& verification) {
  return assemble(request, statistics(request, {}), false, &verification);
}

}  // namespace subdivd::proto::json

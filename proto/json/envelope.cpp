#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/lattice/split.h"
#include "core/refine/refine.h"
#include "proto/json/json.h"
#include "proto/options.h"

namespace subdivd::proto::json {
namespace {

using Json = nlohmann::ordered_json;

// Edges of the control mesh. The number of refined points tells it without finding every edge again, which
// would take longer than writing the answer; 0 points: there is no refined mesh. Nothing when they cannot be
// numbered.
Result<std::optional<Count>> edge_count(const ControlMesh& mesh, Index level, Count refined_points,
                                        const Budget& budget) {
  if (level > 0 && refined_points > 0) {
    const Count on_edge = (Count{1} << level) - 1;  // points inside each
    const Count without = refined_counts(mesh.point_count(), 0, mesh.face_count(), level).vertices;
    return std::optional((refined_points - without) / on_edge);
  }
  Budget counting = budget;
  counting.max_bytes = std::numeric_limits<Count>::max();  // no mesh comes out
  const auto size = predict_size<float>(mesh, {.level = 0}, counting);
  if (size) return std::optional(size->counts.edges);
  if (size.error().code == ErrorCode::too_large) return std::optional<Count>();
  return size.error();
}

// Holes count here: they are refined, too.
Result<Json> mesh_levels(const ControlMesh& mesh, Index level, Count refined_points, const Budget& budget) {
  Json levels = Json::array();
  const auto counted = edge_count(mesh, level, refined_points, budget);
  if (!counted) return counted.error();
  const std::optional<Count> edges = *counted;
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

Result<Json> mesh_statistics(const ControlMesh& mesh, Index level, Count refined_points,
                             const Budget& budget) {
  auto levels = mesh_levels(mesh, level, refined_points, budget);
  if (!levels) return levels;
  Json json;
  if (!mesh.name.empty()) json["name"] = mesh.name;
  json["input"] = {{"points", mesh.point_count()}, {"faces", mesh.face_count()}};
  json["levels"] = *std::move(levels);
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

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

// Part by part: as one tree the numbers of many meshes would take ten times their text.
class StatisticsWriter {
 public:
  StatisticsWriter(const RefineRequest& request, const Budget& budget) : request_(request), budget_(budget) {}

  // `answer` null: nothing was refined.
  template <class Real>
  Result<std::string> write(const RefineAnswer<Real>* answer) {
    const Index level = request_.options.level;
    text_ = "{";
    const auto refined = [&](std::size_t i) {
      const bool known = answer != nullptr && i < answer->meshes.size();
      return known ? answer->meshes[i].points.size() / 3 : 0;
    };
    add("meshes", request_.meshes.size(), [&](std::size_t i) {
      auto counted = mesh_statistics(request_.meshes[i], level, refined(i), budget_);
      if (!counted) stopped_ = counted.error();
      Json json = counted ? *std::move(counted) : Json();
      if (answer != nullptr && i < answer->meshes.size())
        json["output"] = {{"points", answer->meshes[i].points.size() / 3},
                          {"triangles", answer->meshes[i].triangle_count}};
      return json;
    });
    add("curves", request_.curves.size(), [&](std::size_t i) {
      Json json = curve_statistics(request_.curves[i], level);
      if (answer != nullptr && i < answer->curves.size())
        json["output"] = {{"points", answer->curves[i].points.size() / answer->curves[i].width}};
      return json;
    });
    add("surfaces", request_.surfaces.size(), [&](std::size_t i) {
      Json json = surface_statistics(request_.surfaces[i], level);
      if (answer != nullptr && i < answer->surfaces.size()) {
        const RefinedPatch<Real>& surface = answer->surfaces[i];
        json["output"] = {{"points", surface.points.size() / surface.width},
                          {surface.corners_per_face == 4 ? "quads" : "triangles",
                           surface.faces.size() / std::max<Index>(surface.corners_per_face, 1)}};
      }
      return json;
    });
    if (stopped_) return *stopped_;
    return text_ + '}';
  }

 private:
  template <class One>
  void add(const char* name, std::size_t count, One one) {
    if (count == 0) return;
    if (text_.size() > 1) text_ += ',';
    text_.append("\"").append(name).append("\":[");
    for (std::size_t i = 0; i < count && !stopped_; ++i) {
      if (i > 0) text_ += ',';
      text_ += dumped(one(i));
      if (!stopped_) stopped_ = budget_.poll();
    }
    text_ += ']';
  }

  const RefineRequest& request_;
  const Budget& budget_;
  std::string text_;
  std::optional<Error> stopped_;
};

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
Result<std::string> assemble(const RefineRequest& request, Result<std::string> numbers, bool refined,
                             const oracle::Report* verification, const Budget& budget) {
  if (!numbers) return numbers;
  std::string text =
      std::string("{\"options\":") + effective_options(request) + ",\"statistics\":" + *numbers;
  if (const Json texts = warnings(request, refined); !texts.empty()) text += ",\"warnings\":" + dumped(texts);
  if (verification != nullptr) text += std::string(",\"verification\":") + report(*verification, &request);
  if (auto stop = budget.poll()) return *stop;
  return text + '}';
}

}  // namespace

Result<std::string> envelope(const RefineRequest& request, const AnyAnswer& answer, const Budget& budget) {
  return std::visit(
      [&](const auto& typed) {
        const auto* verification = typed.verification ? &*typed.verification : nullptr;
        return assemble(request, StatisticsWriter(request, budget).write(&typed), true, verification, budget);
      },
      answer);
}

Result<std::string> report_envelope(const RefineRequest& request, const oracle::Report& verification,
                                    const Budget& budget) {
  constexpr const RefineAnswer<double>* kNothing = nullptr;
  return assemble(request, StatisticsWriter(request, budget).write(kNothing), false, &verification, budget);
}

}  // namespace subdivd::proto::json

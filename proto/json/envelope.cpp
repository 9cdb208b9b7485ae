#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/lattice/split.h"
#include "core/refine/refine.h"
#include "proto/json/json.h"
#include "proto/options.h"

namespace subdivd::proto::json {
namespace {

using Json = nlohmann::ordered_json;

// What there is at every level of a mesh that nothing was refined of; nothing when it cannot be numbered, or refined.
Result<std::vector<LevelCounts>> counted_levels(const ControlMesh& mesh, const Options& options,
                                                const Budget& budget) {
  Budget counting = budget;
  counting.max_bytes = std::numeric_limits<Count>::max();  // no mesh comes out
  const auto plan = Plan::build(mesh, {options.schemes, options.crease_method, 0}, counting);
  std::vector<LevelCounts> levels;
  if (!plan) {
    if (is_stop(plan.error())) return plan.error();
    return levels;
  }
  for (Index level = 0; level <= options.level; ++level)
    levels.push_back(plan->mesh().lattice()->counts(level));
  return levels;
}

std::string_view name_of_faces(Index face_size) {
  return face_size == 3 ? "triangles" : face_size == 4 ? "quads" : "faces";
}

// Holes count here: they are refined, too.
Json mesh_levels(std::span<const LevelCounts> counts) {
  Json levels = Json::array();
  for (std::size_t l = 0; l < counts.size(); ++l)
    levels.push_back({{"level", l},
                      {"vertices", counts[l].vertices},
                      {"edges", counts[l].edges},
                      {name_of_faces(counts[l].face_size), counts[l].faces}});
  return levels;
}

Json curve_levels(const ControlCurves& curves, Index level) {
  Json levels = Json::array();
  for (Index l = 0; l <= level; ++l) {
    levels.push_back({{"level", l}, {"points", total_point_count(curves, l)}});
  }
  return levels;
}

// `scheme`: empty where nothing was refined.
Json mesh_statistics(const ControlMesh& mesh, std::string_view scheme, std::span<const LevelCounts> levels) {
  Json json;
  if (!mesh.name.empty()) json["name"] = mesh.name;
  if (!scheme.empty()) json["subdivisionScheme"] = scheme;
  json["input"] = {{"points", mesh.point_count()}, {"faces", mesh.face_count()}};
  json["levels"] = mesh_levels(levels);
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
    add("meshes", request_.meshes.size(), [&](std::size_t i) {
      if (answer != nullptr && i < answer->meshes.size()) {
        const RefinedMesh<Real>& refined = answer->meshes[i];
        Json json = mesh_statistics(request_.meshes[i], refined.scheme, refined.levels);
        json["output"] = {{"points", refined.points.size() / 3},
                          {name_of_faces(refined.face_size), refined.face_count}};
        return json;
      }
      const auto levels = counted_levels(request_.meshes[i], request_.options, budget_);
      if (!levels) stopped_ = levels.error();
      return levels ? mesh_statistics(request_.meshes[i], {}, *levels) : Json();
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

std::vector<std::string> warnings(const RefineRequest& request, bool refined) {
  std::vector<std::string> texts = request.warnings;
  if (refined && request.input != Format::json && !is_gltf(answer_format(request)))
    texts.emplace_back(
        "the answer holds geometry only: nodes, materials, textures and animations of the glTF are left out");
  if (refined && !request.material_libraries.empty() && answer_format(request) != Format::obj)
    texts.emplace_back(
        "the names of the OBJ's material libraries are left out; an answer of format obj has them");
  if (!(request.surfaces.empty() && request.meshes.empty()) && request.options.faces == Faces::quads &&
      answer_faces(request) != Faces::quads)
    texts.emplace_back(
        "glTF knows no quads: all faces are triangles; take another format for quads, or ngons to mark which "
        "triangles of a mesh make one");
  if (refined && request.options.normals &&
      std::ranges::any_of(request.surfaces, [](const ControlPatch& surface) { return surface.width != 3; }))
    texts.emplace_back("normals exist for surfaces of 3 numbers per point only; others get none");
  return texts;
}

// Everything but the verification, which is already text.
Result<std::string> assemble(const RefineRequest& request, Result<std::string> numbers, bool refined,
                             const oracle::Report* verification, const Budget& budget) {
  if (!numbers) return numbers;
  std::string text =
      std::string("{\"options\":") + effective_options(request) + ",\"statistics\":" + *numbers;
  if (const auto texts = warnings(request, refined); !texts.empty()) text += ",\"warnings\":" + dumped(texts);
  if (verification != nullptr) text += std::string(",\"verification\":") + report(*verification, &request);
  if (auto stop = budget.poll()) return *stop;
  return text + '}';
}

}  // namespace

std::vector<std::string> answer_warnings(const RefineRequest& request) { return warnings(request, true); }

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

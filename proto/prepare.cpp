#include "proto/prepare.h"

#include <cfloat>
#include <cmath>
#include <utility>

#include "core/mesh/repair.h"
#include "core/mesh/scan.h"
#include "proto/json/locate.h"
#include "proto/suggest.h"

namespace subdivd::proto {
namespace {

std::string label(const char* kind, std::size_t i, const std::string& name) {
  return std::string(kind) + ' ' + std::to_string(i) +
         (name.empty() ? "" : std::string(" (") + in_quotes(name) + ')');
}

// "points[17]" of {"points", 17}: the core's messages say what is wrong, this says with what.
std::string subject(const Path& where) {
  std::string text;
  for (const PathStep& step : where) {
    if (const auto* name = std::get_if<std::string>(&step)) {
      if (!text.empty()) text += '.';
      text += name->substr(0, 64);
    } else {
      text += '[';
      text += std::to_string(std::get<std::uint64_t>(step));
      text += ']';
    }
  }
  return text;
}

void warn_of_dropped(RefineRequest& request, std::size_t i, const json::FaceHistory& history,
                     std::size_t faces_before) {
  Index first = 0;
  while (first < history.kept.size() && history.kept[first] == first) ++first;
  const Index original = history.triangulated.empty() ? first : history.triangulated[first];
  const std::size_t dropped = faces_before - history.kept.size();
  request.warnings.push_back(label("mesh", i, request.meshes[i].name) + ": " + std::to_string(dropped) +
                             (dropped == 1 ? " face repeats a vertex and was left out: face "
                                           : " faces repeat a vertex and were left out, the first is face ") +
                             std::to_string(original));
}

Result<void> repair_and_check(RefineRequest& request, std::size_t i, json::FaceHistory& history,
                              const Budget& budget) {
  ControlMesh& mesh = request.meshes[i];
  history.counts = mesh.face_vertex_counts;
  if (request.options.triangulate) {
    Result<std::vector<Index>> split = triangulate(mesh, budget);
    if (!split) return std::move(split).error();
    history.triangulated = std::move(*split);
  }
  if (mesh.check(budget)) return {};  // most meshes need no repair, and are looked at once
  const std::size_t faces = mesh.face_count();
  Result<std::vector<Index>> kept = drop_degenerate_faces(mesh, budget);
  if (!kept) return std::move(kept).error();
  history.kept = std::move(*kept);
  if (!history.kept.empty()) warn_of_dropped(request, i, history, faces);
  return mesh.check(budget);
}

// What single precision cannot hold would come out infinite.
Result<void> check_fits(const std::vector<double>& values, const Path& where) {
  if (all_within(values, FLT_MAX)) return {};
  for (std::size_t k = 0; k < values.size(); ++k)
    if (std::fabs(values[k]) > FLT_MAX) {
      Path place = where;
      place.emplace_back(std::uint64_t{k});
      return Error{ErrorCode::out_of_range,
                   "this is too large for single precision; take precision double or scale it down",
                   std::move(place), 0, 0};
    }
  return {};
}

Result<void> prepare_mesh(RefineRequest& request, std::size_t i, const Budget& budget) {
  json::FaceHistory history;
  Result<void> fine = repair_and_check(request, i, history, budget);
  if (fine)
    fine = answer_precision(request) == Precision::single_precision
               ? check_magnitudes<float>(request.meshes[i], budget)
               : check_magnitudes<double>(request.meshes[i], budget);
  if (history.changed()) {
    request.face_origins.resize(request.meshes.size());
    request.face_origins[i] = history.original_faces();
  }
  if (fine) return {};
  Error error = std::move(fine).error();
  if (const std::string what = subject(error.where); !what.empty())
    error.message = what + ": " + error.message;
  if (request.input == Format::json)
    error.where = json::locate(std::move(error.where), request.meshes[i], request.mesh_forms[i], history);
  return blame_input(request, std::move(error), "meshes", i);
}

Result<void> prepare_curves(RefineRequest& request, std::size_t i, const Budget& budget) {
  const ControlCurves& curves = request.curves[i];
  Result<void> fine = curves.check(budget);
  if (fine && answer_precision(request) == Precision::single_precision) {
    fine = check_fits(curves.points, {"points"});
    // As check() does: the point, not the scalar.
    if (!fine) std::get<std::uint64_t>(fine.error().where.back()) /= curves.width;
  }
  if (fine) return {};
  Error error = std::move(fine).error();
  if (request.input == Format::json)
    error.where = json::locate(std::move(error.where), curves, request.curve_forms[i]);
  return blame_input(request, std::move(error), "curves", i);
}

// The core's places of a surface are the wire's.
Result<void> prepare_surface(RefineRequest& request, std::size_t i, const Budget& budget) {
  const ControlPatch& surface = request.surfaces[i];
  Result<void> fine = surface.check(budget);
  if (fine && answer_precision(request) == Precision::single_precision)
    fine = check_fits(surface.points, {"points"});
  if (fine) return {};
  Error error = std::move(fine).error();
  if (error.where.size() == 2) {  // a number among the points
    const std::uint64_t scalar = std::get<std::uint64_t>(error.where[1]);
    if (request.surface_forms[i] == ArrayForm::nested)
      error.where = {"points", scalar / surface.width, scalar % surface.width};
  }
  return blame_input(request, std::move(error), "surfaces", i);
}

}  // namespace

Error blame_input(const RefineRequest& request, Error error, const char* of, std::size_t i) {
  const std::string_view kind = of;
  if (request.input != Format::json) {
    // A glTF body holds no surfaces.
    const bool mesh = kind == "meshes";
    const std::string& name = mesh ? request.meshes[i].name : request.curves[i].name;
    error.message = label(mesh ? "mesh" : "curve", i, name) + ": " + error.message;
    error.where.clear();
    return error;
  }
  const bool at_top = kind == "meshes"   ? request.single_mesh_at_top
                      : kind == "curves" ? request.single_curve_at_top
                                         : request.single_surface_at_top;
  if (at_top) return error;
  Path where = {of, std::uint64_t{i}};
  where.insert(where.end(), error.where.begin(), error.where.end());
  error.where = std::move(where);
  return error;
}

Result<void> prepare(RefineRequest& request, const Budget& budget) {
  for (std::size_t i = 0; i < request.meshes.size(); ++i)
    if (Result<void> fine = prepare_mesh(request, i, budget); !fine) return fine;
  for (std::size_t i = 0; i < request.curves.size(); ++i)
    if (Result<void> fine = prepare_curves(request, i, budget); !fine) return fine;
  for (std::size_t i = 0; i < request.surfaces.size(); ++i)
    if (Result<void> fine = prepare_surface(request, i, budget); !fine) return fine;
  return {};
}

}  // namespace subdivd::proto

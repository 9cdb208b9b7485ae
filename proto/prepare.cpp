#include "proto/prepare.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "core/base/all_finite.h"
#include "core/base/pace.h"
#include "core/mesh/creases.h"
#include "core/mesh/repair.h"
#include "core/mesh/winding.h"
#include "core/refine/plan.h"
#include "proto/client_text.h"
#include "proto/json/locate.h"
#include "proto/suggest.h"

namespace subdivd::proto {
namespace {

std::string label(const char* kind, std::size_t i, const std::string& name) {
  return std::string(kind) + ' ' + std::to_string(i) +
         (name.empty() ? "" : std::string(" (") + in_quotes(name) + ')');
}

// "points[5][2]" of {"points", 5, 2}: the core's messages say what is wrong, this says with what.
std::string subject(const Path& where) {
  std::string text;
  for (const PathStep& step : where) {
    if (const auto* name = std::get_if<std::string>(&step)) {
      if (!text.empty()) text += '.';
      text += client_text(*name);
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

// Holes, and primvars with values for faces or corners, must fit the faces as they are given: rearranged with
// the faces they would tell of other faults, or of none.
Result<void> check_beside_faces(const ControlMesh& mesh, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) -> Result<void> {
    std::vector<bool> seen(mesh.face_count());
    for (std::size_t k = 0; k < mesh.hole_indices.size(); ++k) {
      pace.spend(1);
      const Index face = mesh.hole_indices[k];
      const bool exists = face < seen.size();
      if (exists && !seen[face]) {
        seen[face] = true;
        continue;
      }
      return Error{
          exists ? ErrorCode::duplicate_tag : ErrorCode::out_of_range,
          "index " + std::to_string(face) +
              (exists ? " is given twice" : " is past the " + std::to_string(seen.size()) + " faces"),
          {"holeIndices", std::uint64_t{k}}};
    }
    for (const Primvar& primvar : mesh.primvars) {
      const bool uniform = primvar.interpolation == Interpolation::uniform;
      if (!uniform && primvar.interpolation != Interpolation::face_varying) continue;
      const bool indexed = !primvar.indices.empty();
      const Count expected = uniform ? mesh.face_count() : mesh.face_vertex_indices.size();
      const Count given =
          indexed ? primvar.indices.size() : primvar.values.size() / std::max<Index>(primvar.element_size, 1);
      if (given == expected) continue;
      return Error{ErrorCode::wrong_length,
                   "holds " + std::to_string(given) + (indexed ? " indices" : " values") +
                       "; this interpolation takes " + std::to_string(expected),
                   {"primvars", primvar.name, indexed ? "indices" : "values"}};
    }
    return {};
  });
}

// Bytes of new arrays while faces are rearranged into `faces` triangles: where they come from and, one after
// the other, what hangs on them.
Count rearranging_bytes(const ControlMesh& mesh, Count faces) {
  const Count corners = 3 * faces;
  Count numbers = 2 * (faces + corners) + 4 * mesh.face_count() + mesh.crease_indices.size();
  for (const Primvar& primvar : mesh.primvars) {
    if (primvar.interpolation == Interpolation::uniform) numbers += faces + mesh.face_count();
    if (primvar.interpolation == Interpolation::face_varying)
      numbers += corners + mesh.face_vertex_indices.size();
  }
  if (!mesh.render_meshes.empty()) numbers += corners + mesh.face_vertex_indices.size();
  return 2 * numbers * sizeof(Index);
}

// Bytes of what check() makes of creases, to look for their edges (see are_edges()), of corners
// and holes, to find those that are given twice, and of points and render vertices, to find faces that repeat one.
Count checking_bytes(const ControlMesh& mesh) {
  const Count points = mesh.point_count(), corners = mesh.face_vertex_indices.size();
  constexpr Count kPair = sizeof(VertexPair) + sizeof(Index) + 2;
  Count bytes = 0;
  if (!mesh.crease_lengths.empty())
    bytes = mesh.crease_indices.size() * kPair + (3 * (points + 1) + corners) * sizeof(Index);
  bytes = std::max(bytes, points * sizeof(Index));
  for (const RenderMesh& render : mesh.render_meshes)
    bytes = std::max(bytes, render.vertex_count * sizeof(Index));
  if (!mesh.corner_indices.empty()) bytes = std::max(bytes, points);
  if (!mesh.hole_indices.empty()) bytes = std::max(bytes, mesh.face_count());
  return bytes;
}

Result<void> split_faces(ControlMesh& mesh, json::FaceHistory& history, const Budget& budget) {
  const std::vector<Index>& counts = mesh.face_vertex_counts;
  if (std::ranges::all_of(counts, [](Index count) { return count == 3; })) return {};
  Count corners = 0, largest = 0;
  for (const Index count : counts) {
    corners += count;
    largest = std::max<Count>(largest, count);
  }
  // Whatever else is wrong with them, triangulate() says so; where corners that are promised are not there it
  // makes nothing but a sum for every face.
  const bool fit = corners == mesh.face_vertex_indices.size();
  if (fit)
    if (auto fine = check_beside_faces(mesh, budget); !fine) return fine;
  const Count triangles = corners - std::min(corners, 2 * Count{counts.size()});
  const Count bytes = fit ? rearranging_bytes(mesh, triangles) + triangulating_bytes(largest)
                          : (counts.size() + 1) * sizeof(Count);
  if (auto taken = budget.take_memory(bytes); !taken) return taken;
  if (fit) history.counts = counts;
  Result<Triangulation> split = triangulate(mesh, budget);
  if (!split) return std::move(split).error();
  history.triangulated = std::move(split->faces);
  history.corners = std::move(split->corners);
  return {};
}

Result<void> drop_faces(RefineRequest& request, std::size_t i, json::FaceHistory& history,
                        const Budget& budget) {
  ControlMesh& mesh = request.meshes[i];
  const std::size_t faces = mesh.face_count();
  if (auto fine = check_beside_faces(mesh, budget); !fine) return fine;
  const Count corners = mesh.face_vertex_indices.size();
  if (auto taken =
          budget.take_memory(rearranging_bytes(mesh, (corners + 2) / 3) + (faces + 1) * sizeof(Count));
      !taken)
    return taken;
  if (history.triangulated.empty()) history.counts = mesh.face_vertex_counts;
  history.crease_indices = mesh.crease_indices;
  history.crease_lengths = mesh.crease_lengths;
  history.sharp_edges = mesh.crease_sharpnesses.size() != mesh.crease_lengths.size();
  Result<std::vector<Index>> kept = drop_degenerate_faces(mesh, budget);
  if (!kept) return std::move(kept).error();
  history.kept = std::move(*kept);
  if (!history.kept.empty()) warn_of_dropped(request, i, history, faces);
  return {};
}

Result<void> repair_and_check(RefineRequest& request, std::size_t i, json::FaceHistory& history,
                              const Budget& budget) {
  ControlMesh& mesh = request.meshes[i];
  if (request.options.triangulate)
    if (auto split = split_faces(mesh, history, budget); !split) return split;
  if (auto taken = budget.take_memory(checking_bytes(mesh)); !taken) return taken;
  // Most meshes need no repair, and are looked at once.
  Result<void> fine = mesh.check(budget);
  const bool repeats = !fine && fine.error().code == ErrorCode::not_a_triangle &&
                       fine.error().where.size() == 2 &&
                       fine.error().where[0] == PathStep("faceVertexIndices");
  if (fine || is_stop(fine.error()) || !repeats) return fine;
  if (auto dropped = drop_faces(request, i, history, budget); !dropped) return dropped;
  return mesh.check(budget);
}

// What the scheme that the mesh names does not take is refused before anything is planned.
Result<void> check_scheme(const RefineRequest& request, std::size_t i, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) -> Result<void> {
    const auto scheme = scheme_of(request.meshes[i], request.options.schemes, pace);
    return scheme ? Result<void>() : scheme.error();
  });
}

// What single precision cannot hold would come out infinite.
Result<void> check_fits(std::span<const double> values, const Path& where, const Budget& budget) {
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  for (std::size_t begin = 0; begin < values.size(); begin += kBlock) {
    if (auto stop = budget.poll()) return *stop;
    const auto block = values.subspan(begin, std::min(kBlock, values.size() - begin));
    if (all_up_to(block, static_cast<double>(FLT_MAX))) continue;
    const auto bad = std::ranges::find_if(block, [](double x) { return std::fabs(x) > FLT_MAX; });
    if (bad == block.end()) continue;
    Path place = where;
    place.emplace_back(std::uint64_t{begin} + static_cast<std::uint64_t>(bad - block.begin()));
    return Error{ErrorCode::out_of_range,
                 "this is too large for single precision; take precision double or scale it down",
                 std::move(place)};
  }
  return {};
}

// THE place where places of the core become pointers into the body.
Error blame(const RefineRequest& request, Error error, const char* of, std::size_t i,
            const json::FaceHistory& history) {
  if (is_stop(error)) return error;
  const std::string_view kind = of;
  const bool mesh = kind == "meshes", curves = kind == "curves";
  if (request.input != Format::json || request.from_text) {
    // Such bodies hold no surfaces, and no arrays of numbers to point into.
    if (const std::string what = subject(error.where); mesh && !what.empty())
      error.message = what + ": " + error.message;
    const std::string& name = mesh ? request.meshes[i].name : request.curves[i].name;
    error.message = label(mesh ? "mesh" : "curve", i, name) + ": " + error.message;
    error.where.clear();
    return error;
  }
  Path place = std::move(error.where);
  if (mesh)
    place = json::locate(std::move(place), request.meshes[i], request.mesh_forms[i], history);
  else if (curves)
    place = json::locate(std::move(place), request.curves[i], request.curve_forms[i]);
  else
    place = json::locate(std::move(place), request.surfaces[i], request.surface_forms[i]);
  // Of a mesh the core says "is …", of the others whole sentences.
  if (const std::string what = subject(place); mesh && !what.empty())
    error.message = what + ": " + error.message;
  const bool at_top = mesh     ? request.single_mesh_at_top
                      : curves ? request.single_curve_at_top
                               : request.single_surface_at_top;
  if (!at_top) error.where = {of, std::uint64_t{i}};
  error.where.insert(error.where.end(), std::make_move_iterator(place.begin()),
                     std::make_move_iterator(place.end()));
  return error;
}

// glTF, OBJ and OFF know counter-clockwise faces only: a mesh that is left-handed is made right-handed for them. In
// JSON it keeps its faces, and the numbers of what is refined with them.
Result<void> turn_for_others(RefineRequest& request, std::size_t i, const Budget& budget) {
  if (i >= request.mesh_forms.size() || answer_format(request) == Format::json) return {};
  Orientation& orientation = request.mesh_forms[i].orientation;
  if (std::exchange(orientation, Orientation::right_handed) == Orientation::right_handed) return {};
  return reverse_windings(request.meshes[i], budget);
}

Result<void> prepare_mesh(RefineRequest& request, std::size_t i, const Budget& budget) {
  json::FaceHistory history;
  Result<void> fine = repair_and_check(request, i, history, budget);
  if (fine) fine = check_scheme(request, i, budget);
  if (fine)
    fine = answer_precision(request) == Precision::single_precision
               ? check_magnitudes<float>(request.meshes[i], budget)
               : check_magnitudes<double>(request.meshes[i], budget);
  if (!fine) return blame(request, std::move(fine).error(), "meshes", i, history);
  if (auto turned = turn_for_others(request, i, budget); !turned) return turned;
  if (history.changed()) {
    request.face_origins.resize(request.meshes.size());
    request.face_origins[i] = history.original_faces();
  }
  return {};
}

Result<void> prepare_curves(RefineRequest& request, std::size_t i, const Budget& budget) {
  const ControlCurves& curves = request.curves[i];
  Result<void> fine = curves.check(budget);
  if (fine && answer_precision(request) == Precision::single_precision)
    fine = check_fits(curves.points, {"points"}, budget);
  return fine ? fine : blame_input(request, std::move(fine).error(), "curves", i);
}

Result<void> prepare_surface(RefineRequest& request, std::size_t i, const Budget& budget) {
  const ControlPatch& surface = request.surfaces[i];
  Result<void> fine = surface.check(budget);
  if (fine && answer_precision(request) == Precision::single_precision)
    fine = check_fits(surface.points, {"points"}, budget);
  return fine ? fine : blame_input(request, std::move(fine).error(), "surfaces", i);
}

}  // namespace

Error blame_input(const RefineRequest& request, Error error, const char* of, std::size_t i) {
  // What is found after checking stands in points and values, which no repair of faces moves.
  return blame(request, std::move(error), of, i, {});
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

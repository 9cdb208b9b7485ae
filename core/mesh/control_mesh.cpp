#include "core/mesh/control_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "core/base/all_finite.h"
#include "core/base/pace.h"
#include "core/base/precision.h"
#include "core/mesh/creases.h"
#include "core/mesh/scan.h"

namespace subdivd {
namespace {

Error fault(ErrorCode code, std::string message, Path where) {
  return {code, std::move(message), std::move(where)};
}

std::string number(Count n) { return std::to_string(n); }

Path at(std::string field, Count index) { return {std::move(field), std::uint64_t{index}}; }

// Whether `test` finds every block of the values sound.
template <class T, class Test>
bool all_blocks(std::span<const T> values, const Pace& pace, Test&& test) {
  bool sound = true;
  pace.in_blocks(values.size(), [&](Count begin, Count end) {
    if (sound) sound = test(values.subspan(begin, end - begin));
  });
  return sound;
}

Result<void> check_finite(std::span<const double> values, Path where, const Pace& pace) {
  if (all_blocks(values, pace, [](std::span<const double> block) { return all_finite(block); })) return {};
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!std::isfinite(values[k])) {
      where.emplace_back(std::uint64_t{k});
      return fault(ErrorCode::not_finite, "must be a finite number", std::move(where));
    }
  return {};
}

Result<void> check_indices(std::span<const Index> indices, Count count, std::string_view of, Path where,
                           const Pace& pace) {
  if (all_blocks(indices, pace, [&](std::span<const Index> block) { return all_below(block, count); }))
    return {};
  for (std::size_t k = 0; k < indices.size(); ++k)
    if (indices[k] >= count) {
      where.emplace_back(std::uint64_t{k});
      return fault(ErrorCode::out_of_range,
                   "index " + number(indices[k]) + " is past the " + number(count) + " " + std::string(of),
                   std::move(where));
    }
  return {};
}

Result<void> check_unique(const std::vector<Index>& indices, Count count, const std::string& field,
                          const Pace& pace) {
  if (indices.empty()) return {};
  std::vector<unsigned char> seen;
  pace.fill(seen, count, 0);
  for (std::size_t k = 0; k < indices.size(); ++k) {
    pace.spend(1);
    if (std::exchange(seen[indices[k]], 1) != 0)
      return fault(ErrorCode::duplicate_tag, "index " + number(indices[k]) + " is given twice", at(field, k));
  }
  return {};
}

Result<void> check_sharpness(const std::vector<float>& values, const std::string& field, const Pace& pace) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    pace.spend(1);
    if (!(values[k] >= 0))
      return fault(ErrorCode::out_of_range, "sharpness must be 0 or more, or \"infinite\"", at(field, k));
  }
  return {};
}

Result<void> check_points(const ControlMesh& mesh, const Pace& pace) {
  if (mesh.points.size() % 3 != 0)
    return fault(
        ErrorCode::wrong_length,
        "holds " + number(mesh.points.size()) + " numbers; x, y, z of every point make a multiple of 3",
        {"points"});
  if (mesh.point_count() >= kMaxIndexCount)
    return fault(ErrorCode::too_large, "has more points than 32-bit indices can number", {"points"});
  return check_finite(mesh.points, {"points"}, pace);
}

// Whether all indices are sound, a block of whole triangles after the other.
bool all_triangles_sound(std::span<const Index> triangles, Count count, const Pace& pace) {
  bool sound = true;
  pace.in_blocks(triangles.size() / 3, [&](Count begin, Count end) {
    if (sound) sound = all_sound(triangles.subspan(3 * begin, 3 * (end - begin)), count);
  });
  return sound;
}

Result<void> check_face_counts(const ControlMesh& mesh, const Pace& pace) {
  Count corners = 0;
  pace.for_each(mesh.face_vertex_counts.size(), [&](Count f) { corners += mesh.face_vertex_counts[f]; });
  if (corners != mesh.face_vertex_indices.size())
    return fault(ErrorCode::wrong_length,
                 "adds up to " + number(corners) + " corners but faceVertexIndices holds " +
                     number(mesh.face_vertex_indices.size()),
                 {"faceVertexCounts"});
  for (std::size_t f = 0; f < mesh.face_vertex_counts.size(); ++f) {
    pace.spend(1);
    if (mesh.face_vertex_counts[f] < 3)
      return fault(ErrorCode::not_a_triangle,
                   "face " + number(f) + " has " + number(mesh.face_vertex_counts[f]) +
                       " vertices; a face has at least 3",
                   at("faceVertexCounts", f));
  }
  return {};
}

struct Repeat {
  Index face;
  Count corner;
};

// The first corner whose vertex its face has had before. `corners`: of the mesh's faces from `begin` on, over any
// vertices, each < vertex_count.
std::optional<Repeat> first_repeat(const ControlMesh& mesh, Index begin, std::span<const Index> corners,
                                   Count vertex_count, const Pace& pace) {
  std::vector<Index> last_face;  // of each vertex
  pace.fill(last_face, vertex_count, kNoIndex);
  Count corner = 0;
  for (Index f = begin; corner < corners.size(); ++f) {
    const Count end = corner + mesh.face_size(f);
    for (; corner < end; ++corner) {
      pace.spend(1);
      if (std::exchange(last_face[corners[corner]], f) == f) return Repeat{f, corner};
    }
  }
  return std::nullopt;
}

Result<void> check_faces(const ControlMesh& mesh, const Pace& pace) {
  if (mesh.face_vertex_indices.empty())
    return fault(ErrorCode::wrong_length, "is empty; a mesh has at least one face", {"faceVertexIndices"});
  if (mesh.face_vertex_indices.size() >= kMaxIndexCount)
    return fault(ErrorCode::too_large, "has more corners than 32-bit indices can number",
                 {"faceVertexIndices"});
  if (mesh.face_vertex_counts.empty()) {
    if (mesh.face_vertex_indices.size() % 3 != 0)
      return fault(
          ErrorCode::wrong_length,
          "holds " + number(mesh.face_vertex_indices.size()) +
              " indices; without faceVertexCounts all faces are triangles, which make a multiple of 3",
          {"faceVertexIndices"});
  } else if (auto fine = check_face_counts(mesh, pace); !fine) {
    return fine;
  }
  if (has_triangles_only(mesh.face_vertex_counts, pace) &&
      all_triangles_sound(mesh.face_vertex_indices, mesh.point_count(), pace))
    return {};
  if (auto fine =
          check_indices(mesh.face_vertex_indices, mesh.point_count(), "points", {"faceVertexIndices"}, pace);
      !fine)
    return fine;
  if (const auto repeat = first_repeat(mesh, 0, mesh.face_vertex_indices, mesh.point_count(), pace))
    return fault(ErrorCode::not_a_triangle, "face " + number(repeat->face) + " repeats a vertex",
                 at("faceVertexIndices", repeat->corner));
  return {};
}

// Every two neighbours of a crease must share an edge.
Result<void> check_crease_edges(const ControlMesh& mesh, const Pace& pace) {
  if (mesh.crease_lengths.empty()) return {};
  const std::vector<VertexPair> edges = crease_edges(mesh, pace);
  const std::vector<unsigned char> found = are_edges(
      static_cast<Index>(mesh.point_count()), mesh.face_vertex_counts, mesh.face_vertex_indices, edges, pace);
  const auto missing = static_cast<std::size_t>(std::ranges::find(found, 0) - found.begin());
  if (missing == found.size()) return {};
  Count place = 0, edge = 0;
  for_each_crease_edge(mesh, [&](Count position, Index, Index, float) {
    if (edge++ == missing) place = position + 1;
  });
  return fault(ErrorCode::not_an_edge,
               "points " + number(edges[missing][0]) + " and " + number(edges[missing][1]) +
                   " share no edge; a crease runs along edges of the mesh",
               at("creaseIndices", place));
}

Result<void> check_creases(const ControlMesh& mesh, const Pace& pace) {
  Count points = 0, edges = 0;
  for (std::size_t k = 0; k < mesh.crease_lengths.size(); ++k) {
    pace.spend(1);
    if (mesh.crease_lengths[k] < 2)
      return fault(ErrorCode::out_of_range, "a crease has at least 2 points", at("creaseLengths", k));
    points += mesh.crease_lengths[k];
    edges += mesh.crease_lengths[k] - 1;
  }
  if (points != mesh.crease_indices.size())
    return fault(ErrorCode::wrong_length,
                 "adds up to " + number(points) + " points but creaseIndices holds " +
                     number(mesh.crease_indices.size()),
                 {"creaseLengths"});
  if (mesh.crease_sharpnesses.size() != mesh.crease_lengths.size() && mesh.crease_sharpnesses.size() != edges)
    return fault(ErrorCode::wrong_length,
                 "holds " + number(mesh.crease_sharpnesses.size()) + " numbers; one per crease makes " +
                     number(mesh.crease_lengths.size()) + ", one per edge of every crease " + number(edges),
                 {"creaseSharpnesses"});
  if (auto fine = check_indices(mesh.crease_indices, mesh.point_count(), "points", {"creaseIndices"}, pace);
      !fine)
    return fine;
  if (auto fine = check_sharpness(mesh.crease_sharpnesses, "creaseSharpnesses", pace); !fine) return fine;
  return check_crease_edges(mesh, pace);
}

Result<void> check_corners_and_holes(const ControlMesh& mesh, const Pace& pace) {
  if (mesh.corner_sharpnesses.size() != mesh.corner_indices.size())
    return fault(ErrorCode::wrong_length,
                 "holds " + number(mesh.corner_sharpnesses.size()) + " numbers for " +
                     number(mesh.corner_indices.size()) + " cornerIndices",
                 {"cornerSharpnesses"});
  if (auto fine = check_indices(mesh.corner_indices, mesh.point_count(), "points", {"cornerIndices"}, pace);
      !fine)
    return fine;
  if (auto fine = check_unique(mesh.corner_indices, mesh.point_count(), "cornerIndices", pace); !fine)
    return fine;
  if (auto fine = check_sharpness(mesh.corner_sharpnesses, "cornerSharpnesses", pace); !fine) return fine;
  if (auto fine = check_indices(mesh.hole_indices, mesh.face_count(), "faces", {"holeIndices"}, pace); !fine)
    return fine;
  return check_unique(mesh.hole_indices, mesh.face_count(), "holeIndices", pace);
}

Count expected_count(const ControlMesh& mesh, Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::constant:
      return 1;
    case Interpolation::uniform:
      return mesh.face_count();
    case Interpolation::varying:
    case Interpolation::vertex:
      return mesh.point_count();
    case Interpolation::face_varying:
      return mesh.face_vertex_indices.size();
  }
  return 0;
}

Result<void> check_primvar(const ControlMesh& mesh, const Primvar& primvar, const Pace& pace) {
  auto member = [&](const char* name) { return Path{"primvars", primvar.name, name}; };
  if (primvar.name.empty())
    return fault(ErrorCode::out_of_range, "a primvar needs a name", {"primvars", primvar.name});
  if (primvar.element_size < 1 || primvar.element_size > kMaxElementSize)
    return fault(ErrorCode::out_of_range, "must be 1 to " + number(kMaxElementSize), member("elementSize"));
  if (primvar.values.size() % primvar.element_size != 0)
    return fault(ErrorCode::wrong_length,
                 "holds " + number(primvar.values.size()) + " numbers, not a multiple of elementSize " +
                     number(primvar.element_size),
                 member("values"));
  const Count values = primvar.values.size() / primvar.element_size;
  const Count expected = expected_count(mesh, primvar.interpolation);
  const bool indexed = !primvar.indices.empty();
  if ((indexed ? primvar.indices.size() : values) != expected)
    return fault(ErrorCode::wrong_length,
                 "holds " + number(indexed ? primvar.indices.size() : values) +
                     (indexed ? " indices" : " values") + "; this interpolation takes " + number(expected),
                 member(indexed ? "indices" : "values"));
  if (values >= kMaxIndexCount)
    return fault(ErrorCode::too_large, "has more values than 32-bit indices can number", member("values"));
  if (auto fine = check_indices(primvar.indices, values, "values", member("indices"), pace); !fine)
    return fine;
  return check_finite(primvar.values, member("values"), pace);
}

// The first primvar whose name another one before it has; their number when there is none. By sorting: a hash
// of names that a caller chose can be made to collide.
std::size_t first_duplicate(const std::vector<Primvar>& primvars, const Pace& pace) {
  std::vector<std::pair<std::string_view, std::size_t>> names;
  names.reserve(primvars.size());
  for (std::size_t k = 0; k < primvars.size(); ++k) names.emplace_back(primvars[k].name, k);
  pace.sort(names.begin(), names.end(), std::less<>());
  std::size_t first = primvars.size();
  for (std::size_t k = 1; k < names.size(); ++k)
    if (names[k].first == names[k - 1].first) first = std::min(first, names[k].second);
  return first;
}

Result<void> check_primvars(const ControlMesh& mesh, const Pace& pace) {
  const std::size_t duplicate = first_duplicate(mesh.primvars, pace);
  for (std::size_t k = 0; k < mesh.primvars.size(); ++k) {
    pace.spend(16);
    if (k == duplicate)
      return fault(ErrorCode::duplicate_field, "two primvars have this name",
                   {"primvars", mesh.primvars[k].name});
    if (auto fine = check_primvar(mesh, mesh.primvars[k], pace); !fine) return fine;
  }
  return {};
}

Result<void> check_render_meshes(const ControlMesh& mesh, const Pace& pace) {
  const bool triangles = has_triangles_only(mesh.face_vertex_counts, pace);
  Index end = 0;
  for (std::size_t k = 0; k < mesh.render_meshes.size(); ++k) {
    pace.spend(16);
    const RenderMesh& render = mesh.render_meshes[k];
    if (render.face_begin < end || render.face_end < render.face_begin || render.face_end > mesh.face_count())
      return fault(ErrorCode::out_of_range, "face ranges must ascend within the mesh", at("renderMeshes", k));
    end = render.face_end;
    Count corners = 3 * Count{render.face_end - render.face_begin};
    if (!mesh.face_vertex_counts.empty()) {
      corners = 0;
      pace.for_each(render.face_end - render.face_begin,
                    [&](Index f) { corners += mesh.face_vertex_counts[render.face_begin + f]; });
    }
    if (render.indices.size() != corners)
      return fault(ErrorCode::wrong_length, "one index per face corner is needed", at("renderMeshes", k));
    if (triangles && all_triangles_sound(render.indices, render.vertex_count, pace)) continue;
    if (auto fine =
            check_indices(render.indices, render.vertex_count, "vertices", at("renderMeshes", k), pace);
        !fine)
      return fine;
    if (first_repeat(mesh, render.face_begin, render.indices, render.vertex_count, pace))
      return fault(ErrorCode::not_a_triangle, "a render face repeats a vertex", at("renderMeshes", k));
  }
  return {};
}

}  // namespace

Result<void> ControlMesh::check(const Budget& budget) const {
  return stoppable(budget, [&](const Pace& pace) -> Result<void> {
    for (auto part : {check_points, check_faces, check_creases, check_corners_and_holes, check_primvars,
                      check_render_meshes})
      if (auto fine = part(*this, pace); !fine) return fine;
    return {};
  });
}

template <class Real>
Result<void> check_magnitudes(const ControlMesh& mesh, const Budget& budget) {
  const auto judge = [](std::span<const double> values, Path where, const Pace& pace) -> Result<void> {
    if (all_blocks(values, pace,
                   [](std::span<const double> block) { return all_up_to(block, kLargestValue<Real>); }))
      return {};
    const auto bad =
        std::ranges::find_if(values, [](double x) { return !(std::abs(x) <= kLargestValue<Real>); });
    where.emplace_back(static_cast<std::uint64_t>(bad - values.begin()));
    return fault(ErrorCode::out_of_range,
                 sizeof(Real) == 4 ? "is too large to be refined in single precision (at most 3.4e32); take "
                                     "precision double or scale it down"
                                   : "is too large to be refined in double precision (at most 1.7e302)",
                 std::move(where));
  };
  return stoppable(budget, [&](const Pace& pace) -> Result<void> {
    if (auto fits = judge(mesh.points, {"points"}, pace); !fits) return fits;
    for (const Primvar& primvar : mesh.primvars)
      if (auto fits = judge(primvar.values, {"primvars", primvar.name, "values"}, pace); !fits) return fits;
    return {};
  });
}

template Result<void> check_magnitudes<float>(const ControlMesh&, const Budget&);
template Result<void> check_magnitudes<double>(const ControlMesh&, const Budget&);

}  // namespace subdivd

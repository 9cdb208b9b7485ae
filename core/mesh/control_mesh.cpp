#include "core/mesh/control_mesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "core/mesh/scan.h"

namespace subdivd {
namespace {

Error fault(ErrorCode code, std::string message, Path where) {
  return {code, std::move(message), std::move(where), 0, 0};
}

std::string number(Count n) { return std::to_string(n); }

Path at(std::string field, Count index) { return {std::move(field), std::uint64_t{index}}; }

Result<void> check_finite(const std::vector<double>& values, Path where) {
  if (all_finite(values)) return {};
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!std::isfinite(values[k])) {
      where.emplace_back(std::uint64_t{k});
      return fault(ErrorCode::not_finite, "must be a finite number", std::move(where));
    }
  return {};
}

Result<void> check_indices(const std::vector<Index>& indices, Count count, std::string_view of, Path where) {
  if (all_below(indices, count)) return {};
  for (std::size_t k = 0; k < indices.size(); ++k)
    if (indices[k] >= count) {
      where.emplace_back(std::uint64_t{k});
      return fault(ErrorCode::out_of_range,
                   "index " + number(indices[k]) + " is past the " + number(count) + " " + std::string(of),
                   std::move(where));
    }
  return {};
}

Result<void> check_unique(const std::vector<Index>& indices, Count count, const std::string& field) {
  std::vector<unsigned char> seen(count, 0);
  for (std::size_t k = 0; k < indices.size(); ++k)
    if (std::exchange(seen[indices[k]], 1) != 0)
      return fault(ErrorCode::duplicate_tag, "index " + number(indices[k]) + " is given twice", at(field, k));
  return {};
}

Result<void> check_sharpness(const std::vector<float>& values, const std::string& field) {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!(values[k] >= 0))
      return fault(ErrorCode::out_of_range, "sharpness must be 0 or more, or \"infinite\"", at(field, k));
  return {};
}

Result<void> check_points(const ControlMesh& mesh) {
  if (mesh.points.size() % 3 != 0)
    return fault(
        ErrorCode::wrong_length,
        "holds " + number(mesh.points.size()) + " numbers; x, y, z of every point make a multiple of 3",
        {"points"});
  if (mesh.point_count() >= kMaxIndexCount)
    return fault(ErrorCode::too_large, "has more points than 32-bit indices can number", {"points"});
  return check_finite(mesh.points, {"points"});
}

Result<void> check_faces(const ControlMesh& mesh) {
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
  } else {
    Count corners = 0;
    for (Index count : mesh.face_vertex_counts) corners += count;
    if (corners != mesh.face_vertex_indices.size())
      return fault(ErrorCode::wrong_length,
                   "adds up to " + number(corners) + " corners but faceVertexIndices holds " +
                       number(mesh.face_vertex_indices.size()),
                   {"faceVertexCounts"});
    for (std::size_t f = 0; f < mesh.face_vertex_counts.size(); ++f)
      if (mesh.face_vertex_counts[f] != 3)
        return fault(
            ErrorCode::not_a_triangle,
            "face " + number(f) + " has " + number(mesh.face_vertex_counts[f]) +
                " vertices; Loop takes triangles only: set triangulate to true to split larger faces",
            at("faceVertexCounts", f));
  }
  if (all_sound(mesh.face_vertex_indices, mesh.point_count())) return {};
  if (auto fine =
          check_indices(mesh.face_vertex_indices, mesh.point_count(), "points", {"faceVertexIndices"});
      !fine)
    return fine;
  for (std::size_t h = 0; h < mesh.face_vertex_indices.size(); h += 3) {
    const Index* v = mesh.face_vertex_indices.data() + h;
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
      return fault(ErrorCode::not_a_triangle, "face " + number(h / 3) + " repeats a vertex",
                   at("faceVertexIndices", h + (v[0] == v[1] ? 1 : 2)));
  }
  return {};
}

std::uint64_t edge_key(Index a, Index b) { return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b); }

// Every two neighbours of a crease must share an edge.
Result<void> check_crease_edges(const ControlMesh& mesh) {
  std::unordered_set<std::uint64_t> wanted;
  std::size_t point = 0;
  for (Index length : mesh.crease_lengths) {
    for (Index k = 0; k + 1 < length; ++k)
      wanted.insert(edge_key(mesh.crease_indices[point + k], mesh.crease_indices[point + k + 1]));
    point += length;
  }
  for (std::size_t h = 0; h < mesh.face_vertex_indices.size() && !wanted.empty(); h += 3)
    for (std::size_t k = 0; k < 3; ++k)
      wanted.erase(edge_key(mesh.face_vertex_indices[h + k], mesh.face_vertex_indices[h + (k + 1) % 3]));
  if (wanted.empty()) return {};
  point = 0;
  for (Index length : mesh.crease_lengths) {
    for (Index k = 0; k + 1 < length; ++k) {
      const Index a = mesh.crease_indices[point + k], b = mesh.crease_indices[point + k + 1];
      if (wanted.contains(edge_key(a, b)))
        return fault(ErrorCode::not_an_edge,
                     "points " + number(a) + " and " + number(b) +
                         " share no edge; a crease runs along edges of the mesh",
                     at("creaseIndices", point + k + 1));
    }
    point += length;
  }
  return {};
}

Result<void> check_creases(const ControlMesh& mesh) {
  Count points = 0, edges = 0;
  for (std::size_t k = 0; k < mesh.crease_lengths.size(); ++k) {
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
  if (auto fine = check_indices(mesh.crease_indices, mesh.point_count(), "points", {"creaseIndices"}); !fine)
    return fine;
  if (auto fine = check_sharpness(mesh.crease_sharpnesses, "creaseSharpnesses"); !fine) return fine;
  return check_crease_edges(mesh);
}

Result<void> check_corners_and_holes(const ControlMesh& mesh) {
  if (mesh.corner_sharpnesses.size() != mesh.corner_indices.size())
    return fault(ErrorCode::wrong_length,
                 "holds " + number(mesh.corner_sharpnesses.size()) + " numbers for " +
                     number(mesh.corner_indices.size()) + " cornerIndices",
                 {"cornerSharpnesses"});
  if (auto fine = check_indices(mesh.corner_indices, mesh.point_count(), "points", {"cornerIndices"}); !fine)
    return fine;
  if (auto fine = check_unique(mesh.corner_indices, mesh.point_count(), "cornerIndices"); !fine) return fine;
  if (auto fine = check_sharpness(mesh.corner_sharpnesses, "cornerSharpnesses"); !fine) return fine;
  if (auto fine = check_indices(mesh.hole_indices, mesh.face_count(), "faces", {"holeIndices"}); !fine)
    return fine;
  return check_unique(mesh.hole_indices, mesh.face_count(), "holeIndices");
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

Result<void> check_primvar(const ControlMesh& mesh, const Primvar& primvar) {
  const Path here{"primvars", primvar.name};
  auto member = [&](const char* name) { return Path{"primvars", primvar.name, name}; };
  if (primvar.name.empty()) return fault(ErrorCode::out_of_range, "a primvar needs a name", here);
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
  if (auto fine = check_indices(primvar.indices, values, "values", member("indices")); !fine) return fine;
  return check_finite(primvar.values, member("values"));
}

Result<void> check_primvars(const ControlMesh& mesh) {
  std::unordered_set<std::string_view> names;
  for (const Primvar& primvar : mesh.primvars) {
    if (!names.insert(primvar.name).second)
      return fault(ErrorCode::duplicate_field, "two primvars have this name", {"primvars", primvar.name});
    if (auto fine = check_primvar(mesh, primvar); !fine) return fine;
  }
  return {};
}

Result<void> check_render_meshes(const ControlMesh& mesh) {
  Index end = 0;
  for (std::size_t k = 0; k < mesh.render_meshes.size(); ++k) {
    const RenderMesh& render = mesh.render_meshes[k];
    if (render.face_begin < end || render.face_end < render.face_begin || render.face_end > mesh.face_count())
      return fault(ErrorCode::out_of_range, "face ranges must ascend within the mesh", at("renderMeshes", k));
    end = render.face_end;
    if (render.indices.size() != 3 * Count{render.face_end - render.face_begin})
      return fault(ErrorCode::wrong_length, "3 indices per face are needed", at("renderMeshes", k));
    if (all_sound(render.indices, render.vertex_count)) continue;
    if (auto fine = check_indices(render.indices, render.vertex_count, "vertices", at("renderMeshes", k));
        !fine)
      return fine;
    return fault(ErrorCode::not_a_triangle, "a render face repeats a vertex", at("renderMeshes", k));
  }
  return {};
}

}  // namespace

Result<void> ControlMesh::check([[maybe_unused]] const Budget& budget) const {
  for (auto part : {check_points, check_faces, check_creases, check_corners_and_holes, check_primvars,
                    check_render_meshes})
    if (auto fine = part(*this); !fine) return fine;
  return {};
}

}  // namespace subdivd

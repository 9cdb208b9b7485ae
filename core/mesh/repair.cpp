#include "core/mesh/repair.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "core/mesh/scan.h"

namespace subdivd {
namespace {

// First corner of every face, and one past the last.
std::vector<Count> corner_offsets(const ControlMesh& mesh) {
  std::vector<Count> offsets(mesh.face_count() + 1, 0);
  for (Count f = 0; f < mesh.face_count(); ++f)
    offsets[f + 1] = offsets[f] + (mesh.face_vertex_counts.empty() ? 3 : mesh.face_vertex_counts[f]);
  return offsets;
}

bool repeats_a_vertex(const Index* v) { return v[0] == v[1] || v[1] == v[2] || v[2] == v[0]; }

// Rearranges all that hangs on faces and corners. `faces`: old face of every new one; `corners`: old corner
// of every new one.
void rearrange(ControlMesh& mesh, const std::vector<Index>& faces, const std::vector<Index>& corners) {
  const Count old_faces = mesh.face_count(), old_corners = mesh.face_vertex_indices.size();
  std::vector<unsigned char> was_hole(old_faces, 0);
  for (Index f : mesh.hole_indices) was_hole[f] = 1;
  mesh.hole_indices.clear();
  for (Index f = 0; f < faces.size(); ++f)
    if (was_hole[faces[f]] != 0) mesh.hole_indices.push_back(f);

  auto reindex = [](std::vector<Index>& indices, const std::vector<Index>& order, Count old_size) {
    if (indices.empty()) {  // values in order: name them before the order changes
      indices.resize(old_size);
      std::iota(indices.begin(), indices.end(), Index{0});
    }
    std::vector<Index> moved;
    moved.reserve(order.size());
    for (Index from : order) moved.push_back(indices[from]);
    indices = std::move(moved);
  };
  for (Primvar& primvar : mesh.primvars) {
    if (primvar.interpolation == Interpolation::uniform) reindex(primvar.indices, faces, old_faces);
    if (primvar.interpolation == Interpolation::face_varying) reindex(primvar.indices, corners, old_corners);
  }
  reindex(mesh.face_vertex_indices, corners, old_corners);
  mesh.face_vertex_counts.clear();
}

// The parts of check() that rearranging relies on; the rest of a fault-ridden mesh stays as it is for
// check().
bool can_be_rearranged(const ControlMesh& mesh) {
  const Count faces = mesh.face_count();
  if (std::ranges::any_of(mesh.hole_indices, [&](Index f) { return f >= faces; })) return false;
  for (const Primvar& primvar : mesh.primvars) {
    const bool uniform = primvar.interpolation == Interpolation::uniform;
    if (!uniform && primvar.interpolation != Interpolation::face_varying) continue;
    if (primvar.element_size == 0) return false;
    const Count size =
        primvar.indices.empty() ? primvar.values.size() / primvar.element_size : primvar.indices.size();
    if (size != (uniform ? faces : mesh.face_vertex_indices.size())) return false;
  }
  for (const RenderMesh& render : mesh.render_meshes)
    if (render.face_begin > render.face_end || render.face_end > faces ||
        render.indices.size() != 3 * Count{render.face_end - render.face_begin})
      return false;
  return true;
}

std::pair<Index, Index> edge_key(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

// Creases along edges that only dropped faces had: cut out, the rest kept as creases of single edges.
void drop_creases(ControlMesh& mesh, std::set<std::pair<Index, Index>> vanished) {
  for (Count h = 0; h < mesh.face_vertex_indices.size() && !vanished.empty(); ++h) {
    const Count next = h % 3 == 2 ? h - 2 : h + 1;
    vanished.erase(edge_key(mesh.face_vertex_indices[h], mesh.face_vertex_indices[next]));
  }
  Count points = 0, edges = 0;
  for (Index length : mesh.crease_lengths) {
    if (length < 2) return;
    points += length;
    edges += length - 1;
  }
  const bool per_crease = mesh.crease_sharpnesses.size() == mesh.crease_lengths.size();
  if (vanished.empty() || points != mesh.crease_indices.size() ||
      (!per_crease && mesh.crease_sharpnesses.size() != edges))
    return;
  std::vector<Index> indices, lengths;
  std::vector<float> sharpnesses;
  Count point = 0, edge = 0;
  for (Count crease = 0; crease < mesh.crease_lengths.size(); point += mesh.crease_lengths[crease++])
    for (Index k = 0; k + 1 < mesh.crease_lengths[crease]; ++k, ++edge) {
      const Index a = mesh.crease_indices[point + k], b = mesh.crease_indices[point + k + 1];
      if (a == b || vanished.contains(edge_key(a, b))) continue;
      indices.insert(indices.end(), {a, b});
      lengths.push_back(2);
      sharpnesses.push_back(mesh.crease_sharpnesses[per_crease ? crease : edge]);
    }
  mesh.crease_indices = std::move(indices);
  mesh.crease_lengths = std::move(lengths);
  mesh.crease_sharpnesses = std::move(sharpnesses);
}

// A render mesh's face goes when the control face goes; one that repeats a render vertex repeats a point too.
void drop_render_faces(ControlMesh& mesh, const std::vector<unsigned char>& dropped) {
  std::vector<Index> kept_before(dropped.size() + 1, 0);
  for (std::size_t f = 0; f < dropped.size(); ++f) kept_before[f + 1] = kept_before[f] + (dropped[f] == 0);
  for (RenderMesh& render : mesh.render_meshes) {
    std::vector<Index> indices;
    for (Index f = render.face_begin; f < render.face_end; ++f) {
      const auto first = render.indices.begin() + std::ptrdiff_t{3} * (f - render.face_begin);
      if (dropped[f] == 0) indices.insert(indices.end(), first, first + 3);
    }
    render.indices = std::move(indices);
    render.face_begin = kept_before[render.face_begin];
    render.face_end = kept_before[render.face_end];
  }
}

}  // namespace

Result<std::vector<Index>> drop_degenerate_faces(ControlMesh& mesh, [[maybe_unused]] const Budget& budget) {
  const bool triangles = mesh.face_vertex_indices.size() == 3 * mesh.face_count() &&
                         std::ranges::all_of(mesh.face_vertex_counts, [](Index count) { return count == 3; });
  if (!triangles) {
    if (auto fine = mesh.check(); !fine) return std::move(fine).error();
  }
  if (!any_repeats(mesh.face_vertex_indices)) return std::vector<Index>{};
  const Count faces = mesh.face_count();
  std::vector<unsigned char> dropped(faces, 0);
  std::set<std::pair<Index, Index>> edges;
  for (Count f = 0; f < faces; ++f) {
    const Index* v = mesh.face_vertex_indices.data() + 3 * f;
    if (!repeats_a_vertex(v)) continue;
    dropped[f] = 1;
    if (!mesh.crease_indices.empty())
      for (int k = 0; k < 3; ++k) edges.insert(edge_key(v[k], v[(k + 1) % 3]));
  }
  const auto count = static_cast<Count>(std::ranges::count(dropped, 1));
  if (!can_be_rearranged(mesh)) {
    auto fine = mesh.check();  // names the fault
    assert(!fine.ok());
    return std::move(fine).error();
  }
  if (count == faces)
    return Error{ErrorCode::not_a_triangle,
                 "every face repeats a vertex: nothing is left to refine",
                 {"faceVertexIndices"},
                 0,
                 0};
  std::vector<Index> kept, corners;
  for (Index f = 0; f < faces; ++f)
    if (dropped[f] == 0) {
      kept.push_back(f);
      corners.insert(corners.end(), {3 * f, 3 * f + 1, 3 * f + 2});
    }
  drop_render_faces(mesh, dropped);
  rearrange(mesh, kept, corners);
  drop_creases(mesh, std::move(edges));
  return kept;
}

Result<std::vector<Index>> triangulate(ControlMesh& mesh, [[maybe_unused]] const Budget& budget) {
  if (std::ranges::all_of(mesh.face_vertex_counts, [](Index count) { return count == 3; }))
    return std::vector<Index>{};
  const std::vector<Count> offsets = corner_offsets(mesh);
  for (Count f = 0; f < mesh.face_count(); ++f)
    if (mesh.face_vertex_counts[f] < 3)
      return Error{ErrorCode::not_a_triangle,
                   "face " + std::to_string(f) + " has " + std::to_string(mesh.face_vertex_counts[f]) +
                       " vertices; a face has at least 3",
                   {"faceVertexCounts", std::uint64_t{f}},
                   0,
                   0};
  if (offsets.back() != mesh.face_vertex_indices.size() || !can_be_rearranged(mesh)) {
    if (auto fine = mesh.check(); !fine && fine.error().code != ErrorCode::not_a_triangle)
      return std::move(fine).error();
    // check() meets the larger faces first: say what stands behind them.
    return Error{
        ErrorCode::wrong_length,
        "face-varying primvars, uniform primvars and holeIndices must fit the faces as they are given",
        {"primvars"},
        0,
        0};
  }
  std::vector<Index> faces, corners;
  for (Index f = 0; f + Count{1} < offsets.size(); ++f)
    for (Count k = offsets[f] + 1; k + 1 < offsets[f + 1]; ++k) {
      faces.push_back(f);
      for (Count corner : {offsets[f], k, k + 1}) corners.push_back(static_cast<Index>(corner));
    }
  rearrange(mesh, faces, corners);
  return faces;
}

}  // namespace subdivd

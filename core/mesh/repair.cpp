#include "core/mesh/repair.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <numeric>
#include <span>
#include <utility>

#include "core/base/pace.h"
#include "core/mesh/creases.h"
#include "core/mesh/ear_clipping.h"
#include "core/mesh/scan.h"

namespace subdivd {
namespace {

// First corner of every face, and one past the last.
std::vector<Count> corner_offsets(const ControlMesh& mesh, const Pace& pace) {
  std::vector<Count> offsets;
  pace.fill(offsets, mesh.face_count() + 1, 0);
  pace.for_each(mesh.face_count(), [&](Count f) { offsets[f + 1] = offsets[f] + mesh.face_size(f); });
  return offsets;
}

// Flags of the faces that repeat a vertex. Numbers that are no points are told apart too, without a table of them.
std::vector<unsigned char> repeating_faces(const ControlMesh& mesh, std::span<const Count> offsets,
                                           const Pace& pace) {
  std::vector<unsigned char> repeats;
  pace.fill(repeats, mesh.face_count(), 0);
  std::vector<Index> sorted;
  for (Count f = 0; f < repeats.size(); ++f) {
    const Count size = offsets[f + 1] - offsets[f];
    const Index* const v = mesh.face_vertex_indices.data() + offsets[f];
    pace.spend(size);
    if (size == 3) {
      repeats[f] = v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
      continue;
    }
    sorted.assign(v, v + size);
    pace.sort(sorted.begin(), sorted.end(), std::less<>());
    repeats[f] = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
  }
  return repeats;
}

// Rearranges all that hangs on faces and corners. `faces`: old face of every new one; `corners`: old corner
// of every new one.
void rearrange(ControlMesh& mesh, const std::vector<Index>& faces, const std::vector<Index>& corners,
               const Pace& pace) {
  const Count old_faces = mesh.face_count(), old_corners = mesh.face_vertex_indices.size();
  std::vector<unsigned char> was_hole;
  pace.fill(was_hole, old_faces, 0);
  pace.for_each(mesh.hole_indices.size(), [&](Count k) { was_hole[mesh.hole_indices[k]] = 1; });
  mesh.hole_indices.clear();
  pace.for_each(static_cast<Index>(faces.size()), [&](Index f) {
    if (was_hole[faces[f]] != 0) mesh.hole_indices.push_back(f);
  });

  auto reindex = [&](std::vector<Index>& indices, const std::vector<Index>& order, Count old_size) {
    if (indices.empty()) {  // values in order: name them before the order changes
      indices.reserve(old_size);
      pace.for_each(old_size, [&](Count k) { indices.push_back(static_cast<Index>(k)); });
    }
    std::vector<Index> moved;
    moved.reserve(order.size());
    pace.for_each(order.size(), [&](Count k) { moved.push_back(indices[order[k]]); });
    indices = std::move(moved);
  };
  for (Primvar& primvar : mesh.primvars) {
    if (primvar.interpolation == Interpolation::uniform) reindex(primvar.indices, faces, old_faces);
    if (primvar.interpolation == Interpolation::face_varying) reindex(primvar.indices, corners, old_corners);
  }
  reindex(mesh.face_vertex_indices, corners, old_corners);
}

Count corners_of(const ControlMesh& mesh, Index begin, Index end) {
  if (mesh.face_vertex_counts.empty()) return 3 * Count{end - begin};
  const auto counts = std::span(mesh.face_vertex_counts).subspan(begin, end - begin);
  return std::accumulate(counts.begin(), counts.end(), Count{0});
}

// The parts of check() that rearranging relies on; the rest of a fault-ridden mesh stays as it is for
// check().
bool can_be_rearranged(const ControlMesh& mesh, const Pace& pace) {
  const Count faces = mesh.face_count();
  pace.spend(mesh.hole_indices.size() + mesh.primvars.size() + mesh.render_meshes.size());
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
        render.indices.size() != corners_of(mesh, render.face_begin, render.face_end))
      return false;
  return true;
}

bool creases_add_up(const ControlMesh& mesh) {
  Count points = 0, edges = 0;
  for (Index length : mesh.crease_lengths) {
    if (length < 2) return false;
    points += length;
    edges += length - 1;
  }
  return points == mesh.crease_indices.size() &&
         (mesh.crease_sharpnesses.size() == mesh.crease_lengths.size() ||
          mesh.crease_sharpnesses.size() == edges);
}

// Creases along edges that only dropped faces had: cut out, the rest kept as creases of single edges.
void drop_creases(ControlMesh& mesh, std::span<const Index> dropped_counts,
                  std::span<const Index> dropped_corners, const Pace& pace) {
  if (mesh.crease_lengths.empty() || !creases_add_up(mesh)) return;
  const auto points = static_cast<Index>(mesh.point_count());
  const std::vector<VertexPair> edges = crease_edges(mesh, pace);
  const auto were = are_edges(points, dropped_counts, dropped_corners, edges, pace);
  const auto are = are_edges(points, mesh.face_vertex_counts, mesh.face_vertex_indices, edges, pace);
  const auto vanished = [&](Count k) { return edges[k][0] == edges[k][1] || (were[k] != 0 && are[k] == 0); };
  bool any = false;
  pace.for_each(edges.size(), [&](Count k) { any |= vanished(k); });
  if (!any) return;
  std::vector<Index> indices, lengths;
  std::vector<float> sharpnesses;
  Count edge = 0;
  for_each_crease_edge(mesh, [&](Count, Index a, Index b, float sharpness) {
    pace.spend(1);
    if (vanished(edge++)) return;
    indices.insert(indices.end(), {a, b});
    lengths.push_back(2);
    sharpnesses.push_back(sharpness);
  });
  mesh.crease_indices = std::move(indices);
  mesh.crease_lengths = std::move(lengths);
  mesh.crease_sharpnesses = std::move(sharpnesses);
}

// A render mesh's face goes when the control face goes; one that repeats a render vertex repeats a point too.
void drop_render_faces(ControlMesh& mesh, const std::vector<unsigned char>& dropped, const Pace& pace) {
  std::vector<Index> kept_before;
  pace.fill(kept_before, dropped.size() + 1, 0);
  pace.for_each(dropped.size(), [&](Count f) { kept_before[f + 1] = kept_before[f] + (dropped[f] == 0); });
  for (RenderMesh& render : mesh.render_meshes) {
    std::vector<Index> indices;
    pace.spend(1);
    auto first = render.indices.begin();
    for (Index f = render.face_begin; f < render.face_end; ++f) {
      const auto end = first + static_cast<std::ptrdiff_t>(corners_of(mesh, f, f + 1));
      pace.spend(1);
      if (dropped[f] == 0) indices.insert(indices.end(), first, end);
      first = end;
    }
    render.indices = std::move(indices);
    render.face_begin = kept_before[render.face_begin];
    render.face_end = kept_before[render.face_end];
  }
}

Error nothing_left() {
  return Error{ErrorCode::not_a_triangle,
               "every face repeats a vertex: nothing is left to refine",
               {"faceVertexIndices"}};
}

// The fault that check() finds, or the budget's.
Error fault_of(const ControlMesh& mesh, const Budget& budget) {
  auto fine = mesh.check(budget);
  assert(!fine.ok());
  return std::move(fine).error();
}

bool has_repeats(std::span<const Index> triangles, const Pace& pace) {
  bool found = false;
  pace.in_blocks(triangles.size() / 3, [&](Count begin, Count end) {
    if (!found) found = any_repeats(triangles.subspan(3 * begin, 3 * (end - begin)));
  });
  return found;
}

}  // namespace

Result<std::vector<Index>> drop_degenerate_faces(ControlMesh& mesh, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) -> Result<std::vector<Index>> {
    const std::vector<Count> offsets = corner_offsets(mesh, pace);
    if (offsets.back() != mesh.face_vertex_indices.size()) {
      if (auto fine = mesh.check(budget); !fine) return std::move(fine).error();
    }
    if (has_triangles_only(mesh.face_vertex_counts, pace) && !has_repeats(mesh.face_vertex_indices, pace))
      return std::vector<Index>{};
    const std::vector<unsigned char> dropped = repeating_faces(mesh, offsets, pace);
    std::vector<Index> dropped_counts, dropped_corners, kept, corners, counts;
    pace.for_each(dropped.size(), [&](Count f) {
      const auto size = static_cast<Index>(offsets[f + 1] - offsets[f]),
                 first = static_cast<Index>(offsets[f]);
      pace.spend(size);
      if (dropped[f] == 0) {
        kept.push_back(static_cast<Index>(f));
        if (!mesh.face_vertex_counts.empty()) counts.push_back(size);
        for (Index k = 0; k < size; ++k) corners.push_back(first + k);
      } else if (!mesh.crease_indices.empty()) {
        const Index* const v = mesh.face_vertex_indices.data() + first;
        dropped_counts.push_back(size);
        dropped_corners.insert(dropped_corners.end(), v, v + size);
      }
    });
    if (kept.size() == dropped.size()) return std::vector<Index>{};
    if (!can_be_rearranged(mesh, pace)) return fault_of(mesh, budget);
    if (kept.empty()) return nothing_left();
    drop_render_faces(mesh, dropped, pace);
    rearrange(mesh, kept, corners, pace);
    mesh.face_vertex_counts = std::move(counts);
    drop_creases(mesh, dropped_counts, dropped_corners, pace);
    return kept;
  });
}

namespace {

// Why triangulate() refuses the mesh as it is.
Result<void> check_larger_faces(const ControlMesh& mesh, Count corners, const Budget& budget,
                                const Pace& pace) {
  for (Count f = 0; f < mesh.face_count(); ++f) {
    pace.spend(1);
    if (mesh.face_vertex_counts[f] < 3)
      return Error{ErrorCode::not_a_triangle,
                   "face " + std::to_string(f) + " has " + std::to_string(mesh.face_vertex_counts[f]) +
                       " vertices; a face has at least 3",
                   {"faceVertexCounts", std::uint64_t{f}}};
  }
  if (corners == mesh.face_vertex_indices.size() && can_be_rearranged(mesh, pace)) return {};
  if (auto fine = mesh.check(budget); !fine && fine.error().code != ErrorCode::not_a_triangle)
    return std::move(fine).error();
  // check() meets faces that repeat a vertex first: say what stands behind them.
  return Error{ErrorCode::wrong_length,
               "face-varying primvars, uniform primvars and holeIndices must fit the faces as they are given",
               {"primvars"}};
}

// Render meshes index the same corners. `offsets`: first corner of every old face.
void cut_render_faces(ControlMesh& mesh, std::span<const Count> offsets, const Triangulation& made,
                      const Pace& pace) {
  const auto first_triangle = [&](Index face) {
    return 3 * static_cast<Count>(std::ranges::lower_bound(made.faces, face) - made.faces.begin());
  };
  for (RenderMesh& render : mesh.render_meshes) {
    const Count begin = first_triangle(render.face_begin), end = first_triangle(render.face_end);
    std::vector<Index> indices;
    indices.reserve(end - begin);
    pace.spend(64);
    pace.for_each(end - begin, [&](Count k) {
      indices.push_back(render.indices[made.corners[begin + k] - offsets[render.face_begin]]);
    });
    render.indices = std::move(indices);
    render.face_begin = static_cast<Index>(begin / 3);
    render.face_end = static_cast<Index>(end / 3);
  }
}

}  // namespace

Result<Triangulation> triangulate(ControlMesh& mesh, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) -> Result<Triangulation> {
    if (has_triangles_only(mesh.face_vertex_counts, pace)) return Triangulation{};
    const std::vector<Count> offsets = corner_offsets(mesh, pace);
    if (auto fine = check_larger_faces(mesh, offsets.back(), budget, pace); !fine)
      return std::move(fine).error();
    const Count triangles = offsets.back() - 2 * mesh.face_count();
    Triangulation made;
    made.faces.reserve(triangles);
    made.corners.reserve(3 * triangles);
    Count largest = 0;
    pace.for_each(mesh.face_count(),
                  [&](Count f) { largest = std::max(largest, offsets[f + 1] - offsets[f]); });
    PolygonCutter cutter(mesh.points, largest);
    for (Index f = 0; f + Count{1} < offsets.size(); ++f) {
      const Count first = offsets[f], size = offsets[f + 1] - first, begin = made.corners.size();
      cutter.cut(std::span(mesh.face_vertex_indices).subspan(first, size), pace, made.corners);
      pace.for_each(size - 2, [&](Count) { made.faces.push_back(f); });
      pace.for_each(3 * (size - 2), [&](Count k) { made.corners[begin + k] += static_cast<Index>(first); });
    }
    cut_render_faces(mesh, offsets, made, pace);
    rearrange(mesh, made.faces, made.corners, pace);
    mesh.face_vertex_counts.clear();
    return made;
  });
}

Count triangulating_bytes(Count corners) { return PolygonCutter::working_bytes(corners); }

}  // namespace subdivd

#include "tests/core/engine/kobbelt_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/engine/plain/split.h"
#include "tests/shapes/build.h"
#include "tests/shapes/polygons.h"

namespace subdivd::plain {

std::vector<shapes::NamedShape> kobbelt_meshes() {
  std::vector<shapes::NamedShape> meshes;
  const auto add = [&](const std::string& name, ControlMesh mesh) {
    const auto semi_sharp = [](float s) { return is_semi_sharp(s); };
    if (std::ranges::any_of(mesh.crease_sharpnesses, semi_sharp) ||
        std::ranges::any_of(mesh.corner_sharpnesses, semi_sharp))
      return;
    const auto four = [](Index n) { return n == 4; };
    if (mesh.face_vertex_counts.empty() || !std::ranges::all_of(mesh.face_vertex_counts, four)) {
      if (!mesh.crease_lengths.empty()) return;
      const Level level = base_level(mesh);
      const Adjacency split = split_faces(Split::quads, level.faces, {});
      mesh.points.resize(3 * std::size_t{split.vertex_count()});
      for (Index v = level.faces.vertex_count(); v < split.vertex_count(); ++v)
        for (Index axis = 0; axis < 3; ++axis) mesh.points[3 * v + axis] = std::sin(v + 2.0 * axis);
      mesh.face_vertex_indices.assign(split.corners().begin(), split.corners().end());
      mesh.face_vertex_counts.assign(split.face_count(), 4);
      mesh.hole_indices.clear();
      mesh.primvars.clear();
    }
    meshes.push_back({name, mesh});
  };
  for (const auto& [name, mesh] : shapes::polygon_shapes()) add(name, mesh);
  for (const auto& [name, mesh] : shapes::non_manifold_shapes()) add(name, mesh);
  for (Index seed = 1; seed <= 30; ++seed)
    add("random_" + std::to_string(seed),
        shapes::with_joined_faces(shapes::random_mesh(seed), 4 + seed % 6, seed));
  return meshes;
}

ControlMesh flat_disk(Index n) {
  std::vector<shapes::Point> points{{0, 0, 0}};
  for (Index k = 0; k < 2 * n; ++k) {
    const double angle = std::numbers::pi * k / n,
                 radius = k % 2 == 0 ? 1 : 2 * std::cos(std::numbers::pi / n);
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  ControlMesh mesh = shapes::mesh_of(points, {});
  for (std::size_t v = 0; v < points.size(); ++v)
    for (std::size_t axis = 0; axis < 3; ++axis) mesh.points[3 * v + axis] = points[v][axis];
  for (Index k = 0; k < n; ++k) {
    mesh.face_vertex_counts.push_back(4);
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(),
                                    {0, 2 * k + 1, 2 * k + 2, (2 * k + 2) % (2 * n) + 1});
  }
  return mesh;
}

void KobbeltSurface::refine() {
  points = applied(step_rows(Kobbelt{}, level, false));
  level = next_level(level, Split::quads, CreaseMethod::uniform);
}

double KobbeltSurface::nearest(const double* point) const {
  double least = 1e9;
  for (std::size_t k = 0; k < points.size(); k += 3)
    least =
        std::min(least, std::hypot(points[k] - point[0], points[k + 1] - point[1], points[k + 2] - point[2]));
  return least;
}

}  // namespace subdivd::plain

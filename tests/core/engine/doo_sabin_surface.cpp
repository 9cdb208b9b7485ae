#include "tests/core/engine/doo_sabin_surface.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/shapes/build.h"
#include "tests/shapes/polygons.h"

namespace subdivd::plain {

std::vector<shapes::NamedShape> doo_sabin_meshes() {
  std::vector<shapes::NamedShape> meshes = shapes::polygon_shapes();
  for (const auto& shape : shapes::non_manifold_shapes()) meshes.push_back(shape);
  for (const auto& shape : shapes::border_shapes()) meshes.push_back(shape);
  for (Index seed = 1; seed <= 40; ++seed)
    meshes.push_back({"random_" + std::to_string(seed),
                      shapes::with_joined_faces(shapes::random_mesh(seed), 4 + seed % 6, seed)});
  // A vertex of two faces beside one that a crease passes between two faces; three creases that meet, and five.
  for (const auto& [name, mesh] : shapes::polygon_shapes()) {
    const auto add = [&](const std::string& word, const std::vector<std::vector<Index>>& creases) {
      shapes::NamedShape with{name + word, mesh};
      for (const std::vector<Index>& crease : creases) shapes::crease(with.mesh, crease, kInfiniteSharpness);
      meshes.push_back(with);
    };
    if (name == "valence_two") add("_beside_crease", {{2, 0, 4}});
    if (name == "quad_cube") add("_three_creases", {{1, 0, 2}, {0, 4}});
    if (name == "triangles_alone") {
      std::vector<std::vector<Index>> around;
      for (const auto& [a, b] : shapes::edges_of(mesh))
        if (a == 0) around.push_back({a, b});
      add("_five_creases", around);
    }
  }
  std::erase_if(meshes, [](const shapes::NamedShape& shape) {
    const auto semi_sharp = [](float s) { return is_semi_sharp(s); };
    return std::ranges::any_of(shape.mesh.crease_sharpnesses, semi_sharp) ||
           std::ranges::any_of(shape.mesh.corner_sharpnesses, semi_sharp);
  });
  return meshes;
}

Level first_of(const ControlMesh& mesh) {
  Level level = base_level(mesh);
  if (mesh.interpolate_boundary == BoundaryInterpolation::none) open_borders(level, mesh);
  return level;
}

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace subdivd::plain

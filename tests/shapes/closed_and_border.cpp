// Smooth surfaces: closed fans of every valence, and what ends at a border.
#include "tests/shapes/build.h"

namespace subdivd::shapes {
namespace {

// A hyperbolic paraboloid: curvatures of opposite sign, no symmetry of the triangles.
ControlMesh saddle() {
  ControlMesh mesh = grid(4, 3);
  for (std::size_t p = 0; p < mesh.point_count(); ++p)
    mesh.points[3 * p + 2] = mesh.points[3 * p] * mesh.points[3 * p + 1];
  return mesh;
}

// Border edges tagged sharp: in mode `none` tags decide what becomes of the border.
ControlMesh grid_with_tagged_border() {
  ControlMesh mesh = grid(4, 4);
  crease(mesh, {0, 1, 2}, 10);         // lower border, left half
  crease(mesh, {4, 9, 14, 19}, 1.5f);  // right border
  corner(mesh, 24, 10);
  corner(mesh, 22, 1.2f);
  return mesh;
}

ControlMesh tube_with_both_ends_sharp() {
  ControlMesh mesh = tube(5, 3);
  crease(mesh, {0, 1, 2, 3, 4, 0}, 10);
  crease(mesh, {15, 16, 17, 18, 19, 15}, 10);
  return mesh;
}

ControlMesh unreferenced_points() {
  ControlMesh mesh = octahedron();
  mesh.points.insert(mesh.points.end(), {2, 2, 2, -2, 0.5, 1});
  mesh.points.insert(mesh.points.begin(), {1.5, -1.5, 0.25});
  for (Index& v : mesh.face_vertex_indices) ++v;
  return mesh;
}

// The same three points from both sides: closed, and every point has valence 2.
ControlMesh pillow() { return mesh_of({{0, 0, 0}, {1, 0, 0.1}, {0.3, 0.9, 0}}, {{0, 1, 2}, {0, 2, 1}}); }

}  // namespace

std::vector<NamedShape> closed_shapes() {
  std::vector<NamedShape> shapes;
  shapes.push_back(named("closed_tetrahedron", tetrahedron()));
  shapes.push_back(named("closed_icosahedron", icosahedron()));
  shapes.push_back(named("closed_cube", cube()));
  shapes.push_back(named("closed_torus_regular", torus(4, 5)));
  shapes.push_back(named("closed_torus_mixed_valences", big_torus(5, 6, 3)));
  shapes.push_back(named("closed_pillow_valence_2", pillow()));
  for (const Index n : {3u, 4u, 5u, 6u, 7u, 8u, 9u, 10u, 11u, 12u, 100u})
    shapes.push_back(named("closed_fan_valence_" + std::to_string(n), double_pyramid(n)));
  shapes.push_back(named("closed_two_components", join(double_pyramid(5), tetrahedron(), {2, 1, 0})));
  shapes.push_back(named("closed_unreferenced_points", unreferenced_points()));
  return shapes;
}

std::vector<NamedShape> border_shapes() {
  std::vector<NamedShape> shapes;
  add_in_all_boundaries(shapes, "border_single_triangle", open_fan(1));
  for (const Index faces : {2u, 3u, 4u, 7u})
    add_in_all_boundaries(shapes, "border_valence_" + std::to_string(faces + 1), open_fan(faces));
  add_in_all_boundaries(shapes, "border_strip", grid(4, 1));
  for (const Index n : {3u, 5u, 8u})
    add_in_all_boundaries(shapes, "border_disk_valence_" + std::to_string(n), disk(n));
  add_in_all_boundaries(shapes, "border_grid", grid(3, 4));
  add_in_all_boundaries(shapes, "border_tube", tube(5, 3));
  add_in_all_boundaries(shapes, "border_tube_tagged_infinite", tube_with_both_ends_sharp());
  add_in_all_boundaries(shapes, "border_grid_tagged", grid_with_tagged_border());
  add_in_all_boundaries(shapes, "border_saddle", saddle());
  add_in_all_boundaries(shapes, "border_beside_closed", join(grid(2, 2), tetrahedron(), {0, 0, 3}));
  return shapes;
}

}  // namespace subdivd::shapes

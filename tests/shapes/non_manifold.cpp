// Edges and points that are not locally a disk: infinitely sharp, accepted.
#include "tests/shapes/build.h"

namespace subdivd::shapes {
namespace {

// `faces` triangles around the edge 0-1.
ControlMesh book(Index faces) {
  const std::vector<Point> tips = {{1, 0, 0.4}, {-1, 0.1, 0.5}, {0, 1, 0.6}, {0.1, -1, 0.3}};
  std::vector<Point> points = {{0, 0, 0}, {0, 0, 1}};
  std::vector<Triangle> triangles;
  for (Index k = 0; k < faces; ++k) {
    points.push_back(tips[k]);
    triangles.push_back(k % 2 == 0 ? Triangle{0, 1, 2 + k} : Triangle{1, 0, 2 + k});
  }
  return mesh_of(points, triangles);
}

void add_face(ControlMesh& mesh, Index a, Index b, Index c) {
  mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {a, b, c});
}

// The mesh with a triangle standing on edge a-b.
ControlMesh with_fin(ControlMesh mesh, Index a, Index b) {
  const auto tip = static_cast<Index>(mesh.point_count());
  for (std::size_t k = 0; k < 3; ++k)
    mesh.points.push_back(1.4 * (mesh.points[3 * a + k] + mesh.points[3 * b + k]) / 2);
  add_face(mesh, a, b, tip);
  return mesh;
}

// The first point of `b` is merged into point `at` of `a`.
ControlMesh bow_tie(const ControlMesh& a, Index at, const ControlMesh& b, const Point& offset) {
  ControlMesh both = join(a, b, offset);
  const auto first = static_cast<Index>(a.point_count());
  for (Index& v : both.face_vertex_indices)
    if (v == first)
      v = at;
    else if (v > first)
      --v;
  const auto from = both.points.begin() + 3 * std::ptrdiff_t{first};
  both.points.erase(from, from + 3);
  return both;
}

ControlMesh moebius() {
  ControlMesh mesh = tube(6, 1);
  for (std::size_t c = 0; c < mesh.face_vertex_indices.size(); ++c) {
    Index& v = mesh.face_vertex_indices[c];
    if (c >= 30 && (v == 0 || v == 6)) v = 6 - v;  // the last quad closes with a half turn
  }
  return mesh;
}

}  // namespace

std::vector<NamedShape> non_manifold_shapes() {
  std::vector<NamedShape> shapes;
  add_in_all_boundaries(shapes, "non_manifold_three_faces", book(3));
  shapes.push_back(named("non_manifold_four_faces", book(4)));
  shapes.push_back(named("non_manifold_fin_on_torus", with_fin(torus(4, 5), 7, 8)));
  add_in_all_boundaries(shapes, "non_manifold_fin_on_grid", with_fin(grid(4, 4), 11, 12));
  shapes.push_back(named("non_manifold_two_fins_in_a_row", with_fin(with_fin(torus(4, 5), 7, 8), 8, 9)));

  ControlMesh creased = with_fin(torus(4, 5), 7, 8);
  crease(creased, {6, 7, 8, 9}, 1.5f);
  crease(creased, {2, 7, 12}, 10);
  corner(creased, 9, 0.7f);
  shapes.push_back(named("non_manifold_crease_through", creased));

  shapes.push_back(named("bow_tie_closed", bow_tie(double_pyramid(5), 0, tetrahedron(), {-1, -1, 0})));
  shapes.push_back(named("bow_tie_closed_and_open", bow_tie(double_pyramid(5), 0, open_fan(3), {0, 0, 0.6})));
  add_in_all_boundaries(shapes, "bow_tie_open", bow_tie(open_fan(3), 0, open_fan(2), {0, -0.2, -0.3}));
  shapes.push_back(named("bow_tie_of_triangles", bow_tie(open_fan(1), 0, open_fan(1), {0, 0, -0.5})));
  ControlMesh three = bow_tie(bow_tie(open_fan(2), 0, open_fan(1), {0, 0, -0.5}), 0, disk(5), {0, 0, 1});
  shapes.push_back(named("bow_tie_of_three_fans", three));
  ControlMesh creased_tie = bow_tie(double_pyramid(5), 0, disk(6), {0, 0, 1});
  crease(creased_tie, {2, 0, 4}, 2.3f);
  shapes.push_back(named("bow_tie_crease_through", creased_tie));

  // Both faces run along the shared edge in the same direction.
  shapes.push_back(named(
      "winding_clash", mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.9, 0.9, 0.3}}, {{0, 1, 2}, {1, 2, 3}})));
  ControlMesh flipped = grid(3, 3);
  std::swap(flipped.face_vertex_indices[3 * 8], flipped.face_vertex_indices[3 * 8 + 1]);
  add_in_all_boundaries(shapes, "winding_one_face_flipped", flipped);
  shapes.push_back(named("winding_moebius", moebius()));

  ControlMesh duplicate = grid(2, 2);
  add_face(duplicate, 0, 1, 4);  // face 0 again
  shapes.push_back(named("duplicate_face_at_border", duplicate));
  ControlMesh duplicate_inside = octahedron();
  add_face(duplicate_inside, 2, 3, 0);  // face 0 again, from its second corner
  shapes.push_back(named("duplicate_face_inside", duplicate_inside));
  ControlMesh back_to_back = grid(2, 2);
  add_face(back_to_back, 4, 1, 0);  // face 0 seen from behind
  shapes.push_back(named("duplicate_face_back_to_back", back_to_back));
  return shapes;
}

}  // namespace subdivd::shapes

// Everything that is refined beside positions.
#include <algorithm>
#include <tuple>

#include "tests/shapes/build.h"

namespace subdivd::shapes {
namespace {

ControlMesh with_tube_cut() {
  // Columns run 0..5 and meet at column 0: the seam goes from border to border.
  ControlMesh mesh = tube(6, 3);
  mesh.primvars.push_back(seamed(mesh, "st", 2, edges_along({0, 6, 12, 18})));
  return mesh;
}

ControlMesh with_atlas() {
  ControlMesh mesh = cube();
  std::vector<Edge> seams;  // the cube's edges, not its diagonals: points of an edge differ in one bit
  for (const auto& [a, b] : edges_of(mesh))
    if (((a ^ b) & ((a ^ b) - 1)) == 0) seams.emplace_back(a, b);
  mesh.primvars.push_back(seamed(mesh, "st", 2, seams));
  return mesh;
}

ControlMesh with_seam(ControlMesh mesh, const std::vector<Index>& path) {
  mesh.primvars.push_back(seamed(mesh, "st", 2, edges_along(path)));
  return mesh;
}

// One triangle in the middle is an island: its points have one face there, and concave corners around.
ControlMesh with_island() {
  ControlMesh mesh = torus(4, 5);
  const auto& v = mesh.face_vertex_indices;
  mesh.primvars.push_back(seamed(mesh, "st", 2, edges_along({v[24], v[25], v[26], v[24]})));
  return mesh;
}

// Two points use one value: connected in the channel only by number.
ControlMesh with_shared_value() {
  ControlMesh mesh = with_seam(grid(4, 4), {2, 7, 12});
  auto& indices = mesh.primvars[0].indices;
  const Index from = indices[0], to = indices[indices.size() - 1];
  std::replace(indices.begin(), indices.end(), from, to);
  return mesh;
}

// Four seams meet at the tip, opposite sectors use the same value again.
ControlMesh with_bow_tie_values() {
  ControlMesh mesh = double_pyramid(8);
  Primvar st = seamed(mesh, "st", 2, {{0, 2}, {0, 4}, {0, 6}, {0, 8}});
  std::vector<Index> at_tip;  // values at point 0, in order of appearance
  for (std::size_t c = 0; c < st.indices.size(); ++c)
    if (mesh.face_vertex_indices[c] == 0 &&
        std::find(at_tip.begin(), at_tip.end(), st.indices[c]) == at_tip.end())
      at_tip.push_back(st.indices[c]);
  std::replace(st.indices.begin(), st.indices.end(), at_tip[2], at_tip[0]);
  std::replace(st.indices.begin(), st.indices.end(), at_tip[3], at_tip[1]);
  mesh.primvars.push_back(std::move(st));
  return mesh;
}

// Two values by number, one by content: still a seam.
ControlMesh with_equal_values() {
  ControlMesh mesh = with_seam(torus(4, 5), {6, 7, 8, 9});
  Primvar& st = mesh.primvars[0];
  const auto& v = mesh.face_vertex_indices;
  for (std::size_t c = 0; c < v.size(); ++c)
    for (Index k = 0; k < 2; ++k) st.values[2 * st.indices[c] + k] = mesh.points[3 * v[c] + k];
  return mesh;
}

ControlMesh with_crease_across_seam() {
  ControlMesh mesh = with_seam(torus(5, 6), {7, 8, 9, 10});
  crease(mesh, {2, 8, 14, 20}, 10);
  return mesh;
}

ControlMesh with_semi_sharp_reaching_seam() {
  ControlMesh mesh = with_seam(torus(5, 6), {6, 7, 8, 9, 10, 11, 6});
  crease(mesh, {8, 14, 20}, 1.5f);
  crease(mesh, {9, 10}, 2.3f);  // along the seam
  corner(mesh, 7, 0.7f);
  return mesh;
}

ControlMesh with_fin_and_seam() {
  ControlMesh mesh = torus(4, 5);
  mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {7, 8, 20});
  mesh.points.insert(mesh.points.end(), {1.5, 1.2, 0.4});
  return with_seam(std::move(mesh), {7, 8, 9});
}

ControlMesh with_two_channels() {
  ControlMesh mesh = with_seam(grid(3, 3), {1, 5, 9});
  mesh.primvars.push_back(seamed(mesh, "displayColor", 3, edges_along({4, 5, 6, 7})));
  mesh.primvars.push_back(unindexed(mesh, "id", 1));
  mesh.hole_indices = {4};
  return mesh;
}

ControlMesh with_unindexed() {
  ControlMesh mesh = grid(2, 3);
  mesh.primvars.push_back(unindexed(mesh, "st", 2));
  return mesh;
}

}  // namespace

std::vector<NamedShape> seam_shapes() {
  std::vector<NamedShape> shapes;
  add_in_all_modes(shapes, "seam_none_on_grid", with_seam(grid(3, 3), {}));
  add_in_all_modes(shapes, "seam_tube", with_tube_cut());
  add_in_all_modes(shapes, "seam_cube_atlas", with_atlas());
  add_in_all_modes(shapes, "seam_dart", with_seam(torus(5, 6), {7, 8, 9, 10}));
  add_in_all_modes(shapes, "seam_loop", with_seam(torus(5, 6), {6, 7, 8, 9, 10, 11, 6}));
  add_in_all_modes(shapes, "seam_from_border", with_seam(grid(4, 4), {2, 7, 12}));
  add_in_all_modes(shapes, "seam_across_strip", with_seam(grid(4, 1), {2, 7}));
  add_in_all_modes(shapes, "seam_island", with_island());
  add_in_all_modes(shapes, "seam_three_at_a_point", with_seam(double_pyramid(7), {2, 0, 4, 1, 6, 0}));
  add_in_all_modes(shapes, "seam_valence_3", with_seam(tetrahedron(), {0, 1, 2}));
  add_in_all_modes(shapes, "seam_across_crease", with_crease_across_seam());
  add_in_all_modes(shapes, "seam_reached_by_semi_sharp", with_semi_sharp_reaching_seam());
  add_in_all_modes(shapes, "seam_value_of_two_points", with_shared_value());
  add_in_all_modes(shapes, "seam_bow_tie_values", with_bow_tie_values());
  add_in_all_modes(shapes, "seam_equal_values", with_equal_values());
  add_in_all_modes(shapes, "seam_non_manifold", with_fin_and_seam());
  add_in_all_modes(shapes, "seam_two_channels_and_hole", with_two_channels());
  add_in_all_modes(shapes, "seam_unindexed", with_unindexed());
  add_in_all_boundaries(shapes, "seam_boundary", with_seam(grid(4, 4), {2, 7, 12, 13}));
  return shapes;
}

std::vector<NamedShape> primvar_shapes() {
  using enum Interpolation;
  std::vector<NamedShape> shapes;
  ControlMesh base = grid(3, 2);
  crease(base, {4, 5, 6}, 1.5f);
  base.hole_indices = {3};
  for (const auto& [word, interpolation] : {std::pair{"constant", constant},
                                            {"uniform", uniform},
                                            {"varying", varying},
                                            {"vertex", vertex},
                                            {"face_varying", face_varying}})
    for (const Index size : {1u, 2u, 5u, 17u}) {
      ControlMesh mesh = base;
      mesh.primvars.push_back(plain_primvar(mesh, "p", interpolation, size));
      shapes.push_back(named(std::string("primvar_") + word + "_" + std::to_string(size), mesh));
    }

  ControlMesh indexed = double_pyramid(5);
  for (const auto& [name, interpolation, elements] :
       {std::tuple<const char*, Interpolation, Index>{"a", constant, 1},
        {"b", uniform, 10},
        {"c", varying, 7},
        {"d", vertex, 7}}) {
    Primvar primvar{name, interpolation, 2, {0.25, -1, 0.5, 0.75, -0.5, 0.125}, {}};  // three values for all
    for (Index k = 0; k < elements; ++k) primvar.indices.push_back((k * k + 1) % 3);
    indexed.primvars.push_back(std::move(primvar));
  }
  shapes.push_back(named("primvar_indexed", indexed));

  ControlMesh many = torus(3, 4);
  for (const Index size : {1u, 3u, 4u, 16u})
    many.primvars.push_back(plain_primvar(many, "vertex_" + std::to_string(size), vertex, size));
  many.primvars.push_back(plain_primvar(many, "w", varying, 3));
  many.primvars.push_back(seamed(many, "st", 2, edges_along({0, 1, 2, 3, 0})));
  many.primvars.push_back(plain_primvar(many, "u", uniform, 1));
  shapes.push_back(named("primvar_many_at_once", many));
  return shapes;
}

}  // namespace subdivd::shapes

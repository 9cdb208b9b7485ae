// Sharp features: creases, darts, corners, holes.
#include <string>

#include "tests/shapes/build.h"

namespace subdivd::shapes {
namespace {

struct Sharpness {
  const char* word;
  float value;
};
// Below 1 blends at once, 1 vanishes exactly, 2.3 rounds at every step in single precision.
constexpr Sharpness kSharpnesses[] = {{"half", 0.5f}, {"one", 1}, {"2_3", 2.3f}, {"infinite", 10}};

// The torus of every crease below: point (column, row) = 6 row + column, 5 rows of 6.
ControlMesh base_torus() { return torus(5, 6); }

void add_for_each_sharpness(std::vector<NamedShape>& shapes) {
  for (const auto& [word, s] : kSharpnesses) {
    ControlMesh loop = double_pyramid(6);
    crease(loop, {2, 3, 4, 5, 6, 7, 2}, s);
    shapes.push_back(named(std::string("crease_loop_") + word, loop));

    ControlMesh dart = base_torus();  // ends inside on both sides
    crease(dart, {7, 8, 9, 10}, s);
    shapes.push_back(named(std::string("crease_darts_") + word, dart));

    ControlMesh to_border = grid(4, 4);
    crease(to_border, {2, 7, 12}, s);
    shapes.push_back(named(std::string("crease_from_border_") + word, to_border));
  }
}

void add_crossings(std::vector<NamedShape>& shapes) {
  ControlMesh three = double_pyramid(7);
  crease(three, {0, 2}, 2);
  crease(three, {0, 4}, 3);
  crease(three, {0, 7}, 1.5f);
  shapes.push_back(named("crease_three_at_a_point", three));

  ControlMesh cross = base_torus();
  crease(cross, {6, 7, 8, 9, 10}, 10);
  crease(cross, {2, 8, 14, 20}, 10);
  shapes.push_back(named("crease_cross_infinite", cross));

  ControlMesh cross_semi = base_torus();
  crease(cross_semi, {6, 7, 8, 9, 10}, 2.3f);
  crease(cross_semi, {2, 8, 14, 20}, 0.6f);
  shapes.push_back(named("crease_cross_semi_sharp", cross_semi));

  ControlMesh five = double_pyramid(5);
  for (Index k = 2; k < 7; ++k) crease(five, {0, k}, 0.4f * static_cast<float>(k));
  shapes.push_back(named("crease_five_at_a_point", five));

  ControlMesh all = tetrahedron();
  for (const auto& [a, b] : edges_of(all)) crease(all, {a, b}, 10);
  shapes.push_back(named("crease_all_edges_infinite", all));

  ControlMesh all_semi = cube();
  for (const auto& [a, b] : edges_of(all_semi)) crease(all_semi, {a, b}, 1.7f);
  shapes.push_back(named("crease_all_edges_semi_sharp", all_semi));
}

// Where Chaikin's rule differs from the uniform one: sharpness changes from edge to edge.
void add_varying_along(std::vector<NamedShape>& shapes) {
  ControlMesh loop = double_pyramid(6);
  crease_by_edge(loop, {2, 3, 4, 5, 6, 7, 2}, {0.5f, 1, 2.3f, 3.7f, 2, 1.2f});
  shapes.push_back(named("crease_varying_loop", loop));

  ControlMesh darts = base_torus();
  crease_by_edge(darts, {6, 7, 8, 9, 10}, {3, 1.5f, 0.75f, 0.25f});
  shapes.push_back(named("crease_varying_to_darts", darts));

  ControlMesh mixed = base_torus();
  crease_by_edge(mixed, {6, 7, 8, 9, 10, 11, 6}, {10, 10, 2.5f, 4, 0.3f, 10});
  shapes.push_back(named("crease_varying_with_infinite", mixed));

  ControlMesh zero = base_torus();  // an edge of sharpness 0 in the middle is no crease
  crease_by_edge(zero, {6, 7, 8, 9}, {2, 0, 1.5f});
  shapes.push_back(named("crease_varying_through_zero", zero));

  ControlMesh border = grid(4, 4);
  crease_by_edge(border, {10, 11, 12, 13, 14}, {0.4f, 1.9f, 3.1f, 1});
  shapes.push_back(named("crease_varying_border_to_border", border));

  ControlMesh tips = double_pyramid(8);
  crease_by_edge(tips, {2, 0, 5, 1}, {2.2f, 3.8f, 1.1f});
  shapes.push_back(named("crease_varying_over_valence_8", tips));

  ControlMesh three = double_pyramid(7);
  crease_by_edge(three, {2, 0, 4}, {2.2f, 3.8f});
  crease_by_edge(three, {0, 7}, {1.1f});
  shapes.push_back(named("crease_varying_three_at_a_point", three));
}

void add_special_creases(std::vector<NamedShape>& shapes) {
  ControlMesh dart3 = tetrahedron();
  crease(dart3, {0, 1}, 10);
  shapes.push_back(named("crease_single_edge_valence_3", dart3));

  ControlMesh through3 = double_pyramid(3);
  crease(through3, {2, 0, 3}, 10);
  shapes.push_back(named("crease_through_valence_3", through3));

  ControlMesh through12 = double_pyramid(12);
  crease(through12, {2, 0, 8, 1, 2}, 10);
  shapes.push_back(named("crease_through_valence_12", through12));

  ControlMesh huge = octahedron();
  crease(huge, {2, 3, 4, 5, 2}, 1e38f);
  shapes.push_back(named("crease_sharpness_1e38", huge));

  ControlMesh twice = base_torus();  // the second crease overrides the first on one edge
  crease(twice, {6, 7, 8, 9}, 3);
  crease(twice, {8, 7}, 0.5f);
  shapes.push_back(named("crease_edge_named_twice", twice));

  ControlMesh along_border = grid(4, 3);
  crease(along_border, {5, 10, 15}, 1.5f);
  crease(along_border, {2, 3, 8}, 2.5f);
  add_in_all_boundaries(shapes, "crease_along_border", along_border);

  ControlMesh ends_at_crease = base_torus();
  crease(ends_at_crease, {6, 7, 8, 9, 10, 11, 6}, 10);
  crease(ends_at_crease, {8, 14, 20}, 1.3f);
  shapes.push_back(named("crease_semi_sharp_meets_infinite", ends_at_crease));

  ControlMesh parallel = icosahedron();
  crease(parallel, {1, 2, 3, 4, 5, 1}, 2.3f);
  crease(parallel, {6, 7, 8, 9, 10, 6}, 0.8f);
  shapes.push_back(named("crease_two_loops", parallel));
}

}  // namespace

std::vector<NamedShape> crease_shapes() {
  std::vector<NamedShape> shapes;
  add_for_each_sharpness(shapes);
  add_crossings(shapes);
  add_varying_along(shapes);
  add_special_creases(shapes);
  return shapes;
}

std::vector<NamedShape> corner_shapes() {
  std::vector<NamedShape> shapes;
  for (const auto& [word, s] : {Sharpness{"0_7", 0.7f}, {"2_5", 2.5f}, {"infinite", 10}}) {
    ControlMesh inside = double_pyramid(7);
    corner(inside, 0, s);
    corner(inside, 4, s);
    shapes.push_back(named(std::string("corner_inside_") + word, inside));

    ControlMesh border = grid(3, 3);
    corner(border, 0, s);  // a corner of the grid
    corner(border, 2, s);  // the middle of a side
    corner(border, 3, s);
    add_in_all_boundaries(shapes, std::string("corner_border_") + word, border);

    ControlMesh creased = double_pyramid(6);
    crease(creased, {2, 3, 4, 5, 6, 7, 2}, 1.5f);
    corner(creased, 3, s);
    shapes.push_back(named(std::string("corner_on_crease_") + word, creased));

    ControlMesh dart = torus(4, 5);
    crease(dart, {6, 7, 8}, 10);
    corner(dart, 8, s);
    shapes.push_back(named(std::string("corner_at_dart_") + word, dart));
  }
  ControlMesh zero = octahedron();
  corner(zero, 0, 0);
  shapes.push_back(named("corner_sharpness_0", zero));

  ControlMesh hole = grid(4, 4);
  hole.hole_indices = {0, 11, 12};  // one at the border, two beside each other
  add_in_all_boundaries(shapes, "hole_grid", hole);
  ControlMesh creased_hole = torus(4, 5);
  crease(creased_hole, {6, 7, 8}, 2.3f);
  creased_hole.hole_indices = {10, 13, 12};
  shapes.push_back(named("hole_beside_crease", creased_hole));
  ControlMesh fan_hole = double_pyramid(5);
  fan_hole.hole_indices = {0, 2, 4, 6, 8};  // the whole upper half
  shapes.push_back(named("hole_whole_fan", fan_hole));
  return shapes;
}

}  // namespace subdivd::shapes

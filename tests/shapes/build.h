#pragma once
// The bricks of the named shapes: plain cages, tags, seams.

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/control_mesh.h"
#include "tests/shapes/shapes.h"

namespace subdivd::shapes {

using Point = std::array<double, 3>;
using Triangle = std::array<Index, 3>;
using Edge = std::pair<Index, Index>;

// The points are moved by up to 0.04 along every axis, by a hash of their number.
ControlMesh mesh_of(const std::vector<Point>& points, const std::vector<Triangle>& triangles);

// Two tips (points 0 above, 1 below) of the given valence over a ring of points 2, 3, …; ring points have
// valence 4.
ControlMesh double_pyramid(Index valence);
// A closed fan around point 0; points 1, 2, … are the border. `height` lifts the centre.
ControlMesh disk(Index valence, double height = 0.4);
// `faces` triangles around point 0, which lies on the border: its valence is faces + 1.
ControlMesh open_fan(Index faces);
// columns x rows quads over [-1, 1]^2, point (column, row) = row * (columns + 1) + column. Diagonals rise to
// the right.
ControlMesh grid(Index columns, Index rows);
// Point (column, row) = row * columns + column; columns run around, rows along; both ends open.
ControlMesh tube(Index columns, Index rows);
// Point (column, row) = row * columns + column; closed both ways, all valences 6. columns, rows >= 3.
ControlMesh torus(Index rows, Index columns);
ControlMesh tetrahedron();
ControlMesh octahedron();
ControlMesh icosahedron();
// 8 corners, 12 triangles; point = x + 2 y + 4 z for x, y, z in {0, 1}.
ControlMesh cube();
// b's points are moved by `offset` and numbered after a's.
ControlMesh join(const ControlMesh& a, const ControlMesh& b, const Point& offset);

void crease(ControlMesh& mesh, const std::vector<Index>& points, float sharpness);
// One sharpness per edge. Do not mix with the one above in one mesh.
void crease_by_edge(ControlMesh& mesh, const std::vector<Index>& points,
                    const std::vector<float>& sharpnesses);
void corner(ControlMesh& mesh, Index point, float sharpness);

// A face-varying primvar that is continuous everywhere but across `seams`: corners of one point share a value
// when a chain of edges that are no seams joins them. Values differ clearly across seams.
Primvar seamed(const ControlMesh& mesh, std::string name, Index element_size, const std::vector<Edge>& seams);
// One value of its own for every face corner; no indices.
Primvar unindexed(const ControlMesh& mesh, std::string name, Index element_size);
// Values for a primvar of any other interpolation, one per element.
Primvar plain_primvar(const ControlMesh& mesh, std::string name, Interpolation interpolation,
                      Index element_size);

// Consecutive points of a polyline as edges.
std::vector<Edge> edges_along(const std::vector<Index>& points);
// All edges of the mesh, each once, lower end first, in ascending order.
std::vector<Edge> edges_of(const ControlMesh& mesh);

NamedShape named(std::string name, ControlMesh mesh);
// name_none, name_edge_only, name_edge_and_corner
void add_in_all_boundaries(std::vector<NamedShape>& shapes, const std::string& name, const ControlMesh& mesh);
// name_none, name_corners_only, name_corners_plus1, … name_all
void add_in_all_modes(std::vector<NamedShape>& shapes, const std::string& name, const ControlMesh& mesh);

}  // namespace subdivd::shapes

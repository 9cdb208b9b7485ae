#include "tests/shapes/build.h"

#include <cmath>
#include <numbers>

#include "tests/shapes/random.h"

namespace subdivd::shapes {
namespace {

constexpr double kWobble = 0.04;

double turn(Index i, Index n) { return 2 * std::numbers::pi * i / n; }

Point at(const ControlMesh& mesh, Index point) {
  return {mesh.points[3 * point], mesh.points[3 * point + 1], mesh.points[3 * point + 2]};
}

// Two triangles of the quad a b c d (counter-clockwise), split along a c.
void add_quad(std::vector<Triangle>& triangles, Index a, Index b, Index c, Index d) {
  triangles.push_back({a, b, c});
  triangles.push_back({a, c, d});
}

}  // namespace

ControlMesh mesh_of(const std::vector<Point>& points, const std::vector<Triangle>& triangles) {
  ControlMesh mesh;
  for (Index p = 0; p < points.size(); ++p) {
    Random random(p + 1);
    for (const double x : points[p]) mesh.points.push_back(x + kWobble * random.centred());
  }
  for (const Triangle& t : triangles)
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), t.begin(), t.end());
  return mesh;
}

ControlMesh double_pyramid(Index valence) {
  std::vector<Point> points = {{0, 0, 0.8}, {0, 0, -0.7}};
  std::vector<Triangle> triangles;
  for (Index i = 0; i < valence; ++i) {
    points.push_back({std::cos(turn(i, valence)), std::sin(turn(i, valence)), 0});
    const Index here = 2 + i, next = 2 + (i + 1) % valence;
    triangles.push_back({0, here, next});
    triangles.push_back({1, next, here});
  }
  return mesh_of(points, triangles);
}

ControlMesh disk(Index valence, double height) {
  std::vector<Point> points = {{0, 0, height}};
  std::vector<Triangle> triangles;
  for (Index i = 0; i < valence; ++i) {
    points.push_back({std::cos(turn(i, valence)), std::sin(turn(i, valence)), 0.1 * (i % 3)});
    triangles.push_back({0, 1 + i, 1 + (i + 1) % valence});
  }
  return mesh_of(points, triangles);
}

ControlMesh open_fan(Index faces) {
  std::vector<Point> points = {{0, 0, 0.2}};
  std::vector<Triangle> triangles;
  for (Index i = 0; i <= faces; ++i) {
    const double angle = std::numbers::pi * i / (faces + 0.5);
    points.push_back({std::cos(angle), std::sin(angle), 0.15 * (i % 2)});
    if (i > 0) triangles.push_back({0, i, i + 1});
  }
  return mesh_of(points, triangles);
}

ControlMesh grid(Index columns, Index rows) {
  std::vector<Point> points;
  for (Index r = 0; r <= rows; ++r)
    for (Index c = 0; c <= columns; ++c) {
      const double x = 2.0 * c / columns - 1, y = 2.0 * r / rows - 1;
      points.push_back({x, y, 0.4 * std::cos(2 * x) * std::cos(3 * y)});
    }
  std::vector<Triangle> triangles;
  for (Index r = 0; r < rows; ++r)
    for (Index c = 0; c < columns; ++c) {
      const Index p = r * (columns + 1) + c;
      add_quad(triangles, p, p + 1, p + columns + 2, p + columns + 1);
    }
  return mesh_of(points, triangles);
}

ControlMesh tube(Index columns, Index rows) {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  for (Index r = 0; r <= rows; ++r)
    for (Index c = 0; c < columns; ++c) {
      const double radius = 0.7 + 0.2 * std::sin(2.0 * r);
      points.push_back(
          {radius * std::cos(turn(c, columns)), radius * std::sin(turn(c, columns)), 2.0 * r / rows - 1});
      if (r == rows) continue;
      const Index right = (c + 1) % columns;
      add_quad(triangles, r * columns + c, r * columns + right, (r + 1) * columns + right,
               (r + 1) * columns + c);
    }
  return mesh_of(points, triangles);
}

ControlMesh torus(Index rows, Index columns) {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  for (Index r = 0; r < rows; ++r)
    for (Index c = 0; c < columns; ++c) {
      const double radius = 0.8 + 0.35 * std::cos(turn(r, rows));
      points.push_back({radius * std::cos(turn(c, columns)), radius * std::sin(turn(c, columns)),
                        0.35 * std::sin(turn(r, rows))});
      const Index right = (c + 1) % columns, up = (r + 1) % rows;
      add_quad(triangles, r * columns + c, r * columns + right, up * columns + right, up * columns + c);
    }
  return mesh_of(points, triangles);
}

ControlMesh tetrahedron() {
  return mesh_of({{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}},
                 {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

ControlMesh octahedron() { return double_pyramid(4); }

ControlMesh icosahedron() {
  const double a = 1 / std::sqrt(5.0), b = 2 * a;
  std::vector<Point> points = {{0, 0, 1}};
  for (Index i = 0; i < 5; ++i) points.push_back({b * std::cos(turn(i, 5)), b * std::sin(turn(i, 5)), a});
  for (Index i = 0; i < 5; ++i)
    points.push_back({b * std::cos(turn(2 * i + 1, 10)), b * std::sin(turn(2 * i + 1, 10)), -a});
  points.push_back({0, 0, -1});
  std::vector<Triangle> triangles;
  for (Index i = 0; i < 5; ++i) {
    const Index upper = 1 + i, upper_next = 1 + (i + 1) % 5, lower = 6 + i, lower_next = 6 + (i + 1) % 5;
    triangles.push_back({0, upper, upper_next});
    triangles.push_back({upper, lower, upper_next});
    triangles.push_back({upper_next, lower, lower_next});
    triangles.push_back({11, lower_next, lower});
  }
  return mesh_of(points, triangles);
}

ControlMesh cube() {
  std::vector<Point> points;
  for (Index p = 0; p < 8; ++p)
    points.push_back({2.0 * (p & 1) - 1, 2.0 * (p >> 1 & 1) - 1, 2.0 * (p >> 2 & 1) - 1});
  std::vector<Triangle> triangles;
  add_quad(triangles, 0, 2, 3, 1);
  add_quad(triangles, 4, 5, 7, 6);
  add_quad(triangles, 0, 1, 5, 4);
  add_quad(triangles, 2, 6, 7, 3);
  add_quad(triangles, 0, 4, 6, 2);
  add_quad(triangles, 1, 3, 7, 5);
  return mesh_of(points, triangles);
}

ControlMesh join(const ControlMesh& a, const ControlMesh& b, const Point& offset) {
  ControlMesh both = a;
  const auto first = static_cast<Index>(a.point_count());
  for (std::size_t k = 0; k < b.points.size(); ++k) both.points.push_back(b.points[k] + offset[k % 3]);
  for (const Index v : b.face_vertex_indices) both.face_vertex_indices.push_back(first + v);
  return both;
}

void crease(ControlMesh& mesh, const std::vector<Index>& points, float sharpness) {
  mesh.crease_indices.insert(mesh.crease_indices.end(), points.begin(), points.end());
  mesh.crease_lengths.push_back(static_cast<Index>(points.size()));
  mesh.crease_sharpnesses.push_back(sharpness);
}

void crease_by_edge(ControlMesh& mesh, const std::vector<Index>& points,
                    const std::vector<float>& sharpnesses) {
  mesh.crease_indices.insert(mesh.crease_indices.end(), points.begin(), points.end());
  mesh.crease_lengths.push_back(static_cast<Index>(points.size()));
  mesh.crease_sharpnesses.insert(mesh.crease_sharpnesses.end(), sharpnesses.begin(), sharpnesses.end());
}

void corner(ControlMesh& mesh, Index point, float sharpness) {
  mesh.corner_indices.push_back(point);
  mesh.corner_sharpnesses.push_back(sharpness);
}

Primvar plain_primvar(const ControlMesh& mesh, std::string name, Interpolation interpolation,
                      Index element_size) {
  Count elements = 1;
  if (interpolation == Interpolation::uniform) elements = mesh.face_count();
  if (interpolation == Interpolation::varying || interpolation == Interpolation::vertex)
    elements = mesh.point_count();
  if (interpolation == Interpolation::face_varying) elements = mesh.face_vertex_indices.size();
  Primvar primvar{std::move(name), interpolation, element_size, {}, {}};
  Random random(elements * 31 + element_size);
  for (Count k = 0; k < elements * element_size; ++k) primvar.values.push_back(random.centred());
  return primvar;
}

Primvar unindexed(const ControlMesh& mesh, std::string name, Index element_size) {
  Primvar primvar{std::move(name), Interpolation::face_varying, element_size, {}, {}};
  for (Index c = 0; c < mesh.face_vertex_indices.size(); ++c) {
    const Point p = at(mesh, mesh.face_vertex_indices[c]);
    Random random(c + 7);
    for (Index k = 0; k < element_size; ++k) primvar.values.push_back(p[k % 3] + 0.2 * random.centred());
  }
  return primvar;
}

NamedShape named(std::string name, ControlMesh mesh) {
  mesh.name = name;
  return {std::move(name), std::move(mesh)};
}

void add_in_all_boundaries(std::vector<NamedShape>& shapes, const std::string& name,
                           const ControlMesh& mesh) {
  using enum BoundaryInterpolation;
  for (const auto& [word, mode] :
       {std::pair{"_none", none}, {"_edge_only", edge_only}, {"_edge_and_corner", edge_and_corner}}) {
    shapes.push_back(named(name + word, mesh));
    shapes.back().mesh.interpolate_boundary = mode;
  }
}

void add_in_all_modes(std::vector<NamedShape>& shapes, const std::string& name, const ControlMesh& mesh) {
  using enum FaceVaryingInterpolation;
  for (const auto& [word, mode] : {std::pair{"_none", none},
                                   {"_corners_only", corners_only},
                                   {"_corners_plus1", corners_plus1},
                                   {"_corners_plus2", corners_plus2},
                                   {"_boundaries", boundaries},
                                   {"_all", all}}) {
    shapes.push_back(named(name + word, mesh));
    shapes.back().mesh.face_varying_linear_interpolation = mode;
  }
}

}  // namespace subdivd::shapes

#include "tests/shapes/polygons.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "core/mesh/creases.h"
#include "tests/shapes/build.h"
#include "tests/shapes/random.h"

namespace subdivd::shapes {
namespace {

using Faces = std::vector<std::vector<Index>>;

void set_faces(ControlMesh& mesh, const Faces& faces) {
  mesh.face_vertex_counts.clear();
  mesh.face_vertex_indices.clear();
  for (const auto& face : faces) {
    mesh.face_vertex_counts.push_back(static_cast<Index>(face.size()));
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), face.begin(), face.end());
  }
}

ControlMesh polygons(const std::vector<Point>& points, const Faces& faces) {
  ControlMesh mesh = mesh_of(points, {});
  set_faces(mesh, faces);
  return mesh;
}

// columns x rows quads; point (column, row) = row * (columns + 1) + column.
ControlMesh quad_grid(Index columns, Index rows) {
  ControlMesh mesh = grid(columns, rows);
  Faces faces;
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) {
      const Index a = j * (columns + 1) + i, above = a + columns + 1;
      faces.push_back({a, a + 1, above + 1, above});
    }
  set_faces(mesh, faces);
  return mesh;
}

// Point (column, row) = row * columns + column; every vertex has four edges.
ControlMesh quad_torus(Index rows, Index columns) {
  ControlMesh mesh = torus(rows, columns);
  Faces faces;
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) {
      const Index right = (i + 1) % columns, above = (j + 1) % rows;
      faces.push_back({j * columns + i, j * columns + right, above * columns + right, above * columns + i});
    }
  set_faces(mesh, faces);
  return mesh;
}

// 8 corners; point = x + 2 y + 4 z.
ControlMesh quad_cube() {
  ControlMesh mesh = cube();
  set_faces(mesh, {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
  return mesh;
}

Point on_circle(Index k, Index n, double z) {
  const double angle = 2 * std::numbers::pi * k / n;
  return {std::cos(angle), std::sin(angle), z};
}

// Two faces of n corners, points 0..n-1 below and n..2n-1 above, and quads between them.
ControlMesh prism(Index n) {
  std::vector<Point> points;
  for (const double z : {-0.5, 0.5})
    for (Index k = 0; k < n; ++k) points.push_back(on_circle(k, n, z));
  Faces faces(2);
  for (Index k = 0; k < n; ++k) {
    faces[0].push_back(n - 1 - k);
    faces[1].push_back(n + k);
    faces.push_back({k, (k + 1) % n, n + (k + 1) % n, n + k});
  }
  return polygons(points, faces);
}

// n quads around point 0, whose ring 1..2n is the border.
ControlMesh quad_disk(Index n) {
  std::vector<Point> points{{0, 0, 0.4}};
  for (Index k = 0; k < 2 * n; ++k) points.push_back(on_circle(k, 2 * n, 0));
  Faces faces;
  for (Index k = 0; k < n; ++k) faces.push_back({0, 2 * k + 1, 2 * k + 2, (2 * k + 2) % (2 * n) + 1});
  return polygons(points, faces);
}

// A sphere-like cap: a pole of n triangles, a ring of quads, an open border.
ControlMesh capped_tube(Index n) {
  std::vector<Point> points{{0, 0, 1}};
  for (const double z : {0.6, 0.0})
    for (Index k = 0; k < n; ++k) points.push_back(on_circle(k, n, z));
  Faces faces;
  for (Index k = 0; k < n; ++k) {
    const Index next = (k + 1) % n;
    faces.push_back({0, 1 + k, 1 + next});
    faces.push_back({1 + k, 1 + n + k, 1 + n + next, 1 + next});
  }
  return polygons(points, faces);
}

// Two faces with the same border but for one point in between, which has two edges.
ControlMesh with_valence_two() {
  ControlMesh mesh = quad_cube();
  // Points 8 and 9 halve edges of the cube: they belong to both faces at it.
  for (const Point& point : {Point{0.1, -0.2, 0}, Point{1.1, 0.5, 1.1}})
    mesh.points.insert(mesh.points.end(), point.begin(), point.end());
  set_faces(mesh,
            {{0, 2, 3, 1, 8}, {4, 5, 9, 7, 6}, {0, 8, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 9, 5}});
  return mesh;
}

// A quad on an edge that two others share already.
ControlMesh with_fin() {
  ControlMesh mesh = quad_grid(3, 3);
  for (const Point& point : {Point{-0.3, 0, 0.9}, Point{0.3, 0, 0.9}})
    mesh.points.insert(mesh.points.end(), point.begin(), point.end());
  mesh.face_vertex_counts.push_back(4);
  mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {5, 6, 17, 16});
  return mesh;
}

ControlMesh with_crease(ControlMesh mesh, const std::vector<Index>& line,
                        const std::vector<float>& sharpness) {
  mesh.crease_indices.insert(mesh.crease_indices.end(), line.begin(), line.end());
  mesh.crease_lengths.push_back(static_cast<Index>(line.size()));
  mesh.crease_sharpnesses.insert(mesh.crease_sharpnesses.end(), sharpness.begin(), sharpness.end());
  return mesh;
}

ControlMesh with_corner(ControlMesh mesh, Index point, float sharpness) {
  mesh.corner_indices.push_back(point);
  mesh.corner_sharpnesses.push_back(sharpness);
  return mesh;
}

ControlMesh with_boundary(ControlMesh mesh, BoundaryInterpolation boundary) {
  mesh.interpolate_boundary = boundary;
  return mesh;
}

class Joiner {
 public:
  explicit Joiner(const ControlMesh& mesh) {
    for (std::size_t h = 0; h < mesh.face_vertex_indices.size(); h += 3)
      faces_.push_back({mesh.face_vertex_indices.begin() + static_cast<std::ptrdiff_t>(h),
                        mesh.face_vertex_indices.begin() + static_cast<std::ptrdiff_t>(h) + 3});
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) faces_along_[{faces_[f][k], faces_[f][(k + 1) % 3]}].push_back(f);
    for_each_crease_edge(mesh, [&](Count, Index a, Index b, float) { creased_.insert(std::minmax(a, b)); });
  }

  // Joins face f with the one across its edge k where that leaves one face that repeats no vertex.
  void join(std::size_t f, std::size_t k, Index most) {
    auto& face = faces_[f];
    if (face.empty()) return;
    k %= face.size();
    const Index a = face[k], b = face[(k + 1) % face.size()];
    if (creased_.contains(std::minmax(a, b))) return;
    const auto there = faces_along_.find({b, a});
    if (there == faces_along_.end() || there->second.size() != 1 || faces_along_[{a, b}].size() != 1) return;
    const std::size_t g = there->second.front();
    auto& other = faces_[g];
    if (g == f || face.size() + other.size() - 2 > most) return;
    std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>((k + 1) % face.size()), face.end());
    const auto at = static_cast<std::size_t>(std::ranges::find(other, a) - other.begin());
    std::rotate(other.begin(), other.begin() + static_cast<std::ptrdiff_t>(at), other.end());
    // face: b ... a; other: a ... b. What other has between goes behind face's a.
    for (std::size_t j = 1; j + 1 < other.size(); ++j)
      if (std::ranges::count(face, other[j]) != 0) return;
    for (std::size_t j = 0; j + 1 < other.size(); ++j) {
      auto& along = faces_along_[{other[j], other[j + 1]}];
      std::ranges::replace(along, g, f);
    }
    faces_along_.erase({a, b});
    faces_along_.erase({b, a});
    face.insert(face.end(), other.begin() + 1, other.end() - 1);
    other.clear();
  }

  std::size_t size() const { return faces_.size(); }
  Faces faces() const {
    Faces left;
    for (const auto& face : faces_)
      if (!face.empty()) left.push_back(face);
    return left;
  }

 private:
  Faces faces_;
  std::map<std::pair<Index, Index>, std::vector<std::size_t>> faces_along_;  // by half-edge
  std::set<std::pair<Index, Index>> creased_;
};

}  // namespace

ControlMesh with_joined_faces(const ControlMesh& triangles, Index most, std::uint64_t seed) {
  Random random(seed);
  Joiner joiner(triangles);
  for (std::size_t tries = random.below(static_cast<Index>(2 * joiner.size() + 1)); tries > 0; --tries)
    joiner.join(random.below(static_cast<Index>(joiner.size())), random.below(most), most);
  ControlMesh mesh = triangles;
  mesh.primvars.clear();
  mesh.hole_indices.clear();
  mesh.render_meshes.clear();
  set_faces(mesh, joiner.faces());
  return mesh;
}

ControlMesh with_values(ControlMesh mesh, Index islands, std::uint64_t seed) {
  Random random(seed);
  const auto points = static_cast<Index>(mesh.point_count());
  Primvar st{.name = "st",
             .interpolation = Interpolation::face_varying,
             .element_size = 2,
             .values = {},
             .indices = {}};
  for (Index k = 0; k < 2 * islands * points; ++k) st.values.push_back(random.centred());
  std::size_t corner = 0;
  Index island = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (random.one_in(3)) island = random.below(islands);
    for (Index k = 0; k < mesh.face_size(f); ++k)
      st.indices.push_back(mesh.face_vertex_indices[corner++] + points * island);
  }
  mesh.primvars = {plain_primvar(mesh, "constant", Interpolation::constant, 2),
                   plain_primvar(mesh, "uniform", Interpolation::uniform, 1),
                   plain_primvar(mesh, "varying", Interpolation::varying, 2),
                   plain_primvar(mesh, "vertex", Interpolation::vertex, 3),
                   std::move(st),
                   unindexed(mesh, "torn", 1)};
  if (mesh.face_count() > 3) mesh.hole_indices = {random.below(mesh.face_count())};
  return mesh;
}

std::vector<NamedShape> polygon_shapes() {
  std::vector<NamedShape> shapes;
  const auto add = [&](const std::string& name, ControlMesh mesh) {
    mesh.name = name;
    shapes.push_back({name, std::move(mesh)});
  };
  add("quad_cube", quad_cube());
  add("quad_torus", quad_torus(4, 5));
  add("one_quad", quad_grid(1, 1));
  add("one_triangle", polygons({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  add("one_pentagon",
      polygons({{0, 0, 0}, {1, 0, 0}, {1.3, 0.8, 0}, {0.5, 1.4, 0}, {-0.3, 0.8, 0}}, {{0, 1, 2, 3, 4}}));
  add("triangles_alone", icosahedron());
  add("octahedron", octahedron());
  add("valence_two", with_valence_two());
  add("fin", with_fin());
  for (const Index n : {3u, 4u, 5u, 6u, 7u, 12u}) add("prism_of_" + std::to_string(n), prism(n));
  for (const Index n : {3u, 4u, 5u, 8u, 360u}) {
    add("pole_of_" + std::to_string(n) + "_quads", quad_disk(n));
    add("pole_of_" + std::to_string(n) + "_triangles", capped_tube(n));
  }
  for (const auto& [word, boundary] : {std::pair{"none", BoundaryInterpolation::none},
                                       {"edges", BoundaryInterpolation::edge_only},
                                       {"corners", BoundaryInterpolation::edge_and_corner}}) {
    add(std::string("grid_border_") + word, with_boundary(quad_grid(3, 2), boundary));
    add(std::string("disk_border_") + word, with_boundary(quad_disk(3), boundary));
  }
  for (const float s : {0.4f, 1.f, 1.7f, 2.5f, 4.f, 10.f}) {
    const std::string word = std::to_string(static_cast<int>(10 * s));
    add("cube_crease_" + word, with_crease(quad_cube(), {0, 1, 3, 2, 0}, {s}));
    add("cube_dart_" + word, with_crease(quad_cube(), {0, 1}, {s}));
    add("cube_corner_" + word, with_corner(quad_cube(), 7, s));
    add("prism_crease_" + word, with_crease(prism(5), {0, 1, 2}, {s, 0.5f * s}));
    add("grid_crossing_" + word, with_crease(with_crease(quad_grid(4, 4), {10, 11, 12, 13, 14}, {s, s, s, s}),
                                             {2, 7, 12, 17, 22}, {1.3f, 1.3f, 2.2f, 3}));
  }
  return shapes;
}

}  // namespace subdivd::shapes

#include "tests/bench/workloads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/refine/refine.h"
#include "tests/bench/flips.h"
#include "tests/shapes/build.h"
#include "tests/shapes/random.h"

namespace subdivd::bench {
namespace {

using shapes::Random;
using Point = std::array<double, 3>;

Workload workload(std::string name, std::vector<Index> levels, ControlMesh mesh) {
  Workload made{.name = std::move(name),
                .levels = std::move(levels),
                .mesh = std::move(mesh),
                .points = {},
                .corners = {},
                .creases = {}};
  made.mesh.name = made.name;
  // Every contestant gets the same numbers.
  made.points.assign(made.mesh.points.begin(), made.mesh.points.end());
  made.mesh.points.assign(made.points.begin(), made.points.end());
  made.corners.assign(made.mesh.face_vertex_indices.begin(), made.mesh.face_vertex_indices.end());
  if (!made.mesh.face_vertex_counts.empty()) made.face_size = 4;
  made.creases.assign(made.mesh.crease_indices.begin(), made.mesh.crease_indices.end());
  return made;
}

void add_point(ControlMesh& mesh, const Point& point) {
  mesh.points.insert(mesh.points.end(), point.begin(), point.end());
}

void add_triangle(ControlMesh& mesh, Index a, Index b, Index c) {
  mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {a, b, c});
}

// How a quad a b c d, counter-clockwise, is kept: whole, or cut along one of its diagonals.
enum class Cut { none, diagonal, other_diagonal };
void add_quad(ControlMesh& mesh, const std::array<Index, 4>& quad, Cut cut) {
  const auto [a, b, c, d] = quad;
  if (cut == Cut::none) {
    mesh.face_vertex_counts.push_back(4);
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), quad.begin(), quad.end());
  } else if (cut == Cut::other_diagonal) {
    add_triangle(mesh, a, b, d);
    add_triangle(mesh, b, c, d);
  } else {
    add_triangle(mesh, a, b, c);
    add_triangle(mesh, a, c, d);
  }
}

// An octahedron whose faces are cut into m * m triangles each, blown up to the unit sphere. Ring r of 2m has
// 4 min(r, 2m - r) points, the poles one; 8 m^2 triangles, band by band from the north pole to the south
// pole.
ControlMesh sphere(Index m) {
  const auto ring_size = [m](Index ring) { return 4 * std::min(ring, 2 * m - ring); };
  ControlMesh mesh;
  std::vector<Index> first;  // point of every ring
  for (Index ring = 0; ring <= 2 * m; ++ring) {
    first.push_back(static_cast<Index>(mesh.point_count()));
    const Index count = std::max(ring_size(ring), Index{1});
    const double polar = std::numbers::pi * ring / (2 * m);
    for (Index k = 0; k < count; ++k) {
      const double around = 2 * std::numbers::pi * k / count;
      add_point(mesh,
                {std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)});
    }
  }
  const auto on_ring = [&](Index ring, Index k) {
    return first[ring] + k % std::max(ring_size(ring), Index{1});
  };
  for (Index band = 0; band < 2 * m; ++band) {
    // In each quarter the ring nearer to its pole has one segment less.
    const bool north = band < m;
    const Index narrow = north ? band : band + 1, wide = north ? band + 1 : band;
    const Index segments = ring_size(narrow) / 4;
    for (Index quarter = 0; quarter < 4; ++quarter)
      for (Index k = 0; k <= segments; ++k) {
        const Index w = on_ring(wide, quarter * (segments + 1) + k),
                    n = on_ring(narrow, quarter * segments + k);
        const Index w_next = on_ring(wide, quarter * (segments + 1) + k + 1);
        north ? add_triangle(mesh, n, w, w_next) : add_triangle(mesh, n, w_next, w);
        if (k == segments) continue;
        const Index n_next = on_ring(narrow, quarter * segments + k + 1);
        north ? add_triangle(mesh, n, w_next, n_next) : add_triangle(mesh, n, n_next, w_next);
      }
  }
  return mesh;
}

// Moves every point to the middle of its neighbours, on the sphere: flips leave slivers behind.
void relax(ControlMesh& mesh) {
  std::vector<double> sums(mesh.points.size(), 0.0);
  const std::vector<Index>& corners = mesh.face_vertex_indices;
  for (std::size_t h = 0; h < corners.size(); ++h) {
    const std::size_t to = h % 3 == 2 ? h - 2 : h + 1;
    for (std::size_t c = 0; c < 3; ++c) sums[3 * corners[h] + c] += mesh.points[3 * corners[to] + c];
  }
  for (std::size_t k = 0; k < sums.size(); k += 3) {
    const double length = std::hypot(sums[k], sums[k + 1], sums[k + 2]);
    for (std::size_t c = 0; c < 3; ++c) mesh.points[k + c] = sums[k + c] / length;
  }
}

// Lumps of several sizes, and a little noise as a scan has it.
void make_lumpy(ControlMesh& mesh, Random& random) {
  for (std::size_t k = 0; k < mesh.points.size(); k += 3) {
    double* p = mesh.points.data() + k;
    const double radius = 1 + 0.2 * std::sin(3 * p[0] + 1) * std::cos(4 * p[1]) +
                          0.1 * std::sin(9 * p[2] + 5 * p[0]) + 0.002 * random.centred();
    for (int c = 0; c < 3; ++c) p[c] *= radius;
  }
}

// 8 m^2 triangles, two thirds of the points irregular.
ControlMesh lumpy_sphere(Index m, std::uint64_t seed) {
  Random random(seed);
  ControlMesh mesh = sphere(m);
  flip_edges(mesh.face_vertex_indices, static_cast<Index>(mesh.point_count()), 2.0 / 3, random);
  for (int k = 0; k < 3; ++k) relax(mesh);
  make_lumpy(mesh, random);
  return mesh;
}

double jar_radius(double height) { return 0.6 + 0.25 * std::sin(4 * height) + 0.05 * std::cos(13 * height); }

// One crease per edge, as modellers export them.
void crease(ControlMesh& mesh, const std::vector<Index>& points, float sharpness) {
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
    shapes::crease(mesh, {points[k], points[k + 1]}, sharpness);
}

// A jar of columns x rows quads, open above and below, with two slots; rows and columns of tags are those of 51 and 60.
// Which way quads are cut is `cut`'s to say.
template <class CutOf>
ControlMesh jar(Index columns, Index rows, CutOf&& cut) {
  ControlMesh mesh;
  for (Index row = 0; row <= rows; ++row)
    for (Index column = 0; column < columns; ++column) {
      const double around = 2 * std::numbers::pi * column / columns, height = 2.0 * row / rows - 1;
      const double radius = jar_radius(height);
      add_point(mesh, {radius * std::cos(around), radius * std::sin(around), height});
    }
  for (Index row = 0; row < rows; ++row)
    for (Index column = 0; column < columns; ++column) {
      const bool slot = (row == 20 || row == 30) && column >= 10 && column < 25;
      if (slot) continue;  // one row high, so that every point is still used
      const Index right = (column + 1) % columns;
      add_quad(mesh,
               {row * columns + column, row * columns + right, (row + 1) * columns + right,
                (row + 1) * columns + column},
               cut());
    }
  const auto ring = [&](Index row) {
    std::vector<Index> points;
    for (Index column = 0; column <= columns; ++column) points.push_back(row * columns + column % columns);
    return points;
  };
  const auto seam = [&](Index column, Index first_row, Index last_row) {
    std::vector<Index> points;
    for (Index row = first_row; row <= last_row; ++row) points.push_back(row * columns + column);
    return points;
  };
  for (const Index row : {2, 3, 48, 49}) crease(mesh, ring(row), kInfiniteSharpness);
  crease(mesh, ring(12), 2.5f);
  crease(mesh, ring(40), 1.3f);
  crease(mesh, seam(0, 3, 48), 3.0f);
  crease(mesh, seam(35, 12, 40), 0.7f);
  return mesh;
}

// A torus of around x along quads with jittered points.
template <class CutOf>
ControlMesh torus(Index around, Index along, Random& random, CutOf&& cut) {
  ControlMesh mesh;
  for (Index row = 0; row < along; ++row)
    for (Index column = 0; column < around; ++column) {
      const double u = 2 * std::numbers::pi * (column + 0.3 * random.centred()) / around;
      const double v = 2 * std::numbers::pi * (row + 0.3 * random.centred()) / along;
      const double radius = 1 + 0.4 * std::cos(v);
      add_point(mesh, {radius * std::cos(u), radius * std::sin(u), 0.4 * std::sin(v)});
    }
  for (Index row = 0; row < along; ++row)
    for (Index column = 0; column < around; ++column) {
      const Index right = (column + 1) % around, up = (row + 1) % along;
      add_quad(mesh, {row * around + column, row * around + right, up * around + right, up * around + column},
               cut());
    }
  return mesh;
}

constexpr auto kWhole = [] { return Cut::none; };

}  // namespace

Workload icosahedron() { return workload("icosahedron", {6, 8}, shapes::icosahedron()); }

Workload blob100k() { return workload("blob100k", {1, 2, 3}, lumpy_sphere(112, 3)); }

Workload scan120k() { return workload("scan120k", {1, 2, 3}, lumpy_sphere(122, 6)); }

Workload torus1m() {
  Random random(4);
  return workload("torus1m", {1, 2}, torus(1000, 500, random, [&] {
                    return random.one_in(2) ? Cut::other_diagonal : Cut::diagonal;
                  }));
}

Workload model6k() {
  Random random(5);
  return workload("model6k", {3, 4, 5},
                  jar(60, 51, [&] { return random.one_in(4) ? Cut::other_diagonal : Cut::diagonal; }));
}

Workload quads6k() { return workload("quads6k", {3, 4, 5}, jar(120, 51, kWhole)); }

Workload quads100k() {
  ControlMesh triangles = lumpy_sphere(65, 7);
  triangles.subdivision_scheme = "bilinear";
  const auto cut = refine<double>(triangles, {.level = 1}, {}).value();
  ControlMesh mesh;
  mesh.points.assign(cut.points.begin(), cut.points.end());
  mesh.face_vertex_counts.assign(cut.face_count, 4);
  mesh.face_vertex_indices.assign(cut.faces.begin(), cut.faces.end());
  return workload("quads100k", {2, 3}, std::move(mesh));
}

Workload quads1m() {
  Random random(8);
  return workload("quads1m", {1, 2}, torus(1000, 1000, random, kWhole));
}

}  // namespace subdivd::bench

#include "tests/bench/workloads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "tests/bench/flips.h"
#include "tests/shapes/build.h"
#include "tests/shapes/random.h"

namespace subdivd::bench {
namespace {

using shapes::Random;
using Point = std::array<double, 3>;

Workload workload(std::string name, std::vector<Index> levels, ControlMesh mesh) {
  Workload made{std::move(name), std::move(levels), std::move(mesh), {}, {}, {}};
  made.mesh.name = made.name;
  // Every contestant gets the same numbers.
  made.points.assign(made.mesh.points.begin(), made.mesh.points.end());
  made.mesh.points.assign(made.points.begin(), made.points.end());
  made.triangles.assign(made.mesh.face_vertex_indices.begin(), made.mesh.face_vertex_indices.end());
  made.creases.assign(made.mesh.crease_indices.begin(), made.mesh.crease_indices.end());
  return made;
}

void add_point(ControlMesh& mesh, const Point& point) {
  mesh.points.insert(mesh.points.end(), point.begin(), point.end());
}

void add_triangle(ControlMesh& mesh, Index a, Index b, Index c) {
  mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {a, b, c});
}

// The quad a b c d, counter-clockwise, cut along one of its diagonals.
void add_quad(ControlMesh& mesh, const std::array<Index, 4>& quad, bool other_diagonal) {
  const auto [a, b, c, d] = quad;
  if (other_diagonal) {
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

constexpr Index kColumns = 60, kRows = 51;

double jar_radius(double height) { return 0.6 + 0.25 * std::sin(4 * height) + 0.05 * std::cos(13 * height); }

// One crease per edge, as modellers export them.
void crease(ControlMesh& mesh, const std::vector<Index>& points, float sharpness) {
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
    shapes::crease(mesh, {points[k], points[k + 1]}, sharpness);
}

std::vector<Index> ring(Index row) {
  std::vector<Index> points;
  for (Index column = 0; column <= kColumns; ++column) points.push_back(row * kColumns + column % kColumns);
  return points;
}

std::vector<Index> seam(Index column, Index first_row, Index last_row) {
  std::vector<Index> points;
  for (Index row = first_row; row <= last_row; ++row) points.push_back(row * kColumns + column);
  return points;
}

}  // namespace

Workload icosahedron() { return workload("icosahedron", {6, 8}, shapes::icosahedron()); }

Workload blob100k() { return workload("blob100k", {1, 2, 3}, lumpy_sphere(112, 3)); }

Workload scan120k() { return workload("scan120k", {1, 2, 3}, lumpy_sphere(122, 6)); }

Workload torus1m() {
  constexpr Index kAround = 1000, kAlong = 500;
  Random random(4);
  ControlMesh mesh;
  for (Index row = 0; row < kAlong; ++row)
    for (Index column = 0; column < kAround; ++column) {
      const double u = 2 * std::numbers::pi * (column + 0.3 * random.centred()) / kAround;
      const double v = 2 * std::numbers::pi * (row + 0.3 * random.centred()) / kAlong;
      const double radius = 1 + 0.4 * std::cos(v);
      add_point(mesh, {radius * std::cos(u), radius * std::sin(u), 0.4 * std::sin(v)});
    }
  for (Index row = 0; row < kAlong; ++row)
    for (Index column = 0; column < kAround; ++column) {
      const Index right = (column + 1) % kAround, up = (row + 1) % kAlong;
      add_quad(mesh,
               {row * kAround + column, row * kAround + right, up * kAround + right, up * kAround + column},
               random.one_in(2));
    }
  return workload("torus1m", {1, 2}, std::move(mesh));
}

Workload model6k() {
  Random random(5);
  ControlMesh mesh;
  for (Index row = 0; row <= kRows; ++row)
    for (Index column = 0; column < kColumns; ++column) {
      const double around = 2 * std::numbers::pi * column / kColumns, height = 2.0 * row / kRows - 1;
      const double radius = jar_radius(height);
      add_point(mesh, {radius * std::cos(around), radius * std::sin(around), height});
    }
  for (Index row = 0; row < kRows; ++row)
    for (Index column = 0; column < kColumns; ++column) {
      const bool slot = (row == 20 || row == 30) && column >= 10 && column < 25;
      if (slot) continue;  // one row high, so that every point is still used
      const Index right = (column + 1) % kColumns;
      add_quad(mesh,
               {row * kColumns + column, row * kColumns + right, (row + 1) * kColumns + right,
                (row + 1) * kColumns + column},
               random.one_in(4));
    }
  for (const Index row : {2, 3, 48, 49}) crease(mesh, ring(row), kInfiniteSharpness);
  crease(mesh, ring(12), 2.5f);
  crease(mesh, ring(40), 1.3f);
  crease(mesh, seam(0, 3, 48), 3.0f);
  crease(mesh, seam(35, 12, 40), 0.7f);
  return workload("model6k", {3, 4, 5}, std::move(mesh));
}

}  // namespace subdivd::bench

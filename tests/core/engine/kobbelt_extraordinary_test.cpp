// Kobbelt's interpolating quads by the plain engine, around vertices where the net is not regular.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/engine/plain/line_rows.h"
#include "core/engine/plain/sectors.h"
#include "core/schemes/kobbelt.h"
#include "tests/core/engine/kobbelt_surface.h"
#include "tests/core/engine/levels.h"

namespace subdivd::plain {
namespace {

std::array<double, 3> edge_point(const KobbeltSurface& before, const KobbeltSurface& after, Index h) {
  const Index v = before.level.faces.vertex_count() + before.level.faces.half_edge_edge(h);
  return {after.points[3 * v], after.points[3 * v + 1], after.points[3 * v + 2]};
}

// From the edge points that a step made: what the four-point rule makes of them in one direction of a face.
std::array<double, 3> across(const KobbeltSurface& before, const KobbeltSurface& after, Index h) {
  const Adjacency& faces = before.level.faces;
  const auto opposite = [&](Index g) { return faces.next(faces.next(g)); };
  const Index other = opposite(h);
  const auto a = edge_point(before, after, h), b = edge_point(before, after, other);
  const auto before_a = edge_point(before, after, opposite(faces.mate(h))),
             behind_b = edge_point(before, after, opposite(faces.mate(other)));
  std::array<double, 3> point{};
  for (std::size_t k = 0; k < 3; ++k)
    point[k] = (0.5 + kTension) * (a[k] + b[k]) - kTension * (before_a[k] + behind_b[k]);
  return point;
}

TEST(KobbeltByRows, makes_one_point_in_both_directions_of_the_faces_at_an_extraordinary_vertex) {
  for (const auto& [name, mesh] : kobbelt_meshes()) {
    if (mesh.points.size() > 400) continue;
    KobbeltSurface before(mesh);
    before.refine();
    before.refine();  // extraordinary vertices are four edges apart now: no face's rule sees two
    KobbeltSurface after = before;
    after.refine();
    const Adjacency& faces = before.level.faces;
    const auto inside = [&](Index v) {
      return faces.vertex_corners(v).size() == faces.vertex_edges(v).size();
    };
    const Sectors sectors(faces, crossed_edges(faces, before.level.sharpness));
    for (Index f = 0; f < faces.face_count(); ++f) {
      bool away = true;  // from creases
      for (Index h = 4 * f; h < 4 * f + 4; ++h)
        for (const Index g : faces.vertex_corners(faces.corner_vertex(h)))
          for (Index c = faces.face_begin(faces.face_of(g)); c < faces.face_begin(faces.face_of(g)) + 4; ++c)
            away &= inside(faces.corner_vertex(c)) && sectors.is_closed(sectors.of_corner(c)) &&
                    before.level.sharpness.vertices[faces.corner_vertex(c)] == 0;
      if (!away) continue;
      const auto one = across(before, after, 4 * f), other = across(before, after, 4 * f + 1);
      bool at_extraordinary = false, regular = true;
      for (Index h = 4 * f; h < 4 * f + 4; ++h) {
        at_extraordinary |= faces.vertex_corners(faces.corner_vertex(h)).size() != 4;
        for (const Index g : faces.vertex_corners(faces.corner_vertex(h)))
          for (Index c = faces.face_begin(faces.face_of(g)); c < faces.face_begin(faces.face_of(g)) + 4; ++c)
            regular &= faces.vertex_corners(faces.corner_vertex(c)).size() == 4;
      }
      const Index v = faces.vertex_count() + faces.edge_count() + f;
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(after.points[3 * v + k], (one[k] + other[k]) / 2, 1e-13) << name;
        bool two = false;  // a vertex of two edges has no such rule
        for (Index h = 4 * f; h < 4 * f + 4; ++h)
          two |= faces.vertex_corners(faces.corner_vertex(h)).size() == 2;
        if ((at_extraordinary || regular) && !two) {
          EXPECT_NEAR(one[k], other[k], 1e-12) << name << ' ' << f;
        }
      }
    }
  }
}

// A flat disk stays unfolded, and shrinks towards its middle by the eigenvalue that kobbelt.h names.
TEST(KobbeltByRows, is_regular_around_extraordinary_vertices) {
  const std::pair<Index, double> eigenvalues[] = {{3, 0.42633},  {5, 0.53794},  {6, 0.55968},
                                                  {7, 0.57320},  {8, 0.58213},  {9, 0.58834},
                                                  {10, 0.59282}, {11, 0.59615}, {12, 0.59870}};
  for (const auto& [n, eigenvalue] : eigenvalues) {
    KobbeltSurface surface(flat_disk(n));
    double length = 0, shrunk = 0;
    for (int depth = 0; depth < 7; ++depth) {
      surface.refine();
      const Index end = surface.level.faces.other_end(surface.level.faces.vertex_edges(0)[0], 0);
      const double now = std::hypot(surface.points[3 * end], surface.points[3 * end + 1]);
      shrunk = now / length;
      length = now;
    }
    EXPECT_NEAR(shrunk, eigenvalue, 2e-4) << n;
    for (Index h = 0; h < surface.level.faces.half_edge_count(); ++h) {
      const double* a = &surface.points[3 * surface.level.faces.corner_vertex(h)];
      const double* b = &surface.points[3 * surface.level.faces.corner_vertex(surface.level.faces.next(h))];
      const double* c = &surface.points[3 * surface.level.faces.corner_vertex(surface.level.faces.prev(h))];
      ASSERT_GT((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), 0) << n << ' ' << h;
    }
  }
}

// Left eigenvectors: what they make of the points is multiplied by the eigenvalue, whatever the points are.
TEST(KobbeltTangents, shrink_by_the_eigenvalue_at_extraordinary_vertices) {
  const std::pair<Index, double> eigenvalues[] = {{3, 0.42633}, {5, 0.53794}, {8, 0.58213}, {40, 0}};
  for (const auto& [n, eigenvalue] : eigenvalues) {
    ControlMesh mesh = flat_disk(n);
    for (std::size_t k = 0; k < mesh.points.size(); ++k)
      mesh.points[k] += 0.3 * std::sin(static_cast<double>(3 * k));
    KobbeltSurface surface(mesh);
    for (int depth = 0; depth < 3; ++depth) surface.refine();  // away from the border
    const auto tangents = [&] { return surface.applied(tangent_rows(Kobbelt{}, surface.level, false)); };
    const std::vector<double> before = tangents();
    surface.refine();
    const std::vector<double> after = tangents();
    const double shrunk = after[0] / before[0];
    if (eigenvalue != 0) {
      EXPECT_NEAR(shrunk, eigenvalue, 1e-5) << n;
    }
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(after[k], shrunk * before[k], 1e-13) << n << ' ' << k;
    EXPECT_GT(before[0] * before[4] - before[1] * before[3], 0) << n;
  }
}

// By the formula, for a ring short enough to be written out and for one that is summed.
TEST(KobbeltByRows, extends_lines_by_the_formula_in_small_rings_and_in_large_ones) {
  for (const Index n : {3u, 5u, 16u, 17u, 50u}) {
    ControlMesh mesh = flat_disk(n);
    for (std::size_t k = 2; k < mesh.points.size(); k += 3) mesh.points[k] = std::sin(static_cast<double>(k));
    KobbeltSurface surface(mesh);
    const Adjacency faces = surface.level.faces;
    surface.refine();
    const auto z = [&](Index v) { return mesh.points[3 * v + 2]; };
    const auto l = [&](Index i) { return z(2 * (i % n) + 1); };
    const auto k = [&](Index i) { return z(2 * (i % n) + 2); };
    const double c = kTension / (0.5 + kTension);
    double ends = 0, opposite = 0;
    for (Index i = 0; i < n; ++i) {
      ends += l(i);
      opposite += k(i);
    }
    for (Index i = 0; i < n; ++i) {
      const double behind = 4.0 / n * ends - (l(i + n - 1) + l(i) + l(i + 1)) +
                            c * (k(i + 2 * n - 2) + k(i + 2 * n - 1) + k(i) + k(i + 1)) -
                            4 * c / n * opposite;
      // The neighbour lies on the border: the line is pinned there.
      const double expected = (0.5 + kTension) * (z(0) + l(i)) - kTension * (behind + 2 * l(i) - z(0));
      for (const Index e : faces.vertex_edges(0))
        if (faces.other_end(e, 0) == 2 * i + 1) {
          EXPECT_NEAR(surface.points[3 * (faces.vertex_count() + e) + 2], expected, 1e-13) << n << ' ' << i;
        }
    }
  }
}

}  // namespace
}  // namespace subdivd::plain

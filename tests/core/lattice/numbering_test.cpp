#include "core/lattice/numbering.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "core/refine/refine.h"
#include "tests/reference/plain.h"
#include "tests/shapes/build.h"
#include "tests/shapes/shapes.h"

namespace subdivd {
namespace {

TEST(Split, inner_points_and_triangles_are_numbered_without_gaps) {
  for (Count n : {1, 2, 3, 4, 8, 16}) {
    Count expected = 0;
    for (Count j = 1; j < n; ++j)
      for (Count i = 1; i + j < n; ++i) ASSERT_EQ(inner_index(n, i, j), expected++);
    EXPECT_EQ(expected, inner_points(n));
    Count triangle = 0;
    for_each_triangle(n, [&](Count i0, Count j0, Count i1, Count j1, Count, Count) {
      if (j0 == j1 && i1 == i0 + 1) {
        ASSERT_EQ(upright_index(n, i0, j0), triangle);
      }
      ++triangle;
    });
    EXPECT_EQ(triangle, n * n);
  }
}

TEST(Split, finds_inner_points_by_their_numbers) {
  const auto expect = [](Count n, Count i, Count j) {
    const GridPoint point = inner_point(n, inner_index(n, i, j));
    ASSERT_EQ(point.i, i) << n << ' ' << j;
    ASSERT_EQ(point.j, j) << n << ' ' << i;
  };
  for (Count n : {4, 8, 16, 64})
    for (Count j = 1; j < n; ++j)
      for (Count i = 1; i + j < n; ++i) expect(n, i, j);
  const Count n = segments(kMaxLevel);
  for (Count j = 1; j + 1 < n; ++j) {
    expect(n, 1, j);
    expect(n, n - 1 - j, j);
  }
}

// The plain engine makes every level's topology: the formula must count what it makes.
TEST(Split, counts_are_those_of_refining_step_by_step) {
  for (const auto& [name, mesh] : shapes::all_shapes()) {
    SCOPED_TRACE(name);
    const Topology<Triangles> base(static_cast<Index>(mesh.point_count()),
                                   Triangles(mesh.face_vertex_indices));
    plain::Level at = plain::first_level(base, control_sharpness(mesh, base), CreaseMethod::uniform);
    for (Index level = 1; level <= 3; ++level) {
      at = plain::next_level(at, Split::triangles, CreaseMethod::uniform);
      const LevelCounts counts =
          refined_counts(base.vertex_count(), base.edge_count(), base.face_count(), level);
      EXPECT_EQ(counts.vertices, at.faces.vertex_count());
      EXPECT_EQ(counts.edges, at.faces.edge_count());
      EXPECT_EQ(counts.faces, at.faces.face_count());
    }
  }
}

TEST(Numbering, is_a_bijection_and_faces_agree_along_their_edges) {
  for (const auto& [name, mesh] : shapes::all_shapes()) {
    SCOPED_TRACE(name);
    const Topology<Triangles> topology(static_cast<Index>(mesh.point_count()),
                                       Triangles(mesh.face_vertex_indices));
    for (Index level : {0, 1, 2, 3}) {
      const Numbering numbering(topology, level);
      const Count n = numbering.segment_count();
      std::vector<std::set<std::pair<Index, Index>>> places(numbering.vertex_count());
      for (Index f = 0; f < topology.face_count(); ++f)
        for (Count j = 0; j <= n; ++j)
          for (Count i = 0; i + j <= n; ++i) {
            const Index number = numbering.vertex(f, i, j);
            ASSERT_LT(number, places.size());
            places[number].insert({f, static_cast<Index>(j * (n + 1) + i)});
          }
      Count unused = 0;
      for (const auto& at : places) unused += at.empty();
      Count unreferenced = 0;
      for (Index v = 0; v < topology.vertex_count(); ++v) unreferenced += topology.vertex_corners(v).empty();
      EXPECT_EQ(unused, unreferenced);
      for (Index e = 0; e < topology.edge_count(); ++e)
        for (Count k = 1; k < n; ++k)
          EXPECT_EQ(places[topology.vertex_count() + e * (n - 1) + k - 1].size(),
                    topology.edge_half_edges(e).size());
    }
  }
}

// Every two neighbours that follow one another make a triangle with the vertex.
TEST(Numbering, a_regular_ring_goes_round_counter_clockwise) {
  for (const ControlMesh& mesh : {shapes::icosahedron(), shapes::double_pyramid(5)}) {
    const Topology<Triangles> topology(static_cast<Index>(mesh.point_count()),
                                       Triangles(mesh.face_vertex_indices));
    for (Index level : {1, 2, 3, 4}) {
      const Numbering numbering(topology, level);
      std::set<std::array<Index, 3>> triangles;  // from every corner on
      for (Index f = 0; f < topology.face_count(); ++f)
        for_each_triangle(numbering.segment_count(),
                          [&](Count i0, Count j0, Count i1, Count j1, Count i2, Count j2) {
                            const Index a = numbering.vertex(f, i0, j0), b = numbering.vertex(f, i1, j1),
                                        c = numbering.vertex(f, i2, j2);
                            triangles.insert({{a, b, c}, {b, c, a}, {c, a, b}});
                          });
      for (Index v = topology.vertex_count(); v < numbering.vertex_count(); ++v) {
        const auto ring = numbering.regular_ring(v).edges;
        for (std::size_t k = 0; k < 6; ++k)
          ASSERT_TRUE(triangles.contains({v, ring[k], ring[(k + 1) % 6]})) << level << ' ' << v << ' ' << k;
      }
    }
  }
}

}  // namespace
}  // namespace subdivd

#include "core/engine/plain/polygons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/mesh/topology.h"
#include "tests/shapes/shapes.h"

namespace subdivd::plain {
namespace {

Polygons triangles(const ControlMesh& mesh) {
  std::vector<Index> offsets;
  for (Index k = 0; k <= mesh.face_vertex_indices.size(); k += 3) offsets.push_back(k);
  return Polygons(static_cast<Index>(mesh.point_count()), offsets, mesh.face_vertex_indices);
}

// A house without a floor: four walls of four corners, two triangles and two quads as the roof.
Polygons house() {
  //  0 1 2 3 the ground, 4 5 6 7 above it, 8 and 9 the ridge: 8 above 4 and 7, 9 above 5 and 6
  return Polygons(10, {0, 4, 9, 13, 18, 22, 26},
                  {0, 1, 5, 4, 1, 2, 6, 9, 5, 2, 3, 7, 6, 3, 0, 4, 8, 7, 4, 5, 9, 8, 6, 7, 8, 9});
}

TEST(Polygons, of_triangles_are_what_the_topology_says) {
  for (const auto& [name, mesh] : shapes::all_shapes()) {
    SCOPED_TRACE(name);
    const Topology topology(static_cast<Index>(mesh.point_count()), mesh.face_vertex_indices);
    const Polygons polygons = triangles(mesh);
    ASSERT_TRUE(std::ranges::equal(polygons.half_edge_edges(), topology.half_edge_edges()));
    ASSERT_TRUE(std::ranges::equal(polygons.edge_vertices(), topology.edge_vertices()));
    for (Index v = 0; v < topology.vertex_count(); ++v) {
      ASSERT_TRUE(std::ranges::equal(polygons.vertex_edges(v), topology.vertex_edges(v))) << v;
      std::vector<Index> corners(topology.vertex_corners(v).begin(), topology.vertex_corners(v).end());
      std::ranges::sort(corners);
      ASSERT_TRUE(std::ranges::equal(polygons.vertex_corners(v), corners)) << v;
    }
    for (Index h = 0; h < polygons.half_edge_count(); ++h) {
      ASSERT_EQ(polygons.next(h), Topology::next(h));
      ASSERT_EQ(polygons.prev(h), Topology::prev(h));
      ASSERT_EQ(polygons.mate(h), topology.mate(h));
    }
  }
}

TEST(Polygons, of_several_sizes_go_round_their_faces) {
  const Polygons polygons = house();
  EXPECT_EQ(polygons.face_count(), 6u);
  for (Index f = 0; f < polygons.face_count(); ++f) {
    Index h = polygons.face_begin(f);
    for (Index k = 0; k < polygons.face_size(f); ++k) {
      EXPECT_EQ(polygons.face_of(h), f);
      EXPECT_EQ(polygons.prev(polygons.next(h)), h);
      h = polygons.next(h);
    }
    EXPECT_EQ(h, polygons.face_begin(f));
  }
}

// Euler: V - E + F = 1 for a disc.
TEST(Polygons, of_several_sizes_share_edges) {
  const Polygons polygons = house();
  EXPECT_EQ(polygons.edge_count(), 15u);
  Index borders = 0;
  for (Index e = 0; e < polygons.edge_count(); ++e) borders += polygons.edge_half_edges(e).size() == 1;
  EXPECT_EQ(borders, 4u);
  for (Index h = 0; h < polygons.half_edge_count(); ++h)
    if (polygons.mate(h) != kNoIndex) {
      EXPECT_EQ(polygons.mate(polygons.mate(h)), h);
      EXPECT_EQ(polygons.corner_vertex(polygons.mate(h)), polygons.corner_vertex(polygons.next(h)));
    }
}

TEST(Polygons, have_their_edges_counter_clockwise_around_a_vertex) {
  const Polygons polygons = house();
  for (Index v = 0; v < polygons.vertex_count(); ++v) {
    SCOPED_TRACE(v);
    const auto edges = polygons.vertex_edges(v);
    for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
      // Some face leaves v along this edge and comes to it along the next.
      EXPECT_TRUE(std::ranges::any_of(polygons.vertex_corners(v), [&](Index h) {
        return polygons.half_edge_edge(h) == edges[k] &&
               polygons.half_edge_edge(polygons.prev(h)) == edges[k + 1];
      }));
    }
  }
  EXPECT_EQ(polygons.other_end(polygons.vertex_edges(0)[0], 0), 1u);  // from the border on
}

TEST(Polygons, take_edges_that_share_their_ends_as_given) {
  const Polygons polygons(3, {0, 3, 6}, {0, 1, 2, 0, 2, 1}, {0, 1, 2, 2, 1, 3},
                          {{{0, 1}}, {{1, 2}}, {{0, 2}}, {{0, 1}}});
  EXPECT_EQ(polygons.edge_count(), 4u);
  EXPECT_EQ(polygons.mate(0), kNoIndex);
  EXPECT_EQ(polygons.mate(1), 4u);
}

}  // namespace
}  // namespace subdivd::plain

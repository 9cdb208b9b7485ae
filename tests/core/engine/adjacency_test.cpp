#include "core/engine/plain/adjacency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/topology.h"
#include "tests/shapes/random.h"
#include "tests/shapes/shapes.h"

namespace subdivd::plain {
namespace {

// A house without a floor: four walls of four corners, two triangles and two quads as the roof.
Adjacency house() {
  //  0 1 2 3 the ground, 4 5 6 7 above it, 8 and 9 the ridge: 8 above 4 and 7, 9 above 5 and 6
  return Adjacency(10, Polygons({0, 4, 9, 13, 18, 22, 26}, {0, 1, 5, 4, 1, 2, 6, 9, 5, 2, 3, 7, 6,
                                                            3, 0, 4, 8, 7, 4, 5, 9, 8, 6, 7, 8, 9}));
}

// The fast way to the same relations, over all that both can say.
template <class Faces>
void expect_same(const Topology<Faces>& topology, const Adjacency& adjacency) {
  ASSERT_EQ(topology.vertex_count(), adjacency.vertex_count());
  ASSERT_EQ(topology.face_count(), adjacency.face_count());
  ASSERT_TRUE(std::ranges::equal(adjacency.half_edge_edges(), topology.half_edge_edges()));
  ASSERT_TRUE(std::ranges::equal(adjacency.edge_vertices(), topology.edge_vertices()));
  const auto sorted = [](std::span<const Index> row) {
    std::vector<Index> items(row.begin(), row.end());
    std::ranges::sort(items);
    return items;
  };
  for (Index e = 0; e < topology.edge_count(); ++e)
    ASSERT_TRUE(std::ranges::equal(adjacency.edge_half_edges(e), sorted(topology.edge_half_edges(e)))) << e;
  for (Index v = 0; v < topology.vertex_count(); ++v) {
    ASSERT_TRUE(std::ranges::equal(adjacency.vertex_edges(v), topology.vertex_edges(v))) << v;
    ASSERT_TRUE(std::ranges::equal(adjacency.vertex_corners(v), sorted(topology.vertex_corners(v)))) << v;
  }
  for (Index h = 0; h < adjacency.half_edge_count(); ++h) {
    ASSERT_EQ(adjacency.next(h), topology.next(h));
    ASSERT_EQ(adjacency.prev(h), topology.prev(h));
    ASSERT_EQ(adjacency.face_of(h), topology.faces().face_of(h));
    ASSERT_EQ(adjacency.mate(h), topology.mate(h));
  }
}

// As one that knows their size, and as one that does not.
template <class Faces>
void expect_same(Index vertex_count, const Faces& faces) {
  std::vector<Index> begins;
  for (Index f = 0; f <= faces.count(); ++f) begins.push_back(faces.begin(f));
  const Polygons polygons(begins, {faces.corners().begin(), faces.corners().end()});
  const Adjacency adjacency(vertex_count, polygons);
  expect_same(Topology<Faces>(vertex_count, faces), adjacency);
  expect_same(Topology<Polygons>(vertex_count, polygons), adjacency);
  // Without vertices' neighbours the edges are the same; so they are when most vertices have no face.
  for (const Index unused : {Index{0}, static_cast<Index>(faces.corners().size())}) {
    const Connectivity<Faces> connectivity(vertex_count + unused, faces);
    ASSERT_TRUE(std::ranges::equal(adjacency.half_edge_edges(), connectivity.half_edge_edges()));
    ASSERT_TRUE(std::ranges::equal(adjacency.edge_vertices(), connectivity.edge_vertices()));
  }
}

// `count` faces of `size_of(f)` corners each, no face repeating one, over so few vertices that edges have
// many faces and windings clash.
template <class SizeOf>
Polygons random_faces(Index vertex_count, Index count, std::uint64_t seed, SizeOf&& size_of) {
  shapes::Random random(seed);
  std::vector<Index> begins = {0}, corners;
  for (Index f = 0; f < count; ++f) {
    for (const Index size = size_of(random); corners.size() < begins.back() + size;) {
      const auto v = static_cast<Index>(random.below(vertex_count));
      if (std::find(corners.begin() + begins.back(), corners.end(), v) == corners.end()) corners.push_back(v);
    }
    begins.push_back(static_cast<Index>(corners.size()));
  }
  return {begins, corners};
}

TEST(Adjacency, of_triangles_is_what_the_topology_says) {
  for (const auto& [name, mesh] : shapes::all_shapes()) {
    SCOPED_TRACE(name);
    expect_same(static_cast<Index>(mesh.point_count()), Triangles(mesh.face_vertex_indices));
  }
}

// A torus, a sheet with a border, and a sheet whose one row is wound the other way.
TEST(Adjacency, of_quads_is_what_the_topology_says) {
  constexpr Index kWide = 7, kHigh = 5;
  for (const bool closed : {true, false})
    for (const Index turned : {kNoIndex, Index{2}}) {
      const Index columns = kWide + (closed ? 0 : 1), rows = kHigh + (closed ? 0 : 1);
      std::vector<Index> corners;
      for (Index j = 0; j < kHigh; ++j)
        for (Index i = 0; i < kWide; ++i) {
          const auto at = [&](Index x, Index y) { return y % rows * columns + x % columns; };
          std::array<Index, 4> face = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
          if (j == turned) std::ranges::reverse(face);
          corners.insert(corners.end(), face.begin(), face.end());
        }
      expect_same(columns * rows, Quads(corners));
    }
}

TEST(Adjacency, of_any_faces_is_what_the_topology_says) {
  expect_same(10, Polygons({0, 4, 9, 13, 18, 22, 26},
                           {0, 1, 5, 4, 1, 2, 6, 9, 5, 2, 3, 7, 6, 3, 0, 4, 8, 7, 4, 5, 9, 8, 6, 7, 8, 9}));
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const auto vertices = static_cast<Index>(8 + seed * 5);
    expect_same(vertices, random_faces(vertices, vertices, seed, [](shapes::Random& random) {
                  return static_cast<Index>(3 + random.below(5));
                }));
    const Polygons quads = random_faces(vertices, vertices, seed, [](shapes::Random&) { return Index{4}; });
    expect_same(vertices, Quads({quads.corners().begin(), quads.corners().end()}));
  }
}

// A hub, whose edges are found another way: its faces, of four and five corners, meet there alone or along
// spokes, and a second hub is across every one of them.
TEST(Adjacency, of_faces_around_hubs_is_what_the_topology_says) {
  constexpr Index kSpokes = 100;
  std::vector<Index> begins = {0}, corners;
  for (Index k = 0; k < kSpokes; ++k) {
    const Index rim = 2 + k, next = 2 + (k + 1) % kSpokes;
    corners.insert(corners.end(), {0, rim, 1, next});
    if (k % 2 == 0) corners.insert(corners.end() - 1, 2 + kSpokes + k);
    begins.push_back(static_cast<Index>(corners.size()));
  }
  for (Index k = 0; k < 3; ++k) {  // the two hubs along an edge, in both directions
    const Index far = 2 + 2 * kSpokes + k;
    corners.insert(corners.end(), {k % 2, 1 - k % 2, far});
    begins.push_back(static_cast<Index>(corners.size()));
  }
  expect_same(2 + 3 * kSpokes, Polygons(begins, corners));
}

TEST(Adjacency, of_several_sizes_goes_round_its_faces) {
  const Adjacency polygons = house();
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
TEST(Adjacency, of_several_sizes_shares_edges) {
  const Adjacency polygons = house();
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

TEST(Adjacency, has_its_edges_counter_clockwise_around_a_vertex) {
  const Adjacency polygons = house();
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

TEST(Adjacency, takes_edges_that_share_their_ends_as_given) {
  const Adjacency polygons(3, Polygons({0, 3, 6}, {0, 1, 2, 0, 2, 1}), {0, 1, 2, 2, 1, 3},
                           {{{0, 1}}, {{1, 2}}, {{0, 2}}, {{0, 1}}});
  EXPECT_EQ(polygons.edge_count(), 4u);
  EXPECT_EQ(polygons.mate(0), kNoIndex);
  EXPECT_EQ(polygons.mate(1), 4u);
}

}  // namespace
}  // namespace subdivd::plain

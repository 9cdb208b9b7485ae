#include "core/mesh/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <random>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/mesh/creases.h"
#include "tests/shapes/build.h"
#include "tests/shapes/shapes.h"

namespace subdivd {
namespace {

Topology<Triangles> of(const ControlMesh& mesh) {
  return Topology<Triangles>(static_cast<Index>(mesh.point_count()), Triangles(mesh.face_vertex_indices));
}

TEST(Topology, numbers_edges_as_the_faces_run_along_them) {
  const Topology<Triangles> topology(4, Triangles({0, 1, 2, 2, 1, 3}));
  ASSERT_EQ(topology.edge_count(), 5u);
  EXPECT_EQ(topology.edge_vertices(0), (std::array<Index, 2>{0, 1}));
  EXPECT_EQ(topology.edge_vertices(1), (std::array<Index, 2>{1, 2}));
  EXPECT_EQ(topology.edge_vertices(2), (std::array<Index, 2>{0, 2}));
  EXPECT_EQ(topology.edge_vertices(3), (std::array<Index, 2>{1, 3}));
  EXPECT_EQ(topology.mate(1), 3u);
  EXPECT_EQ(topology.mate(3), 1u);
  EXPECT_EQ(topology.mate(0), kNoIndex);
}

TEST(Topology, every_relation_agrees_with_the_triangles) {
  for (const auto& [name, mesh] : shapes::all_shapes()) {
    SCOPED_TRACE(name);
    const Topology<Triangles> topology = of(mesh);
    Count corners = 0, half_edges = 0, ends = 0;
    for (Index v = 0; v < topology.vertex_count(); ++v) {
      corners += topology.vertex_corners(v).size();
      ends += topology.vertex_edges(v).size();
      for (Index h : topology.vertex_corners(v)) ASSERT_EQ(topology.corner_vertex(h), v);
      for (Index e : topology.vertex_edges(v)) {
        const auto [a, b] = topology.edge_vertices(e);
        ASSERT_TRUE(a == v || b == v);
        ASSERT_EQ(topology.other_end(e, v), a == v ? b : a);
      }
    }
    for (Index e = 0; e < topology.edge_count(); ++e) {
      half_edges += topology.edge_half_edges(e).size();
      const auto [a, b] = topology.edge_vertices(e);
      ASSERT_LT(a, b);
      for (Index h : topology.edge_half_edges(e)) {
        const Index from = topology.corner_vertex(h), to = topology.corner_vertex(Triangles::next(h));
        ASSERT_EQ(std::min(from, to), a);
        ASSERT_EQ(std::max(from, to), b);
      }
    }
    EXPECT_EQ(corners, topology.corner_vertices().size());
    EXPECT_EQ(half_edges, topology.corner_vertices().size());
    EXPECT_EQ(ends, 2 * Count{topology.edge_count()});
  }
}

TEST(Topology, finds_an_edge_of_three_faces) {
  const Topology<Triangles> topology(5, Triangles({0, 1, 2, 1, 0, 3, 0, 1, 4}));
  EXPECT_TRUE(topology.is_non_manifold_edge(0));
  EXPECT_TRUE(topology.is_non_manifold_vertex(0));
  EXPECT_FALSE(topology.is_non_manifold_vertex(2));
}

TEST(Topology, finds_windings_that_clash) {
  const Topology<Triangles> topology(4, Triangles({0, 1, 2, 0, 1, 3}));
  EXPECT_TRUE(topology.is_non_manifold_edge(0));
  EXPECT_EQ(topology.mate(0), kNoIndex);
}

TEST(Topology, finds_a_bow_tie) {
  const Topology<Triangles> topology(5, Triangles({0, 1, 2, 0, 3, 4}));
  EXPECT_TRUE(topology.is_non_manifold_vertex(0));
  EXPECT_FALSE(topology.is_non_manifold_vertex(1));
}

TEST(Topology, an_unreferenced_point_has_neither_edges_nor_corners) {
  const Topology<Triangles> topology(4, Triangles({0, 1, 2}));
  EXPECT_TRUE(topology.vertex_edges(3).empty());
  EXPECT_TRUE(topology.vertex_corners(3).empty());
  EXPECT_FALSE(topology.is_non_manifold_vertex(3));
}

// A fan around point 0 whose faces are listed at random: `rim` points 1.., closed or open.
std::vector<Index> fan_of(Index rim, bool closed) {
  std::vector<std::array<Index, 3>> faces;
  for (Index k = 1; k < rim + closed; ++k) faces.push_back({0, k, k % rim + 1});
  std::mt19937 random(rim);
  std::ranges::shuffle(faces, random);
  std::vector<Index> triangles;
  for (const auto& face : faces) triangles.insert(triangles.end(), face.begin(), face.end());
  return triangles;
}

TEST(Topology, corners_and_edges_go_round_a_manifold_vertex) {
  // Up to a few edges a point keeps them in one place, further ones in another, a hub in none.
  for (const Index rim : {3u, 7u, 8u, 9u, 20u, 64u, 65u, 66u, 1000u})
    for (const bool closed : {false, true}) {
      const Topology<Triangles> topology(rim + 1, Triangles(fan_of(rim, closed)));
      const auto corners = topology.vertex_corners(0), edges = topology.vertex_edges(0);
      ASSERT_FALSE(topology.is_non_manifold_vertex(0));
      ASSERT_EQ(corners.size(), rim - !closed);
      ASSERT_EQ(edges.size(), rim);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        EXPECT_EQ(topology.half_edge_edge(corners[k]), edges[k]);
        EXPECT_EQ(topology.half_edge_edge(Triangles::prev(corners[k])), edges[(k + 1) % rim]);
      }
      if (closed) {
        EXPECT_EQ(corners[0], *std::ranges::min_element(corners));
      } else {
        EXPECT_EQ(topology.other_end(edges[0], 0), 1u);
      }
      // Only the spokes lead to point 0, and the rim closes: every edge was found once.
      EXPECT_EQ(topology.edge_count(), 2 * rim - !closed);
    }
}

// A grid of 48,400 points, whose rows are worth sharing out, with a bow tie, a hub of two thousand corners and
// a hole.
std::vector<Index> large_and_uneven() {
  std::vector<Index> triangles = shapes::grid(219, 219).face_vertex_indices;
  std::vector<Index> kept;
  for (std::size_t f = 0; f < triangles.size(); f += 3) {
    const std::array<Index, 3> face{triangles[f], triangles[f + 1], triangles[f + 2]};
    if (std::ranges::count(face, 24'200u) != 0) continue;
    for (const Index v : face) kept.push_back(v == 40'000 ? 300 : v);
  }
  for (Index k = 0; k < 2'000; ++k) kept.insert(kept.end(), {24'200, 48'400 + k, 48'400 + (k + 1) % 2'000});
  return kept;
}

TEST(Topology, is_the_same_however_many_threads_go_round_its_vertices) {
  const std::vector<Index> triangles = large_and_uneven();
  const Index vertices = 48'400 + 2'000;
  const Topology<Triangles> expected(vertices, Triangles(triangles));
  ASSERT_TRUE(expected.is_non_manifold_vertex(300));
  ASSERT_EQ(expected.vertex_corners(24'200).size(), 2'000u);
  for (const Index helpers : {1u, 2u, 5u}) {
    ThreadPool pool(helpers);
    Budget budget;
    budget.helpers = &pool;
    const auto built = Topology<Triangles>::build(vertices, Triangles(triangles), budget);
    ASSERT_TRUE(built.ok());
    for (Index v = 0; v < vertices; ++v) {
      ASSERT_TRUE(std::ranges::equal(built->vertex_corners(v), expected.vertex_corners(v))) << v;
      ASSERT_TRUE(std::ranges::equal(built->vertex_edges(v), expected.vertex_edges(v))) << v;
      ASSERT_EQ(built->is_non_manifold_vertex(v), expected.is_non_manifold_vertex(v)) << v;
    }
  }
}

// Nobody waits any more from when the first helper is asked.
class HelpersOfTheImpatient final : public Helpers {
 public:
  Index most() const override { return pool_.most(); }
  Index start(Index most, Job& job) override {
    gone = true;
    return pool_.start(most, job);
  }
  void finish(Job& job) override { pool_.finish(job); }

  std::atomic<bool> gone{false};

 private:
  ThreadPool pool_{2};
};

TEST(Topology, stops_while_several_threads_go_round_its_vertices) {
  HelpersOfTheImpatient helpers;
  Budget budget;
  budget.helpers = &helpers;
  budget.cancelled = &helpers.gone;
  const auto built = Topology<Triangles>::build(50'400, Triangles(large_and_uneven()), budget);
  ASSERT_TRUE(helpers.gone);
  ASSERT_FALSE(built.ok());
  EXPECT_EQ(built.error().code, ErrorCode::cancelled);
}

TEST(Topology, edges_between_hubs_are_found_once) {
  // Two hubs and a hundred points between them: every face has the edge of the hubs.
  std::vector<Index> triangles;
  for (Index k = 0; k < 100; ++k)
    for (const Index v : {k % 2, 1 - k % 2, k + 2}) triangles.push_back(v);
  // With a thousand unused points, too: edges are then found in another way.
  for (const Index points : {102u, 1102u}) {
    const Topology<Triangles> topology(points, Triangles(triangles));
    ASSERT_EQ(topology.edge_count(), 201u);
    EXPECT_EQ(topology.edge_half_edges(topology.half_edge_edge(0)).size(), 100u);
  }
}

TEST(Creases, their_edges_are_found_at_hubs_and_elsewhere) {
  // A wheel: point 0 is a hub of a hundred edges, the others have three.
  std::vector<Index> triangles;
  for (Index k = 0; k < 100; ++k)
    for (const Index v : {Index{0}, 1 + k, 1 + (k + 1) % 100}) triangles.push_back(v);
  const Topology<Triangles> topology(103, Triangles(triangles));
  const std::vector<VertexPair> pairs{{0, 7}, {7, 0},   {7, 8},     {8, 7},   {1, 100},
                                      {7, 9}, {0, 101}, {101, 102}, {5, 103}, {0, kNoIndex}};
  const std::vector<Index> found = edges_between(topology, std::span<const VertexPair>(pairs), {});
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    SCOPED_TRACE(k);
    if (k > 4) {
      EXPECT_EQ(found[k], kNoIndex);
      continue;
    }
    ASSERT_LT(found[k], topology.edge_count());
    EXPECT_EQ(topology.edge_vertices(found[k]),
              (VertexPair{std::min(pairs[k][0], pairs[k][1]), std::max(pairs[k][0], pairs[k][1])}));
  }
}

TEST(Topology, unused_points_change_nothing) {
  for (const auto& [name, mesh] : shapes::all_shapes()) {
    SCOPED_TRACE(name);
    const Topology<Triangles> with(static_cast<Index>(mesh.point_count()) + 10000,
                                   Triangles(mesh.face_vertex_indices)),
        without = of(mesh);
    ASSERT_TRUE(std::ranges::equal(with.half_edge_edges(), without.half_edge_edges()));
    ASSERT_TRUE(std::ranges::equal(with.edge_sides(), without.edge_sides()));
    ASSERT_TRUE(std::ranges::equal(with.edge_kinds(), without.edge_kinds()));
  }
}

TEST(Topology, finds_a_closed_and_an_open_fan_at_one_vertex) {
  // A tetrahedron and a triangle that touch in point 0, the triangle's corner first and last.
  for (const bool first : {false, true}) {
    std::vector<Index> triangles{0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
    triangles.insert(first ? triangles.begin() : triangles.end(), {0, 4, 5});
    const Topology<Triangles> topology(6, Triangles(triangles));
    EXPECT_TRUE(topology.is_non_manifold_vertex(0));
    EXPECT_TRUE(std::ranges::is_sorted(topology.vertex_corners(0)));
    EXPECT_TRUE(std::ranges::is_sorted(topology.vertex_edges(0)));
    EXPECT_EQ(topology.vertex_corners(0).size(), 4u);
    EXPECT_EQ(topology.vertex_edges(0).size(), 5u);
    EXPECT_FALSE(topology.is_non_manifold_vertex(1));
  }
}

TEST(Fans, hold_every_corner_once_and_turn_counter_clockwise) {
  for (const auto& [name, mesh] : shapes::all_shapes()) {
    SCOPED_TRACE(name);
    const Topology<Triangles> topology = of(mesh);
    for (Index v = 0; v < topology.vertex_count(); ++v) {
      std::vector<Index> seen;
      const Topology<Triangles>::Fans fans = topology.fans(v, [](Index) { return true; });
      for (std::size_t f = 0; f < fans.size(); ++f) {
        const Topology<Triangles>::Fan fan = fans[f];
        for (std::size_t k = 0; k + 1 < fan.corners.size(); ++k)
          ASSERT_EQ(topology.mate(Triangles::prev(fan.corners[k])), fan.corners[k + 1]);
        if (fan.closed) {
          ASSERT_EQ(topology.mate(Triangles::prev(fan.corners.back())), fan.corners.front());
        }
        seen.insert(seen.end(), fan.corners.begin(), fan.corners.end());
      }
      ASSERT_TRUE(std::ranges::is_permutation(seen, topology.vertex_corners(v)));
    }
  }
}

TEST(Fans, end_at_edges_that_may_not_be_passed) {
  const Topology<Triangles> topology(5, Triangles({0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1}));
  const Index wall = topology.half_edge_edge(0);
  const auto fans = topology.fans(0, [&](Index e) { return e != wall; });
  ASSERT_EQ(fans.size(), 1u);
  EXPECT_FALSE(fans[0].closed);
  const auto corners = fans[0].corners;
  EXPECT_EQ(std::vector(corners.begin(), corners.end()), (std::vector<Index>{0, 3, 6, 9}));
}

}  // namespace
}  // namespace subdivd

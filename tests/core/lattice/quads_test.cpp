// The closed form of refined quads, beside the plain engine, which makes every level's topology.
#include "core/lattice/quads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include "core/engine/plain/split.h"
#include "core/mesh/topology.h"
#include "tests/shapes/polygons.h"

namespace subdivd {
namespace {

struct NamedQuads {
  std::string name;
  Topology<Quads> topology;
};

// Every shape of quads alone, and what one step makes of every other.
std::vector<NamedQuads> all_quads() {
  std::vector<NamedQuads> all;
  for (const auto& [name, mesh] : shapes::polygon_shapes()) {
    const auto vertices = static_cast<Index>(mesh.point_count());
    const auto& counts = mesh.face_vertex_counts;
    if (!counts.empty() && std::ranges::count(counts, 4u) == static_cast<std::ptrdiff_t>(counts.size())) {
      all.push_back({name, Topology<Quads>(vertices, Quads(mesh.face_vertex_indices))});
      continue;
    }
    std::vector<Index> offsets{0};
    for (Count f = 0; f < mesh.face_count(); ++f)
      offsets.push_back(offsets.back() + (counts.empty() ? 3 : counts[f]));
    const plain::Adjacency base(vertices, Polygons(offsets, mesh.face_vertex_indices));
    const plain::Adjacency split = plain::split_faces(Split::quads, base, {});
    all.push_back({name + " split", Topology<Quads>(split.vertex_count(), Quads({split.corners().begin(),
                                                                                 split.corners().end()}))});
  }
  return all;
}

plain::Adjacency plain_of(const Topology<Quads>& topology) {
  std::vector<Index> offsets;
  for (Index f = 0; f <= topology.face_count(); ++f) offsets.push_back(4 * f);
  const auto corners = topology.corner_vertices(), edges = topology.half_edge_edges();
  const auto ends = topology.edge_vertices();
  return plain::Adjacency(topology.vertex_count(),
                          Polygons(std::move(offsets), {corners.begin(), corners.end()}),
                          {edges.begin(), edges.end()}, {ends.begin(), ends.end()});
}

// A quad from its lowest point on.
std::array<Index, 4> turned(std::array<Index, 4> quad) {
  std::ranges::rotate(quad, std::ranges::min_element(quad));
  return quad;
}

TEST(Numbering, counts_are_those_of_refining_step_by_step) {
  for (const auto& [name, topology] : all_quads()) {
    plain::Adjacency at = plain_of(topology);
    for (Index level = 1; level <= 3; ++level) {
      at = plain::split_faces(Split::quads, at, {});
      const LevelCounts counts =
          refined_quad_counts(topology.vertex_count(), topology.edge_count(), topology.face_count(), level);
      EXPECT_EQ(counts.vertices, at.vertex_count()) << name;
      EXPECT_EQ(counts.edges, at.edge_count()) << name;
      EXPECT_EQ(counts.faces, at.face_count()) << name;
    }
  }
}

TEST(Numbering, is_a_bijection_and_faces_agree_along_their_edges) {
  for (const auto& [name, topology] : all_quads())
    for (const Index level : {0u, 1u, 2u, 3u}) {
      SCOPED_TRACE(name);
      const Numbering numbering(topology, level);
      const Count n = numbering.segment_count();
      std::vector<std::set<std::pair<Index, Count>>> places(numbering.vertex_count());
      for (Index f = 0; f < topology.face_count(); ++f)
        for (Count j = 0; j <= n; ++j)
          for (Count i = 0; i <= n; ++i) {
            const Index number = numbering.vertex(f, i, j);
            ASSERT_LT(number, places.size());
            places[number].insert({f, j * (n + 1) + i});
          }
      for (Index v = 0; v < topology.vertex_count(); ++v)
        EXPECT_EQ(places[v].size(), topology.vertex_corners(v).size()) << v;
      for (Count v = topology.vertex_count() + topology.edge_count() * (n - 1); v < places.size(); ++v)
        EXPECT_EQ(places[v].size(), 1u) << v;
      for (Index e = 0; e < topology.edge_count(); ++e)
        for (Count k = 1; k < n; ++k)
          EXPECT_EQ(places[numbering.along(e, k)].size(), topology.edge_half_edges(e).size());
    }
}

TEST(Numbering, names_the_quads_that_refining_step_by_step_makes) {
  for (const auto& [name, topology] : all_quads()) {
    SCOPED_TRACE(name);
    plain::Adjacency at = plain_of(topology);
    // The corner of every face of the level that it was split from, on the grid of its base face.
    std::vector<std::array<std::array<Count, 2>, 4>> places(topology.face_count(),
                                                            {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
    for (Index level = 1; level <= 3; ++level) {
      std::vector<std::array<std::array<Count, 2>, 4>> next;
      for (const auto& p : places)
        for (std::size_t k = 0; k < 4; ++k) {
          const auto sum = [](const auto& a, const auto& b) {
            return std::array<Count, 2>{a[0] + b[0], a[1] + b[1]};
          };
          const auto doubled = sum(p[k], p[k]), ahead = sum(p[k], p[(k + 1) % 4]),
                     back = sum(p[k], p[(k + 3) % 4]);
          const std::array<Count, 2> middle = sum(p[0], p[2]);
          next.push_back({doubled, ahead, middle, back});
        }
      places = std::move(next);
      at = plain::split_faces(Split::quads, at, {});
      const Numbering numbering(topology, level);
      const Count n = numbering.segment_count(), children = n * n;
      std::vector<Index> closed(at.vertex_count(), kNoIndex);
      std::set<std::array<Index, 4>> theirs, ours;
      for (Index f = 0; f < at.face_count(); ++f) {
        std::array<Index, 4> quad{};
        for (Index k = 0; k < 4; ++k) {
          quad[k] = numbering.vertex(static_cast<Index>(f / children), places[f][k][0], places[f][k][1]);
          Index& number = closed[at.corner_vertex(4 * f + k)];
          if (number == kNoIndex) number = quad[k];
          ASSERT_EQ(number, quad[k]);  // faces agree
        }
        theirs.insert(turned(quad));
      }
      for (Index f = 0; f < topology.face_count(); ++f)
        for (Count j = 0; j < n; ++j)
          for (Count i = 0; i < n; ++i)
            ours.insert(turned({numbering.vertex(f, i, j), numbering.vertex(f, i + 1, j),
                                numbering.vertex(f, i + 1, j + 1), numbering.vertex(f, i, j + 1)}));
      EXPECT_EQ(theirs, ours);
    }
  }
}

TEST(Numbering, the_row_beside_a_half_edge_makes_quads_with_it) {
  for (const auto& [name, topology] : all_quads()) {
    SCOPED_TRACE(name);
    const Numbering numbering(topology, 2);
    const Count n = numbering.segment_count();
    for (Index h = 0; h < topology.corner_vertices().size(); ++h) {
      const Index e = topology.half_edge_edge(h);
      const bool up = topology.edge_vertices(e)[0] == topology.corner_vertex(h);
      std::set<std::set<Index>> quads;
      for (Count j = 0; j < n; ++j)
        for (Count i = 0; i < n; ++i)
          quads.insert({numbering.vertex(h / 4, i, j), numbering.vertex(h / 4, i + 1, j),
                        numbering.vertex(h / 4, i + 1, j + 1), numbering.vertex(h / 4, i, j + 1)});
      for (Count p = 0; p < n; ++p)
        EXPECT_TRUE(
            quads.contains({numbering.along(e, up ? p : n - p), numbering.along(e, up ? p + 1 : n - p - 1),
                            numbering.beside(h, p), numbering.beside(h, p + 1)}))
            << h << ' ' << p;
    }
  }
}

}  // namespace
}  // namespace subdivd

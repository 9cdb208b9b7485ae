#include "core/lattice/provenance.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "core/lattice/numbering.h"
#include "core/lattice/sources.h"
#include "tests/shapes/build.h"
#include "tests/shapes/shapes.h"

namespace subdivd {
namespace {

constexpr Index kLevels[] = {0, 1, 2, 3};

Connectivity<Triangles> connectivity_of(const ControlMesh& mesh) {
  return Connectivity<Triangles>(static_cast<Index>(mesh.point_count()), Triangles(mesh.face_vertex_indices));
}

std::vector<Provenance> provenance_of(const Connectivity<Triangles>& connectivity, Index level) {
  std::vector<Provenance> places(Numbering(connectivity, level).vertex_count());
  write_provenance(connectivity, level, places, Pace());
  return places;
}

TEST(Provenance, leads_back_to_the_vertex) {
  for (const auto& [name, mesh] : shapes::all_shapes()) {
    SCOPED_TRACE(name);
    const Connectivity<Triangles> connectivity = connectivity_of(mesh);
    for (const Index level : kLevels) {
      const Numbering numbering(connectivity, level);
      const auto places = provenance_of(connectivity, level);
      for (Index v = 0; v < places.size(); ++v)
        if (places[v].face != kNoIndex) {
          ASSERT_EQ(numbering.vertex(places[v].face, places[v].i, places[v].j), v);
        }
    }
  }
}

TEST(Provenance, is_of_the_lowest_face_that_has_the_vertex) {
  for (const auto& [name, mesh] : shapes::all_shapes()) {
    SCOPED_TRACE(name);
    const Connectivity<Triangles> connectivity = connectivity_of(mesh);
    for (const Index level : kLevels) {
      const Numbering numbering(connectivity, level);
      const Count n = numbering.segment_count();
      std::vector<Index> lowest(numbering.vertex_count(), kNoIndex);
      for (Index f = 0; f < connectivity.face_count(); ++f)
        for (Count j = 0; j <= n; ++j)
          for (Count i = 0; i + j <= n; ++i) {
            Index& least = lowest[numbering.vertex(f, i, j)];
            least = std::min(least, f);
          }
      const auto places = provenance_of(connectivity, level);
      for (Index v = 0; v < places.size(); ++v) ASSERT_EQ(places[v].face, lowest[v]);
    }
  }
}

// The array may come unset.
TEST(Provenance, of_a_point_without_faces_is_none_whatever_stood_there) {
  ControlMesh mesh = shapes::tetrahedron();
  mesh.points.insert(mesh.points.end(), {7, 7, 7});
  const Connectivity<Triangles> connectivity = connectivity_of(mesh);
  std::vector<Provenance> places(Numbering(connectivity, 1).vertex_count(), Provenance{2, 1, 1});
  write_provenance(connectivity, 1, places, Pace());
  EXPECT_EQ(places[4].face, kNoIndex);
}

TEST(TriangleFaces, leave_out_holes) {
  const std::vector<unsigned char> holes{0, 1, 0};
  std::vector<Index> faces(2 * triangles_per_face(1), kNoIndex);
  write_triangle_faces(1, holes, faces.data(), Pace());
  EXPECT_EQ(faces, (std::vector<Index>{0, 0, 0, 0, 2, 2, 2, 2}));
}

TEST(Split, finds_a_triangle_by_its_corners_from_any_of_them_on) {
  for (const Count n : {1, 2, 4, 8}) {
    Count expected = 0;
    const auto at = [](Count i, Count j) { return GridPoint{static_cast<Index>(i), static_cast<Index>(j)}; };
    for_each_triangle(n, [&](Count i0, Count j0, Count i1, Count j1, Count i2, Count j2) {
      const GridPoint a = at(i0, j0), b = at(i1, j1), c = at(i2, j2);
      for (const auto& corners : {std::array{a, b, c}, std::array{b, c, a}, std::array{c, a, b}}) {
        ASSERT_EQ(triangle_index(n, corners), expected);
      }
      ++expected;
    });
  }
}

TEST(Split, numbers_the_points_of_a_face_row_by_row) {
  for (const Count n : {1, 2, 4, 8}) {
    Count expected = 0;
    for (Count j = 0; j <= n; ++j)
      for (Count i = 0; i + j <= n; ++i) ASSERT_EQ(face_point_index(n, i, j), expected++);
    EXPECT_EQ(face_points(n), expected);
  }
}

TEST(Sources, are_at_the_same_place_of_the_same_face) {
  const ControlMesh mesh = shapes::icosahedron();
  const Connectivity<Triangles> whole = connectivity_of(mesh);
  // Faces 5 to 12, torn apart at every edge.
  constexpr Index kFirst = 5, kCount = 8;
  std::vector<Index> torn(3 * kCount);
  for (Index k = 0; k < torn.size(); ++k) torn[k] = k;
  const Connectivity<Triangles> part(3 * kCount, Triangles(std::move(torn)));
  std::vector<unsigned char> holes(kCount, 0);
  holes[3] = 1;
  for (const Index level : kLevels) {
    const Numbering to(part, level), from(whole, level);
    const Count n = to.segment_count();
    const Buffer<Index> sources = vertex_sources(part, whole, kFirst, level, holes, Pace());
    ASSERT_EQ(sources.size(), to.vertex_count());
    for (Index f = 0; f < kCount; ++f)
      for (Count j = 0; j <= n; ++j)
        for (Count i = 0; i + j <= n; ++i)
          ASSERT_EQ(sources[to.vertex(f, i, j)], holes[f] != 0 ? kNoIndex : from.vertex(kFirst + f, i, j));
  }
}

}  // namespace
}  // namespace subdivd

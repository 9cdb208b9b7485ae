// Every place and every refined face has a number of its own, whatever the faces are.

#include "core/oracle/grids.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <vector>

#include "core/lattice/numbering.h"

namespace subdivd::oracle::testing {
namespace {

using Quad = std::array<GridPoint, 4>;

struct Numbers {
  std::set<Count> seen;
  Count added = 0;

  void add(Count number) {
    seen.insert(number);
    ++added;
  }
  void expect_all(Count count) const {
    EXPECT_EQ(added, count);
    EXPECT_EQ(seen.size(), count);
    EXPECT_EQ(*seen.rbegin() + 1, count);
  }
};

Quad square_at(Index i, Index j, Index step) {
  return {GridPoint{i + step, j}, {i + step, j + step}, {i, j + step}, {i, j}};
}

TEST(Grids, number_the_places_and_faces_of_triangles) {
  for (const Index level : {0u, 1u, 3u}) {
    const auto n = static_cast<Index>(segments(level));
    const FaceRows base(3, 2);
    const Grids grids(GridShape::triangles, level, base, Pace());
    Numbers places, faces;
    for (Index f = 0; f < 2; ++f)
      for (Index j = 0; j <= n; ++j)
        for (Index i = 0; i + j <= n; ++i) places.add(grids.place_number({f, i, j}));
    places.expect_all(grids.place_count());
    for_each_triangle(n, [&](Count i0, Count j0, Count i1, Count j1, Count i2, Count j2) {
      const auto at = [](Count i, Count j) {
        return GridPoint{static_cast<Index>(i), static_cast<Index>(j)};
      };
      const std::array<GridPoint, 3> corners{at(i0, j0), at(i1, j1), at(i2, j2)};
      faces.add(grids.face_number(1, 0, corners));
    });
    faces.expect_all(grids.face_count(1));
  }
}

TEST(Grids, number_the_places_and_faces_of_quads) {
  for (const Index level : {0u, 1u, 3u}) {
    const auto n = static_cast<Index>(segments(level));
    const FaceRows base(4, 3);
    const Grids grids(GridShape::quads, level, base, Pace());
    Numbers places, faces;
    for (Index f = 0; f < 3; ++f)
      for (Index j = 0; j <= n; ++j)
        for (Index i = 0; i <= n; ++i) places.add(grids.place_number({f, i, j}));
    places.expect_all(grids.place_count());
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) faces.add(grids.face_number(2, 0, square_at(i, j, 1)));
    faces.expect_all(grids.face_count(2));
  }
}

TEST(Grids, number_the_places_and_faces_of_polygons) {
  const std::vector<Index> sizes{3, 4, 5};
  const FaceRows base(sizes, Pace());
  for (const Index level : {0u, 1u, 3u}) {
    const auto n = static_cast<Index>(segments(level)), last = level == 0 ? 0 : n;
    const Grids grids(GridShape::corners, level, base, Pace());
    Numbers places;
    for (Index j = 0; j <= n; ++j)
      for (Index i = 0; i <= n; ++i) places.add(grids.place_number({1, i, j}));
    for (const Index f : {0u, 2u})
      for (Index corner = 0; corner < sizes[f]; ++corner)
        for (Index j = 0; j <= last; j += 2)
          for (Index i = 0; i <= last; i += 2) places.add(grids.place_number({f, i, j, corner}));
    places.expect_all(grids.place_count());
    if (level == 0) continue;
    for (Index f = 0; f < 3; ++f) {
      Numbers faces;
      const bool whole = f == 1;
      const Index step = whole ? 1 : 2;
      for (Index corner = 0; corner < (whole ? 1 : sizes[f]); ++corner)
        for (Index j = 0; j < n; j += step)
          for (Index i = 0; i < n; i += step) faces.add(grids.face_number(f, corner, square_at(i, j, step)));
      faces.expect_all(grids.face_count(f));
      EXPECT_EQ(grids.face_count(f), sizes[f] * triangles_per_face(level - 1));
    }
  }
}

// The quads at corner 1 follow those at corner 0, row by row from their own corner: towards corner 2 first.
TEST(Grids, count_a_quad_among_polygons_corner_by_corner) {
  const std::vector<Index> sizes{3, 4};
  const FaceRows base(sizes, Pace());
  const Grids grids(GridShape::corners, 2, base, Pace());
  const auto number = [&](Index i, Index j) { return grids.face_number(1, 0, square_at(i, j, 1)); };
  EXPECT_EQ(number(0, 0), 0u);
  EXPECT_EQ(number(1, 0), 1u);
  EXPECT_EQ(number(3, 0), 4u);
  EXPECT_EQ(number(3, 1), 5u);
  EXPECT_EQ(number(3, 3), 8u);
  EXPECT_EQ(number(2, 3), 9u);
  EXPECT_EQ(number(0, 3), 12u);
  EXPECT_EQ(number(0, 2), 13u);
}

TEST(Grids, know_where_no_place_is) {
  const std::vector<Index> sizes{3, 4};
  const FaceRows base(sizes, Pace());
  const Grids grids(GridShape::corners, 2, base, Pace());
  for (const Provenance& nowhere : {Provenance{2, 0, 0}, Provenance{kNoIndex, 0, 0}, Provenance{0, 1, 0},
                                    Provenance{0, 6, 0}, Provenance{0, 0, kNoIndex}, Provenance{0, 0, 0, 3},
                                    Provenance{1, 5, 0}, Provenance{1, 0, kNoIndex}, Provenance{1, 0, 0, 1}})
    EXPECT_EQ(grids.place_number(nowhere), Grids::kNowhere);
  const FaceRows triangles(3, 1);
  EXPECT_EQ(Grids(GridShape::triangles, 2, triangles, Pace()).place_number({0, 3, 2}), Grids::kNowhere);
}

}  // namespace
}  // namespace subdivd::oracle::testing

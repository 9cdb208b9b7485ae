#include "core/oracle/correspondence.h"

#include <numeric>
#include <set>

#include "tests/core/oracle/fixtures.h"

namespace subdivd::oracle::testing {
namespace {

Correspondence matched(const Both<double>& both) {
  return match(connectivity_of(both.ours, patient()), both.far, patient());
}

bool identical(const Both<double>& both) { return matched(both).identical; }

TEST(Correspondence, pairs_every_vertex_once) {
  const auto both = both_of(rich_mesh());
  const Correspondence pairs = matched(both);
  EXPECT_TRUE(pairs.identical);
  const std::set<Index> ours(pairs.vertices.begin(), pairs.vertices.end());
  EXPECT_EQ(ours.size(), both.ours.provenance.size());
  EXPECT_EQ(*ours.rbegin() + 1, both.ours.provenance.size());
}

TEST(Correspondence, pairs_every_triangle_but_those_of_holes) {
  const auto both = both_of(rich_mesh());
  const Correspondence pairs = matched(both);
  EXPECT_EQ(std::count(pairs.faces.begin(), pairs.faces.end(), kNoIndex), 16);
  EXPECT_EQ(both.ours.base_faces.size(), 9u * 16);
}

TEST(Correspondence, paired_corners_are_the_same_vertex) {
  const auto both = both_of(rich_mesh());
  const Correspondence pairs = matched(both);
  for (std::size_t c = 0; c < pairs.corners.size(); ++c) {
    if (pairs.corners[c] == kNoIndex) continue;
    ASSERT_EQ(both.ours.faces[pairs.corners[c]], pairs.vertices[both.far.faces[c]]);
  }
}

TEST(Correspondence, does_not_look_at_positions) {
  ControlMesh flat = rich_mesh();
  flat.points.assign(flat.points.size(), 1);
  EXPECT_TRUE(identical(both_of(flat)));
}

TEST(Correspondence, keeps_unreferenced_points) {
  ControlMesh mesh = shapes::icosahedron();
  mesh.points.insert(mesh.points.end(), {7, 8, 9});
  EXPECT_TRUE(identical(both_of(mesh)));
}

TEST(Correspondence, accepts_corners_that_start_elsewhere) {
  auto both = both_of(rich_mesh());
  std::rotate(both.ours.faces.begin() + 9, both.ours.faces.begin() + 10, both.ours.faces.begin() + 12);
  EXPECT_TRUE(identical(both));
}

TEST(Correspondence, finds_two_swapped_corners) {
  auto both = both_of(rich_mesh());
  std::swap(both.ours.faces[9], both.ours.faces[10]);
  EXPECT_FALSE(identical(both));
}

TEST(Correspondence, finds_two_swapped_triangles) {
  auto both = both_of(rich_mesh());
  std::swap_ranges(both.ours.faces.begin(), both.ours.faces.begin() + 3, both.ours.faces.begin() + 30);
  EXPECT_FALSE(identical(both));
}

TEST(Correspondence, finds_a_triangle_with_another_vertex) {
  auto both = both_of(rich_mesh());
  both.ours.faces[40] = both.ours.faces[100];
  EXPECT_FALSE(identical(both));
}

TEST(Correspondence, finds_a_missing_triangle) {
  auto both = both_of(rich_mesh());
  both.ours.faces.resize(both.ours.faces.size() - 3);
  both.ours.base_faces.pop_back();
  EXPECT_FALSE(identical(both));
}

TEST(Correspondence, finds_a_triangle_too_many) {
  auto both = both_of(rich_mesh());
  both.ours.faces.insert(both.ours.faces.end(), {0, 1, 2});
  both.ours.base_faces.push_back(9);
  EXPECT_FALSE(identical(both));
}

TEST(Correspondence, finds_a_hole_that_was_filled) {
  ControlMesh mesh = rich_mesh();
  auto both = both_of(mesh);
  mesh.hole_indices.clear();
  both.ours = std::move(*refine<double>(mesh, everything(kLevel), Budget{}));
  EXPECT_FALSE(identical(both));
}

TEST(Correspondence, finds_a_wrong_base_face) {
  auto both = both_of(rich_mesh());
  both.ours.base_faces[20] = 8;
  EXPECT_FALSE(identical(both));
}

TEST(Correspondence, finds_a_wrong_provenance) {
  auto both = both_of(rich_mesh());
  std::swap(both.ours.provenance[10], both.ours.provenance[11]);
  EXPECT_FALSE(identical(both));
}

TEST(Correspondence, finds_a_vertex_too_many) {
  auto both = both_of(rich_mesh());
  both.ours.provenance.push_back({});
  EXPECT_FALSE(identical(both));
}

TEST(Correspondence, finds_a_vertex_too_few) {
  auto both = both_of(rich_mesh());
  both.ours.provenance.pop_back();
  EXPECT_FALSE(identical(both));
}

TEST(Correspondence, finds_another_level) {
  auto both = both_of(rich_mesh());
  both.ours = std::move(*refine<double>(both.mesh, everything(kLevel + 1), Budget{}));
  EXPECT_FALSE(identical(both));
}

}  // namespace
}  // namespace subdivd::oracle::testing

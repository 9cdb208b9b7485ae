// The comparison can fail for quads and polygons as it can for triangles: whatever is planted, in any
// quantity or in the connectivity, is found where it is.

#include <algorithm>
#include <ostream>
#include <set>
#include <string>

#include "core/oracle/compare.h"
#include "core/oracle/correspondence.h"
#include "tests/core/oracle/fixtures.h"
#include "tests/core/oracle/polygon_fixtures.h"

namespace subdivd::oracle::testing {
namespace {

constexpr double kPlanted = 1e-6;

bool identical(const Both<double>& both) {
  return match(connectivity_of(both.ours, patient()), both.far, patient()).identical;
}

struct Case {
  std::string name;
  ControlMesh mesh;
  Index level;
};

void PrintTo(const Case& item, std::ostream* out) { *out << item.name; }

class Polygons : public ::testing::TestWithParam<Case> {
 protected:
  Both<double> both() const { return both_of(GetParam().mesh, everything(GetParam().level)); }
  // Where the corners of our face f begin.
  static Count begin(const Both<double>& both, Count f) {
    return connectivity_of(both.ours, patient()).rows.begin(f);
  }
  static Count size(const Both<double>& both, Count f) {
    return connectivity_of(both.ours, patient()).rows.size(f);
  }
  static void swap_faces(Both<double>& both, Count f, Count g) {
    auto* faces = both.ours.faces.data();
    std::swap_ranges(faces + begin(both, f), faces + begin(both, f) + size(both, f), faces + begin(both, g));
  }
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const auto& [name, mesh] : {std::pair{std::string("quads"), rich_quads()},
                                   {std::string("polygons"), rich_polygons()},
                                   {std::string("bilinear"), bilinear(rich_polygons())}})
    for (const Index level : {0u, 1u, 2u}) all.push_back({name + "_" + std::to_string(level), mesh, level});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Rich, Polygons, ::testing::ValuesIn(cases()),
                         [](const auto& item) { return item.param.name; });

TEST_P(Polygons, have_nothing_to_find_where_nothing_is) {
  const LevelReport report = both().compared();
  EXPECT_TRUE(report.connectivity_identical);
  EXPECT_EQ(missed(report), "");
  EXPECT_EQ(find(report, "points").compared, report.vertices);
  EXPECT_GT(find(report, "limitPoints").compared, 0u);
  for (const char* name : {"constant", "uniform", "varying", "vertex", "st", "torn"})
    EXPECT_GT(find(report, std::string("primvars/") + name).compared, 0u) << name;
}

TEST_P(Polygons, pair_every_vertex_once_and_every_corner_with_the_same_vertex) {
  const auto sides = both();
  const Correspondence pairs = match(connectivity_of(sides.ours, patient()), sides.far, patient());
  const std::set<Index> ours(pairs.vertices.begin(), pairs.vertices.end());
  EXPECT_EQ(ours.size(), sides.ours.provenance.size());
  Count paired = 0;
  for (std::size_t c = 0; c < pairs.corners.size(); ++c) {
    if (pairs.corners[c] == kNoIndex) continue;
    ++paired;
    ASSERT_EQ(sides.ours.faces[pairs.corners[c]], pairs.vertices[sides.far.faces[c]]);
  }
  EXPECT_EQ(paired, sides.ours.faces.size());
}

TEST_P(Polygons, are_not_paired_by_position) {
  ControlMesh flat = GetParam().mesh;
  flat.points.assign(flat.points.size(), 1);
  EXPECT_TRUE(identical(both_of(flat, everything(GetParam().level))));
}

TEST_P(Polygons, name_the_vertex_and_the_place_of_a_planted_point) {
  auto sides = both();
  for (const Index victim : {Index{0}, static_cast<Index>(sides.ours.provenance.size() - 1)}) {
    auto planted = sides;
    planted.ours.points[3 * std::size_t{victim} + 1] += kPlanted;
    const LevelReport report = planted.compared();
    EXPECT_EQ(missed(report), "points");
    const Deviation& points = find(report, "points");
    const Provenance& place = planted.ours.provenance[victim];
    const double n = 1u << GetParam().level;
    EXPECT_EQ(points.worst_vertex, victim);
    EXPECT_EQ(points.worst_face, place.face);
    EXPECT_EQ(points.worst_corner, place.corner);
    EXPECT_EQ(points.worst_u, place.i / n);
    EXPECT_EQ(points.worst_v, place.j / n);
  }
}

TEST_P(Polygons, have_a_planted_limit_found) {
  auto sides = both();
  for (std::size_t k = 0; k < sides.ours.limit_points.size(); k += 3) sides.ours.limit_points[k] += kPlanted;
  EXPECT_EQ(missed(sides.compared()), "limitPoints");
}

TEST_P(Polygons, have_normals_on_the_wrong_side_found) {
  auto sides = both();
  if (find(sides.compared(), "normals").compared == 0) return;  // bilinear, at level 0
  for (double& x : sides.ours.normals) x = -x;
  EXPECT_NEAR(find(sides.compared(), "normals").max_absolute, 180, 1e-6);
}

TEST_P(Polygons, have_a_planted_value_found_in_every_kind_of_primvar) {
  const auto untouched = both();
  for (std::size_t p = 0; p < untouched.ours.primvars.size(); ++p) {
    auto sides = untouched;
    sides.ours.primvars[p].values[0] += kPlanted;
    EXPECT_EQ(missed(sides.compared()), "primvars/" + sides.mesh.primvars[p].name);
  }
}

TEST_P(Polygons, have_planted_limits_of_primvars_found) {
  const auto untouched = both();
  for (std::size_t p = 0; p < untouched.ours.primvars.size(); ++p) {
    if (untouched.far.primvars[p].limit_values.empty()) continue;
    auto sides = untouched;
    for (double& x : sides.ours.primvars[p].limit_values) x += 1e-3;
    EXPECT_EQ(missed(sides.compared()), "primvars/" + sides.mesh.primvars[p].name + "/limit");
  }
}

TEST_P(Polygons, name_the_corner_of_a_planted_face_varying_index) {
  auto sides = both();
  const Count last = sides.ours.base_faces.size() - 1, corner = begin(sides, last) + 2;
  RefinedPrimvar<double>& torn = sides.ours.primvars[5];
  torn.indices[corner] = torn.indices[0];
  const Deviation deviation = find(sides.compared(), "primvars/torn");
  EXPECT_EQ(deviation.verdict, Verdict::failed);
  EXPECT_EQ(deviation.worst_vertex, sides.ours.faces[corner]);
  EXPECT_EQ(deviation.worst_face, sides.ours.base_faces[last]);
}

TEST_P(Polygons, may_have_corners_that_start_elsewhere) {
  auto sides = both();
  auto* face = sides.ours.faces.data() + begin(sides, 1);
  std::rotate(face, face + 1, face + size(sides, 1));
  EXPECT_TRUE(identical(sides));
}

TEST_P(Polygons, have_two_swapped_corners_found) {
  auto sides = both();
  std::swap(sides.ours.faces[begin(sides, 1)], sides.ours.faces[begin(sides, 1) + 1]);
  EXPECT_FALSE(identical(sides));
}

TEST_P(Polygons, have_a_face_of_the_other_winding_found) {
  auto sides = both();
  auto* face = sides.ours.faces.data() + begin(sides, 1);
  std::reverse(face, face + size(sides, 1));
  EXPECT_FALSE(identical(sides));
}

// Of one base face and of two; at level 0 of two that have as many corners.
TEST_P(Polygons, have_two_swapped_faces_found) {
  const auto untouched = both();
  Count swapped = 0;
  for (const Count other : {Count{1}, untouched.ours.base_faces.size() - 1})
    if (size(untouched, 0) == size(untouched, other)) {
      auto sides = untouched;
      swap_faces(sides, 0, other);
      EXPECT_FALSE(identical(sides)) << other;
      ++swapped;
    }
  EXPECT_GT(swapped, 0u);
}

// Two vertices may lie in one place: the wrong one is found all the same.
TEST_P(Polygons, have_a_wrong_vertex_in_the_right_place_found) {
  ControlMesh flat = GetParam().mesh;
  flat.points.assign(flat.points.size(), 1);
  auto sides = both_of(flat, everything(GetParam().level));
  const auto other = static_cast<Index>(sides.ours.provenance.size() - 1);
  ASSERT_EQ(std::count(sides.ours.faces.begin(), sides.ours.faces.begin() + 4, other), 0);
  sides.ours.faces[0] = other;
  EXPECT_FALSE(identical(sides));
}

TEST_P(Polygons, have_a_missing_face_found) {
  auto sides = both();
  sides.ours.faces.resize(begin(sides, sides.ours.base_faces.size() - 1));
  sides.ours.base_faces.pop_back();
  if (!sides.ours.face_vertex_counts.empty()) sides.ours.face_vertex_counts.pop_back();
  EXPECT_FALSE(identical(sides));
}

TEST_P(Polygons, have_a_face_too_many_found) {
  auto sides = both();
  const Count size_of_last = size(sides, sides.ours.base_faces.size() - 1);
  for (Count k = 0; k < size_of_last; ++k) sides.ours.faces.push_back(static_cast<Index>(k));
  sides.ours.base_faces.push_back(sides.ours.base_faces.back());
  if (!sides.ours.face_vertex_counts.empty())
    sides.ours.face_vertex_counts.push_back(static_cast<Index>(size_of_last));
  EXPECT_FALSE(identical(sides));
}

TEST_P(Polygons, have_faces_of_other_sizes_found) {
  auto sides = both();
  if (sides.ours.face_vertex_counts.empty()) {
    sides.ours.face_size = 3;
  } else {
    ++sides.ours.face_vertex_counts[0];
    --sides.ours.face_vertex_counts[1];
  }
  EXPECT_FALSE(identical(sides));
}

TEST_P(Polygons, have_indices_that_end_early_found) {
  auto sides = both();
  sides.ours.faces.pop_back();
  EXPECT_FALSE(identical(sides));
}

TEST_P(Polygons, have_a_filled_hole_found) {
  auto sides = both();
  ControlMesh filled = GetParam().mesh;
  filled.hole_indices.clear();
  sides.ours = std::move(*refine<double>(filled, everything(GetParam().level), Budget{}));
  EXPECT_FALSE(identical(sides));
}

TEST_P(Polygons, have_a_wrong_base_face_found) {
  auto sides = both();
  ++sides.ours.base_faces[0];
  EXPECT_FALSE(identical(sides));
}

TEST_P(Polygons, have_a_wrong_provenance_found) {
  const auto untouched = both();
  const auto wrong = [&](auto&& change) {
    auto sides = untouched;
    change(sides.ours.provenance);
    EXPECT_FALSE(identical(sides));
  };
  wrong([](auto& places) { std::swap(places[0], places[1]); });
  wrong([](auto& places) { places[0].corner += 1; });
  wrong([](auto& places) { places[0].corner = kNoIndex; });
  wrong([](auto& places) { places[0].i += 1; });
  wrong([](auto& places) { places[0].j = kNoIndex; });
  wrong([](auto& places) { places[0].face = 1000; });
  wrong([](auto& places) { places.push_back({}); });
  wrong([](auto& places) { places.pop_back(); });
}

TEST_P(Polygons, have_another_level_found) {
  auto sides = both();
  sides.ours = std::move(*refine<double>(sides.mesh, everything(GetParam().level + 1), Budget{}));
  EXPECT_FALSE(identical(sides));
}

TEST(PolygonRules, are_told_apart) {
  ControlMesh mesh = rich_polygons();
  auto sides = both_of(mesh);
  mesh.triangle_subdivision_rule = TriangleRule::smooth;
  sides.ours = std::move(*refine<double>(mesh, everything(kLevel), Budget{}));
  EXPECT_NE(missed(sides.compared()).find("points"), std::string::npos);
  sides.ours = std::move(*refine<double>(bilinear(rich_polygons()), everything(kLevel), Budget{}));
  EXPECT_NE(missed(sides.compared()).find("points"), std::string::npos);
}

}  // namespace
}  // namespace subdivd::oracle::testing

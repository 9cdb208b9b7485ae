// The comparison can fail: a deviation planted in any quantity is found, where it is, and decides the
// verdict.

#include "core/oracle/compare.h"

#include <cmath>
#include <limits>

#include "tests/core/oracle/fixtures.h"

namespace subdivd::oracle::testing {
namespace {

constexpr double kPlanted = 1e-6;

TEST(Compare, finds_nothing_where_nothing_is) {
  const auto both = both_of(rich_mesh());
  const LevelReport report = both.compared();
  EXPECT_TRUE(report.connectivity_identical);
  EXPECT_EQ(missed(report), "");
  EXPECT_EQ(report.verdict(), Verdict::passed);
}

TEST(Compare, looks_at_every_quantity) {
  const LevelReport report = both_of(rich_mesh()).compared();
  std::string names;
  for (const Deviation& deviation : report.deviations) {
    names += deviation.quantity + " ";
    EXPECT_GT(deviation.compared, 0u) << deviation.quantity;
  }
  EXPECT_EQ(names,
            "points limitPoints normals primvars/constant primvars/uniform primvars/varying "
            "primvars/vertex primvars/vertex/limit primvars/st primvars/st/limit ");
}

TEST(Compare, agrees_in_single_precision) { EXPECT_EQ(missed(both_of<float>(rich_mesh()).compared()), ""); }

// Two sides that both looked at double-precision arithmetic would agree better than float can.
TEST(Compare, single_precision_differs_from_double_by_rounding) {
  const auto single = both_of<float>(rich_mesh());
  const auto twice = both_of<double>(rich_mesh());
  double largest = 0;
  for (std::size_t k = 0; k < twice.far.points.size(); ++k)
    largest = std::max(largest, std::abs(double{single.far.points[k]} - twice.far.points[k]));
  EXPECT_GT(largest, 1e-9);
  EXPECT_LT(largest, 1e-6);
}

TEST(Compare, names_the_vertex_and_the_place_of_a_planted_point) {
  auto both = both_of(rich_mesh());
  const Index victim = 31;
  both.ours.points[3 * victim + 1] += kPlanted;
  const LevelReport report = both.compared();
  const Deviation& points = find(report, "points");
  EXPECT_EQ(missed(report), "points");
  EXPECT_EQ(report.verdict(), Verdict::failed);
  EXPECT_EQ(points.worst_vertex, victim);
  EXPECT_EQ(points.worst_face, both.ours.provenance[victim].face);
  EXPECT_EQ(points.worst_u, both.ours.provenance[victim].i / 4.0);
  EXPECT_EQ(points.worst_v, both.ours.provenance[victim].j / 4.0);
  EXPECT_NEAR(points.max_absolute, kPlanted, 1e-12);
}

TEST(Compare, measures_by_the_diagonal_and_by_the_mean_square) {
  auto both = both_of(rich_mesh());
  both.ours.points[0] += kPlanted;
  const Deviation points = find(both.compared(), "points");
  const double diagonal = point_scale(both.mesh.points, 3, patient()).diagonal;
  EXPECT_NEAR(points.max_relative, kPlanted / diagonal, 1e-13);
  EXPECT_NEAR(points.rms_absolute, kPlanted / std::sqrt(double(points.compared)), 1e-12);
  EXPECT_EQ(points.tolerance, 1e-12);
}

TEST(Compare, finds_a_planted_limit_point) {
  auto both = both_of(rich_mesh());
  both.ours.limit_points[3 * 20] += kPlanted;
  EXPECT_EQ(missed(both.compared()), "limitPoints");
  EXPECT_EQ(find(both.compared(), "limitPoints").worst_vertex, 20u);
}

TEST(Compare, finds_a_turned_normal_and_measures_it_in_degrees) {
  auto both = both_of(rich_mesh());
  const Index tip = 0;  // smooth, valence 5
  double* normal = &both.ours.normals[3 * tip];
  const double turn = 0.02 * 3.14159265358979 / 180;
  // Turned towards any direction across it.
  const double across[3] = {normal[1], -normal[0], 0};
  const double size = std::hypot(across[0], across[1]);
  for (int k = 0; k < 3; ++k) normal[k] = normal[k] * std::cos(turn) + across[k] / size * std::sin(turn);
  const Deviation normals = find(both.compared(), "normals");
  EXPECT_EQ(normals.verdict, Verdict::failed);
  EXPECT_EQ(normals.worst_vertex, tip);
  EXPECT_NEAR(normals.max_absolute, 0.02, 1e-6);
}

TEST(Compare, finds_a_normal_on_the_wrong_side) {
  auto both = both_of(rich_mesh());
  for (int k = 0; k < 3; ++k) both.ours.normals[k] = -both.ours.normals[k];
  EXPECT_NEAR(find(both.compared(), "normals").max_absolute, 180, 1e-6);
}

TEST(Compare, finds_a_planted_value_in_every_kind_of_primvar) {
  const auto untouched = both_of(rich_mesh());
  for (std::size_t p = 0; p < untouched.ours.primvars.size(); ++p) {
    auto both = untouched;
    // The last value of a face-varying channel may be seen by corners of a hole only: take the first.
    both.ours.primvars[p].values[0] += kPlanted;
    EXPECT_EQ(missed(both.compared()), "primvars/" + both.mesh.primvars[p].name);
  }
}

TEST(Compare, finds_a_planted_value_in_the_limits_of_primvars) {
  const auto untouched = both_of(rich_mesh());
  for (const std::size_t p : {std::size_t{3}, std::size_t{4}}) {
    auto both = untouched;
    both.ours.primvars[p].limit_values[1] += 1e-3;
    EXPECT_EQ(missed(both.compared()), "primvars/" + both.mesh.primvars[p].name + "/limit");
  }
}

TEST(Compare, names_the_corner_of_a_planted_face_varying_index) {
  auto both = both_of(rich_mesh());
  RefinedPrimvar<double>& st = both.ours.primvars[4];
  const Index corner = 3 * 17 + 2;
  st.indices[corner] = st.indices[0];
  const Deviation deviation = find(both.compared(), "primvars/st");
  EXPECT_EQ(deviation.verdict, Verdict::failed);
  EXPECT_EQ(deviation.worst_vertex, both.ours.faces[corner]);
  EXPECT_EQ(deviation.worst_face, both.ours.base_faces[17]);
}

TEST(Compare, a_value_that_is_not_a_number_fails) {
  for (const double poison : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    auto both = both_of(rich_mesh());
    both.ours.points[3 * 7] = poison;
    both.ours.primvars[3].values[4 * 9 + 2] = poison;
    EXPECT_EQ(missed(both.compared()), "points primvars/vertex");
    EXPECT_EQ(find(both.compared(), "points").worst_vertex, 7u);
    EXPECT_EQ(find(both.compared(), "primvars/vertex").worst_vertex, 9u);
    EXPECT_EQ(find(both.compared(), "points").max_relative, std::numeric_limits<double>::max());
  }
}

TEST(Compare, arrays_of_the_wrong_length_fail_without_being_read) {
  auto both = both_of(rich_mesh());
  both.ours.points.pop_back();
  both.ours.limit_points.resize(6);
  both.ours.normals.resize(6);
  both.ours.primvars[1].values.clear();
  both.ours.primvars[4].indices.back() = 1000000;
  both.ours.primvars.pop_back();
  EXPECT_EQ(missed(both.compared()),
            "points limitPoints normals primvars/uniform primvars/st primvars/st/limit");
}

TEST(Compare, finds_an_index_past_its_values_without_reading_it) {
  auto both = both_of(rich_mesh());
  both.ours.primvars[4].indices[5] = 1000000;
  EXPECT_EQ(missed(both.compared()), "primvars/st primvars/st/limit");
}

TEST(Compare, finds_other_loop_weights_at_valence_5) {
  const ControlMesh mesh = shapes::icosahedron();
  auto both = both_of(mesh);
  RefineOptions warren = everything(kLevel);
  std::get<Loop>(warren.schemes).weights = LoopWeights::warren;
  both.ours = std::move(*refine<double>(mesh, warren, Budget{}));
  const LevelReport report = both.compared();
  EXPECT_EQ(missed(report), "points limitPoints normals");
  EXPECT_TRUE(report.connectivity_identical);
  EXPECT_GT(find(report, "points").max_relative, 1e-4);
}

// beta agrees at valence 6: what is found above is the weight, not the comparison itself.
TEST(Compare, cannot_tell_loop_weights_apart_at_valence_6) {
  const ControlMesh mesh = shapes::torus(4, 5);
  auto both = both_of(mesh);
  RefineOptions warren = everything(kLevel);
  std::get<Loop>(warren.schemes).weights = LoopWeights::warren;
  both.ours = std::move(*refine<double>(mesh, warren, Budget{}));
  EXPECT_EQ(missed(both.compared()), "");
}

TEST(Compare, counts_and_names_what_it_leaves_out) {
  const Deviation normals = find(both_of(rich_mesh()).compared(), "normals");
  EXPECT_EQ(normals.excepted, 20u);  // the crease's 5 edges at level 2
  EXPECT_NE(normals.exception.find("either side"), std::string::npos);
}

TEST(Compare, leaves_limits_out_while_semi_sharpness_lasts_and_takes_them_in_afterwards) {
  ControlMesh mesh = shapes::icosahedron();
  shapes::crease(mesh, {0, 1, 2}, 2.5f);
  const Deviation before = find(both_of(mesh, everything(2)).compared(), "limitPoints");
  EXPECT_EQ(before.excepted, 9u);
  EXPECT_NE(before.exception.find("sharpness"), std::string::npos);
  EXPECT_EQ(find(both_of(mesh, everything(3)).compared(), "limitPoints").excepted, 0u);
}

TEST(Compare, allows_for_rounding_far_from_the_origin) {
  ControlMesh mesh = shapes::icosahedron();
  for (double& x : mesh.points) x += 1000;
  const LevelReport report = both_of<float>(mesh).compared();
  EXPECT_EQ(missed(report), "");
  EXPECT_GT(find(report, "points").tolerance, 1e-4);
}

TEST(Compare, measures_a_mesh_of_one_place_by_its_magnitude) {
  const PointScale scale = point_scale(std::vector<double>{3, 4, 5, 3, 4, 5}, 3, patient());
  EXPECT_EQ(scale.diagonal, 5);
  EXPECT_EQ(scale.remoteness, 1);
}

// An infinite diagonal would make every deviation 0.
TEST(Compare, a_diagonal_past_the_range_stays_finite) {
  const PointScale scale = point_scale(std::vector<double>{-1e308, 0, 0, 1e308, 0, 0}, 3, patient());
  EXPECT_EQ(scale.diagonal, std::numeric_limits<double>::max());
}

}  // namespace
}  // namespace subdivd::oracle::testing

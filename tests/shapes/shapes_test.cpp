// The shapes are what they claim to be: accepted by check(), and together they exercise what the differential
// tests are meant to see.
#include "tests/shapes/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/shapes/build.h"
#include "tests/shapes/polygons.h"

namespace subdivd::shapes {
namespace {

const std::vector<NamedShape>& shapes() {
  static const std::vector<NamedShape> kShapes = all_shapes();
  return kShapes;
}

std::string fault_of(const ControlMesh& mesh) {
  const Result<void> result = mesh.check();
  if (result.ok()) return "";
  std::string where;
  for (const PathStep& step : result.error().where)
    where += "/" + (step.index() == 0 ? std::get<0>(step) : std::to_string(std::get<1>(step)));
  return result.error().message + " at " + where;
}

std::map<Edge, int> faces_per_edge(const ControlMesh& mesh) {
  std::map<Edge, int> faces;
  const auto& v = mesh.face_vertex_indices;
  for (std::size_t c = 0; c < v.size(); ++c) ++faces[std::minmax(v[c], v[c - c % 3 + (c + 1) % 3])];
  return faces;
}

// Edges at every referenced point.
std::map<Index, Index> valences(const ControlMesh& mesh) {
  std::map<Index, Index> edges;
  for (const auto& [a, b] : edges_of(mesh)) ++edges[a], ++edges[b];
  return edges;
}

std::set<Index> border_points(const ControlMesh& mesh) {
  std::set<Index> points;
  for (const auto& [edge, faces] : faces_per_edge(mesh))
    if (faces == 1) points.insert({edge.first, edge.second});
  return points;
}

// Numbers of values that a face-varying channel has at one point, over all shapes and points.
std::set<std::size_t> values_per_point() {
  std::set<std::size_t> counts;
  for (const auto& [name, mesh] : shapes())
    for (const Primvar& primvar : mesh.primvars) {
      if (primvar.interpolation != Interpolation::face_varying || primvar.indices.empty()) continue;
      std::map<Index, std::set<Index>> values;
      for (std::size_t c = 0; c < primvar.indices.size(); ++c)
        values[mesh.face_vertex_indices[c]].insert(primvar.indices[c]);
      for (const auto& [point, of_point] : values) counts.insert(of_point.size());
    }
  return counts;
}

TEST(Shapes, every_shape_passes_check) {
  for (const auto& [name, mesh] : shapes()) EXPECT_EQ(fault_of(mesh), "") << name;
}

TEST(Shapes, there_are_at_least_45) { EXPECT_GE(shapes().size(), 45u); }

TEST(Shapes, names_are_unique_words_and_the_mesh_has_the_same) {
  std::set<std::string> seen;
  for (const auto& [name, mesh] : shapes()) {
    EXPECT_TRUE(seen.insert(name).second) << name;
    EXPECT_THAT(name, testing::MatchesRegex("[a-z][a-z0-9_]*"));
    EXPECT_EQ(mesh.name, name);
  }
}

TEST(Shapes, closed_points_have_every_valence_asked_for) {
  std::set<Index> seen;
  for (const auto& [name, mesh] : shapes()) {
    const std::set<Index> border = border_points(mesh);
    for (const auto& [point, valence] : valences(mesh))
      if (!border.contains(point)) seen.insert(valence);
  }
  EXPECT_THAT(std::vector(seen.begin(), seen.end()),
              testing::IsSupersetOf({3u, 4u, 5u, 6u, 7u, 8u, 9u, 10u, 11u, 12u, 100u}));
}

TEST(Shapes, border_points_have_every_valence_asked_for) {
  std::set<Index> seen;
  for (const auto& [name, mesh] : shapes()) {
    const std::map<Index, Index> valence = valences(mesh);
    for (const Index point : border_points(mesh)) seen.insert(valence.at(point));
  }
  EXPECT_THAT(std::vector(seen.begin(), seen.end()), testing::IsSupersetOf({2u, 3u, 4u, 5u}));
}

TEST(Shapes, edges_have_one_to_four_faces) {
  std::set<int> seen;
  for (const auto& [name, mesh] : shapes())
    for (const auto& [edge, faces] : faces_per_edge(mesh)) seen.insert(faces);
  EXPECT_THAT(seen, testing::IsSupersetOf({1, 2, 3, 4}));
}

TEST(Shapes, creases_have_every_sharpness_asked_for) {
  std::set<float> seen;
  for (const auto& [name, mesh] : shapes())
    seen.insert(mesh.crease_sharpnesses.begin(), mesh.crease_sharpnesses.end());
  EXPECT_THAT(seen, testing::IsSupersetOf({0.0f, 0.5f, 1.0f, 2.3f, 10.0f, 1e38f}));
}

TEST(Shapes, corners_have_every_sharpness_asked_for) {
  std::set<float> seen;
  for (const auto& [name, mesh] : shapes())
    seen.insert(mesh.corner_sharpnesses.begin(), mesh.corner_sharpnesses.end());
  EXPECT_THAT(seen, testing::IsSupersetOf({0.7f, 2.5f, 10.0f}));
}

TEST(Shapes, every_boundary_mode_occurs_with_a_border) {
  std::set<BoundaryInterpolation> seen;
  for (const auto& [name, mesh] : shapes())
    if (!border_points(mesh).empty()) seen.insert(mesh.interpolate_boundary);
  EXPECT_EQ(seen.size(), 3u);
}

TEST(Shapes, every_face_varying_mode_occurs) {
  std::set<FaceVaryingInterpolation> seen;
  for (const auto& [name, mesh] : shapes())
    if (!mesh.primvars.empty()) seen.insert(mesh.face_varying_linear_interpolation);
  EXPECT_EQ(seen.size(), 6u);
}

TEST(Shapes, channels_have_one_two_and_three_values_at_a_point) {
  EXPECT_THAT(values_per_point(), testing::IsSupersetOf({1u, 2u, 3u}));
}

TEST(Shapes, primvars_have_every_interpolation_and_width_asked_for) {
  std::set<std::pair<Interpolation, Index>> seen;
  for (const auto& [name, mesh] : shapes())
    for (const Primvar& primvar : mesh.primvars) seen.insert({primvar.interpolation, primvar.element_size});
  using enum Interpolation;
  for (const Interpolation interpolation : {constant, uniform, varying, vertex, face_varying})
    for (const Index size : {1u, 2u, 5u, 17u})
      EXPECT_TRUE(seen.contains({interpolation, size})) << static_cast<int>(interpolation) << " " << size;
}

TEST(Shapes, cages_of_builders_are_consistently_wound) {
  // Every directed edge of a closed, oriented mesh occurs once.
  for (const ControlMesh& mesh : {tetrahedron(), octahedron(), icosahedron(), cube(), torus(4, 5),
                                  double_pyramid(7), big_torus(7, 9, 1)}) {
    std::set<Edge> directed;
    const auto& v = mesh.face_vertex_indices;
    for (std::size_t c = 0; c < v.size(); ++c)
      EXPECT_TRUE(directed.insert({v[c], v[c - c % 3 + (c + 1) % 3]}).second);
    for (const auto& [a, b] : directed) EXPECT_TRUE(directed.contains({b, a}));
  }
}

TEST(Seams, a_closed_surface_without_seams_has_one_value_per_point) {
  const ControlMesh mesh = icosahedron();
  EXPECT_EQ(seamed(mesh, "st", 2, {}).values.size(), 2 * mesh.point_count());
}

TEST(Seams, a_seam_that_ends_inside_splits_all_but_its_ends) {
  const ControlMesh mesh = torus(5, 6);
  EXPECT_EQ(seamed(mesh, "st", 1, edges_along({7, 8, 9, 10})).values.size(), mesh.point_count() + 2);
}

TEST(Seams, cutting_every_edge_leaves_one_value_per_corner) {
  const ControlMesh mesh = icosahedron();
  EXPECT_EQ(seamed(mesh, "st", 1, edges_of(mesh)).values.size(), 60u);
}

constexpr std::uint64_t kSeeds = 1000;
constexpr std::uint64_t kHashOf42 = 15824330876504829673u;

TEST(RandomMesh, passes_check_for_every_seed) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed)
    ASSERT_EQ(fault_of(random_mesh(seed)), "") << "seed " << seed;
}

TEST(RandomMesh, has_at_most_a_few_hundred_faces) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const ControlMesh mesh = random_mesh(seed);
    ASSERT_GE(mesh.face_count(), 1u) << "seed " << seed;
    ASSERT_LE(mesh.face_count(), 250u) << "seed " << seed;
  }
}

TEST(RandomMesh, is_the_same_for_the_same_seed_on_every_machine) {
  const ControlMesh mesh = random_mesh(42);
  std::uint64_t hash =
      14695981039346656037u;  // FNV-1a over what has no rounding of a mathematical library in it
  for (const auto* numbers : {&mesh.face_vertex_indices, &mesh.crease_indices, &mesh.corner_indices,
                              &mesh.hole_indices, &mesh.primvars.at(0).indices})
    for (const Index number : *numbers) hash = (hash ^ number) * 1099511628211u;
  EXPECT_EQ(hash, kHashOf42);
}

TEST(RandomMesh, seeds_together_show_borders_fins_and_every_mode) {
  std::set<int> faces_at_edge, boundary, face_varying;
  std::set<Index> valence;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const ControlMesh mesh = random_mesh(seed);
    for (const auto& [edge, faces] : faces_per_edge(mesh)) faces_at_edge.insert(faces);
    for (const auto& [point, n] : valences(mesh)) valence.insert(n);
    boundary.insert(static_cast<int>(mesh.interpolate_boundary));
    face_varying.insert(static_cast<int>(mesh.face_varying_linear_interpolation));
  }
  EXPECT_THAT(faces_at_edge, testing::IsSupersetOf({1, 2, 3}));
  EXPECT_THAT(std::vector(valence.begin(), valence.end()),
              testing::IsSupersetOf({2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u}));
  EXPECT_EQ(boundary.size(), 3u);
  EXPECT_EQ(face_varying.size(), 6u);
}

TEST(BigTorus, has_two_triangles_per_quad_and_mixed_valences) {
  const ControlMesh mesh = big_torus(20, 30, 7);
  EXPECT_EQ(mesh.face_count(), 1200u);
  std::set<Index> seen;
  for (const auto& [point, valence] : valences(mesh)) seen.insert(valence);
  EXPECT_THAT(std::vector(seen.begin(), seen.end()), testing::IsSupersetOf({5u, 6u, 7u}));
}

// ControlMesh::check() takes triangles alone: what it would see of their arrays.
TEST(PolygonShapes, have_arrays_that_fit_together) {
  for (const auto& [name, mesh] : polygon_shapes()) {
    SCOPED_TRACE(name);
    Count corners = 0, edges = 0, points = 0;
    for (const Index count : mesh.face_vertex_counts) corners += count;
    if (!mesh.face_vertex_counts.empty()) {
      EXPECT_EQ(corners, mesh.face_vertex_indices.size());
    }
    for (const Index index : mesh.face_vertex_indices) EXPECT_LT(index, mesh.point_count());
    for (const Index length : mesh.crease_lengths) {
      points += length;
      edges += length - 1;
    }
    EXPECT_EQ(points, mesh.crease_indices.size());
    EXPECT_TRUE(mesh.crease_sharpnesses.size() == edges ||
                mesh.crease_sharpnesses.size() == mesh.crease_lengths.size());
    EXPECT_EQ(mesh.corner_indices.size(), mesh.corner_sharpnesses.size());
  }
}

}  // namespace
}  // namespace subdivd::shapes

// Random meshes with random creases, corners, holes, boundary modes and channels. The seed is fixed; a
// failure prints the one of its mesh, and `shapes::random_mesh(seed)` makes it again on any machine.

#include <gtest/gtest.h>

#include "tests/differential/agreement.h"
#include "tests/shapes/polygons.h"
#include "tests/shapes/shapes.h"

namespace subdivd::differential {
namespace {

constexpr std::uint64_t kFirstSeed = 20240607;
constexpr std::uint64_t kMeshes = kSanitized ? 60 : 500;
constexpr Index kLevels = kSanitized ? 2 : 3;

template <class Real>
void expect_agreement(std::uint64_t step) {
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kMeshes; seed += step) {
    const ControlMesh mesh = shapes::random_mesh(seed);
    const CreaseMethod method = seed % 2 == 0 ? CreaseMethod::uniform : CreaseMethod::chaikin;
    EXPECT_EQ(agreement<Real>(mesh, method, kLevels).disagreements, "")
        << "seed " << seed << (method == CreaseMethod::chaikin ? ", chaikin" : ", uniform");
  }
}

TEST(RandomMeshes, agree_with_far_in_double_precision) { expect_agreement<double>(1); }

TEST(RandomMeshes, agree_with_far_in_single_precision) { expect_agreement<float>(3); }

// Their triangles joined to faces of up to nine corners, with values of every interpolation.
template <class Real>
void expect_agreement_of_polygons(std::uint64_t step, const std::string& scheme) {
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kMeshes; seed += step) {
    const auto most = static_cast<Index>(4 + seed % 6), islands = static_cast<Index>(1 + seed % 4);
    ControlMesh mesh =
        shapes::with_values(shapes::with_joined_faces(shapes::random_mesh(seed), most, seed), islands, seed);
    mesh.subdivision_scheme = scheme;
    mesh.triangle_subdivision_rule = seed % 3 == 0 ? TriangleRule::smooth : TriangleRule::catmull_clark;
    const CreaseMethod method = seed % 2 == 0 ? CreaseMethod::uniform : CreaseMethod::chaikin;
    for (const Index level : {Index{0}, kLevels})
      EXPECT_EQ(agreement<Real>(mesh, method, level).disagreements, "")
          << scheme << ", seed " << seed << (method == CreaseMethod::chaikin ? ", chaikin" : ", uniform");
  }
}

TEST(RandomPolygons, agree_with_far_in_double_precision) {
  expect_agreement_of_polygons<double>(1, "catmullClark");
}

TEST(RandomPolygons, agree_with_far_in_single_precision) {
  expect_agreement_of_polygons<float>(3, "catmullClark");
}

TEST(RandomPolygons, agree_with_far_under_bilinear_subdivision) {
  expect_agreement_of_polygons<double>(5, "bilinear");
}

}  // namespace
}  // namespace subdivd::differential

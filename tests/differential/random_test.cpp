// Random meshes with random creases, corners, holes, boundary modes and channels. The seed is fixed; a
// failure prints the one of its mesh, and `shapes::random_mesh(seed)` makes it again on any machine.

#include <gtest/gtest.h>

#include "tests/differential/agreement.h"
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

}  // namespace
}  // namespace subdivd::differential

// How often Far refines: a call that nobody can stop, and the dearest of a verification.

#include <cstdint>

#include "core/oracle/verify.h"
#include "tests/core/oracle/fixtures.h"

namespace {
int refinements = 0;
}

// TopologyRefiner::RefineUniform(UniformOptions), which is one word of bits; the linker brings its calls here.
extern "C" {
void __real__ZN10OpenSubdiv6v3_5_03Far15TopologyRefiner13RefineUniformENS2_14UniformOptionsE(
    void* refiner, std::uint32_t options);
void __wrap__ZN10OpenSubdiv6v3_5_03Far15TopologyRefiner13RefineUniformENS2_14UniformOptionsE(
    void* refiner, std::uint32_t options) {
  ++refinements;
  __real__ZN10OpenSubdiv6v3_5_03Far15TopologyRefiner13RefineUniformENS2_14UniformOptionsE(refiner, options);
}
}

namespace subdivd::oracle::testing {
namespace {

int refinements_of(const RefineOptions& options) {
  const int before = refinements;
  const auto report = verify<double>(rich_mesh(), options, Budget{});
  EXPECT_EQ(report.ok() ? report->levels.size() : 0, std::max<Index>(1, options.level));
  return refinements - before;
}

RefineOptions values_alone(Index level) {
  RefineOptions options;
  options.level = level;
  return options;
}

TEST(FarRefinements, one_serves_all_levels_without_limits) {
  for (const Index level : {0u, 1u, 2u, 4u}) EXPECT_EQ(refinements_of(values_alone(level)), 1) << level;
}

// Far's limits are those of its last level.
TEST(FarRefinements, limits_and_normals_take_one_for_each_level) {
  for (const Index level : {1u, 3u}) {
    EXPECT_EQ(refinements_of(everything(level)), int(level));
    RefineOptions options = values_alone(level);
    options.limit = true;
    EXPECT_EQ(refinements_of(options), int(level)) << "limits";
    options.limit = false;
    options.normals = true;
    EXPECT_EQ(refinements_of(options), int(level)) << "normals";
  }
}

FarMesh far_mesh(const ControlMesh& mesh, Index deepest) {
  auto built = FarMesh::build(mesh, CreaseMethod::uniform, deepest, Budget{});
  EXPECT_TRUE(built.ok());
  return std::move(*built);
}

// Every bit of a level is what it is when Far refines no further.
TEST(FarRefinements, a_level_is_the_same_below_others) {
  ControlMesh mesh = rich_mesh();
  shapes::crease(mesh, {0, 2}, 1.5f);
  for (Index level = 0; level <= 3; ++level) {
    FarMesh deep = far_mesh(mesh, 3), shallow = far_mesh(mesh, level);
    const auto a = deep.refine<double>(values_alone(level), Budget{});
    const auto b = shallow.refine<double>(values_alone(level), Budget{});
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_EQ(a->points, b->points);
    EXPECT_EQ(a->faces, b->faces);
    EXPECT_EQ(a->base_faces, b->base_faces);
    ASSERT_EQ(a->vertices.size(), b->vertices.size());
    for (std::size_t v = 0; v < a->vertices.size(); ++v) {
      const Provenance &at = a->vertices[v].place, &there = b->vertices[v].place;
      EXPECT_TRUE(at.face == there.face && at.i == there.i && at.j == there.j) << v;
      EXPECT_EQ(a->vertices[v].rule, b->vertices[v].rule);
      EXPECT_EQ(a->vertices[v].semi_sharp, b->vertices[v].semi_sharp);
      EXPECT_EQ(a->vertices[v].boundary, b->vertices[v].boundary);
    }
    for (std::size_t p = 0; p < a->primvars.size(); ++p) {
      EXPECT_EQ(a->primvars[p].values, b->primvars[p].values);
      EXPECT_EQ(a->primvars[p].indices, b->primvars[p].indices);
    }
  }
}

TEST(FarRefinements, levels_may_be_taken_in_any_order_with_limits_and_without) {
  const ControlMesh mesh = rich_mesh();
  FarMesh far = far_mesh(mesh, 3);
  for (const Index level : {2u, 3u, 1u, 0u, 3u, 2u})
    for (const bool limits : {true, false}) {
      const RefineOptions options = limits ? everything(level) : values_alone(level);
      const auto taken = far.refine<double>(options, Budget{});
      const auto fresh = far_refine<double>(mesh, options, Budget{});
      ASSERT_TRUE(taken.ok() && fresh.ok());
      EXPECT_EQ(taken->points, fresh->points) << level;
      EXPECT_EQ(taken->limit_points, fresh->limit_points) << level;
      EXPECT_EQ(taken->tangents_u, fresh->tangents_u) << level;
    }
}

}  // namespace
}  // namespace subdivd::oracle::testing

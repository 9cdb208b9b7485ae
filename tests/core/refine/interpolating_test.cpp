// Schemes that go through the control points, refined from end to end: what they share with the schemes on grids over
// the same faces, and what they refuse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "core/engine/plain/line_rows.h"
#include "core/engine/plain/ring_rows.h"
#include "core/refine/refine.h"
#include "tests/core/engine/levels.h"
#include "tests/shapes/build.h"
#include "tests/shapes/polygons.h"
#include "tests/shapes/random.h"
#include "tests/shapes/shapes.h"

namespace subdivd {
namespace {

using ::testing::HasSubstr;

// With values of every kind, of which some corners at a point differ.
ControlMesh with_values(ControlMesh mesh, std::uint64_t seed) {
  shapes::Random random(seed);
  mesh.primvars.clear();
  const auto numbers = [&](Count count) {
    std::vector<double> values(count);
    for (double& x : values) x = random.centred();
    return values;
  };
  mesh.primvars.push_back({"linear", Interpolation::varying, 2, numbers(2 * mesh.point_count()), {}});
  mesh.primvars.push_back({"smooth", Interpolation::vertex, 1, numbers(mesh.point_count()), {}});
  mesh.primvars.push_back({"face", Interpolation::uniform, 1, numbers(mesh.face_count()), {}});
  Primvar seams{"seams", Interpolation::face_varying, 2, {}, {}};
  const Count corners = mesh.face_vertex_indices.size();
  for (Count c = 0; c < corners; ++c)
    seams.indices.push_back(mesh.face_vertex_indices[c] +
                            (random.below(8) == 0 ? static_cast<Index>(mesh.point_count()) : 0));
  seams.values = numbers(4 * mesh.point_count());
  mesh.primvars.push_back(std::move(seams));
  return mesh;
}

struct Case {
  std::string name;
  ControlMesh mesh;
  const char* on_grids;  // a scheme with the same split, and linear interpolation
};

std::vector<Case> cases() {
  std::vector<Case> result;
  const auto add = [&](const std::string& name, ControlMesh mesh, const char* scheme, const char* on_grids) {
    mesh.subdivision_scheme = scheme;
    if (mesh.face_vertex_indices.size() > 800 || !scheme_of(mesh, {}, {})) return;
    result.push_back({name + ' ' + scheme, with_values(std::move(mesh), result.size() + 1), on_grids});
  };
  for (const auto& [name, mesh] : shapes::all_shapes()) add(name, mesh, "butterfly", "loop");
  for (const auto& [name, mesh] : shapes::polygon_shapes()) add(name, mesh, "kobbelt", "catmullClark");
  return result;
}

RefineOptions everything(Index level) {
  return {.level = level, .limit = true, .tangents = true, .normals = true, .provenance = true};
}

RefinedMesh<double> refined(const ControlMesh& mesh, const RefineOptions& options) {
  auto result = refine<double>(mesh, options, {});
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return std::move(*result);
}

TEST(InterpolatingSchemes, have_meshes_to_be_tried_on) {
  const auto all = cases();
  const auto of = [&](const char* scheme) {
    return std::ranges::count_if(all, [&](const Case& one) { return one.mesh.subdivision_scheme == scheme; });
  };
  EXPECT_GE(of("butterfly"), 25);
  EXPECT_GE(of("kobbelt"), 12);
}

// Everything but values is that of the scheme on grids: numbers, faces, places, holes, seams.
TEST(InterpolatingSchemes, number_as_the_schemes_on_grids_do) {
  for (const Case& one : cases())
    for (const Index level : {0, 1, 3}) {
      SCOPED_TRACE(one.name + " level " + std::to_string(level));
      ControlMesh other = one.mesh;
      other.subdivision_scheme = one.on_grids;
      const auto ours = refined(one.mesh, everything(level)), grids = refined(other, everything(level));
      EXPECT_EQ(ours.scheme, one.mesh.subdivision_scheme);
      ASSERT_EQ(ours.points.size(), grids.points.size());
      EXPECT_EQ(ours.faces, grids.faces);
      EXPECT_EQ(ours.face_size, grids.face_size);
      EXPECT_EQ(ours.base_faces, grids.base_faces);
      EXPECT_EQ(ours.provenance, grids.provenance);
      EXPECT_EQ(ours.primvars[2].values, grids.primvars[2].values);
      EXPECT_EQ(ours.primvars[3].indices, grids.primvars[3].indices);
      ASSERT_EQ(ours.primvars[3].values.size(), grids.primvars[3].values.size());
      for (std::size_t k = 0; k < ours.primvars[0].values.size(); ++k)
        ASSERT_NEAR(ours.primvars[0].values[k], grids.primvars[0].values[k], 1e-15) << k;
    }
}

TEST(InterpolatingSchemes, are_linear_where_a_channel_is) {
  for (Case one : cases()) {
    one.mesh.face_varying_linear_interpolation = FaceVaryingInterpolation::all;
    ControlMesh other = one.mesh;
    other.subdivision_scheme = one.on_grids;
    const auto ours = refined(one.mesh, everything(2)), grids = refined(other, everything(2));
    for (std::size_t k = 0; k < ours.primvars[3].values.size(); ++k)
      ASSERT_NEAR(ours.primvars[3].values[k], grids.primvars[3].values[k], 1e-15) << one.name << ' ' << k;
  }
}

TEST(InterpolatingSchemes, keep_all_points_at_every_level) {
  for (const Case& one : cases()) {
    const auto before = refined(one.mesh, everything(1)), after = refined(one.mesh, everything(3));
    EXPECT_EQ(before.points, before.limit_points) << one.name;
    for (std::size_t k = 0; k < one.mesh.points.size(); ++k) {
      ASSERT_EQ(before.points[k], one.mesh.points[k]) << one.name;
      ASSERT_EQ(after.points[k], one.mesh.points[k]) << one.name;
    }
    // Those of level 1 have other numbers at level 3, and the same places.
    for (std::size_t v = one.mesh.point_count(); v < before.provenance.size(); ++v) {
      Provenance place = before.provenance[v];
      place.i *= 4;
      place.j *= 4;
      const auto at = std::ranges::find(after.provenance, place);
      ASSERT_NE(at, after.provenance.end()) << one.name;
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_EQ(after.points[3 * static_cast<std::size_t>(at - after.provenance.begin()) + c],
                  before.points[3 * v + c])
            << one.name;
    }
  }
}

// One step has plain's own numbers.
TEST(InterpolatingSchemes, make_the_points_of_their_rows) {
  for (const Case& one : cases()) {
    const plain::Level level = plain::base_level(one.mesh);
    const plain::StepRows rows = one.mesh.subdivision_scheme == "kobbelt"
                                     ? plain::step_rows(Kobbelt{}, level, false)
                                     : plain::step_rows(Butterfly{}, level, false);
    const auto expected = plain::apply<double>(rows, std::span<const double>(one.mesh.points), 3);
    const auto ours = refined(one.mesh, everything(1));
    // Edges may have other numbers: by the faces' corners.
    ASSERT_EQ(ours.points.size(), expected.size()) << one.name;
    std::vector<std::vector<double>> a, b;
    for (std::size_t v = 0; v < expected.size(); v += 3) {
      a.emplace_back(expected.begin() + static_cast<std::ptrdiff_t>(v),
                     expected.begin() + static_cast<std::ptrdiff_t>(v + 3));
      b.emplace_back(ours.points.begin() + static_cast<std::ptrdiff_t>(v),
                     ours.points.begin() + static_cast<std::ptrdiff_t>(v + 3));
    }
    std::ranges::sort(a);
    std::ranges::sort(b);
    for (std::size_t v = 0; v < a.size(); ++v)
      for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(a[v][c], b[v][c], 1e-13) << one.name;
  }
}

TEST(InterpolatingSchemes, have_unit_normals_wherever_there_are_faces) {
  for (const Case& one : cases()) {
    if (one.name.find("pillow") != std::string::npos) continue;  // out is on both sides
    const auto mesh = refined(one.mesh, everything(2));
    for (std::size_t v = 0; v < mesh.provenance.size(); ++v) {
      const double* const n = &mesh.normals[3 * v];
      const double length = std::hypot(n[0], n[1], n[2]);
      if (mesh.provenance[v].face == kNoIndex)
        ASSERT_EQ(length, 0) << one.name << ' ' << v;
      else
        ASSERT_NEAR(length, 1, 1e-12) << one.name << ' ' << v;
      const double *const u = &mesh.tangents_u[3 * v], *const w = &mesh.tangents_v[3 * v];
      ASSERT_NEAR(u[0] * n[0] + u[1] * n[1] + u[2] * n[2], 0, 1e-10) << one.name;
      ASSERT_GE((u[1] * w[2] - u[2] * w[1]) * n[0] + (u[2] * w[0] - u[0] * w[2]) * n[1] +
                    (u[0] * w[1] - u[1] * w[0]) * n[2],
                0)
          << one.name << ' ' << v;
    }
  }
}

// What a plan was not made for comes from the faces.
TEST(InterpolatingSchemes, answer_without_frames_in_the_plan) {
  ControlMesh mesh = shapes::icosahedron();
  mesh.subdivision_scheme = "butterfly";
  const auto plan = Plan::build(mesh, {.max_level = 2, .frames = false}, {});
  ASSERT_TRUE(plan.ok());
  const auto by_faces = refine<double>(mesh, *plan, everything(2), {}),
             by_masks = refine<double>(mesh, everything(2), {});
  ASSERT_TRUE(by_faces.ok() && by_masks.ok());
  EXPECT_EQ(by_faces->points, by_masks->points);
  for (std::size_t v = 0; v < by_faces->normals.size(); v += 3) {
    double dot = 0;
    for (std::size_t c = 0; c < 3; ++c) dot += by_faces->normals[v + c] * by_masks->normals[v + c];
    EXPECT_GT(dot, 0.99);
  }
}

TEST(InterpolatingSchemes, refuse_sharpness_that_runs_out_and_other_faces) {
  ControlMesh mesh = shapes::icosahedron();
  mesh.subdivision_scheme = "butterfly";
  mesh.crease_indices = {mesh.face_vertex_indices[0], mesh.face_vertex_indices[1]};
  mesh.crease_lengths = {2};
  mesh.crease_sharpnesses = {2};
  auto refusal = refine<double>(mesh, {.level = 1}, {});
  ASSERT_FALSE(refusal.ok());
  EXPECT_EQ(refusal.error().code, ErrorCode::unsupported);
  EXPECT_EQ(refusal.error().where, (Path{"creaseSharpnesses", std::uint64_t{0}}));
  mesh.crease_sharpnesses = {kInfiniteSharpness};
  EXPECT_TRUE(refine<double>(mesh, {.level = 1}, {}).ok());

  mesh.subdivision_scheme = "kobbelt";
  refusal = refine<double>(mesh, {.level = 1}, {});
  ASSERT_FALSE(refusal.ok());
  EXPECT_EQ(refusal.error().where, Path{"subdivisionScheme"});
  EXPECT_THAT(refusal.error().message,
              HasSubstr("takes faces of 4 vertices, and face 0 has 3: take \"loop\" or \"catmullClark\" or"));
  EXPECT_THAT(refusal.error().message, ::testing::Not(HasSubstr("triangulate")));
}

// Work of seconds, each step of it.
TEST(InterpolatingSchemes, can_be_stopped) {
  ControlMesh mesh = shapes::icosahedron();
  mesh.subdivision_scheme = "butterfly";
  Budget budget;
  budget.deadline = Budget::Clock::now() + std::chrono::milliseconds(20);
  const auto stopped = refine<double>(mesh, everything(8), budget);
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().code, ErrorCode::deadline_exceeded);
}

}  // namespace
}  // namespace subdivd

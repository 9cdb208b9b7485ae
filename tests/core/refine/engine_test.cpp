// The engine against the plain one: every named shape, random meshes with everything on them, threads and
// instruction sets.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "core/engine/grid/kernels/instruction_sets.h"
#include "core/engine/tri_grid/kernels/tri_step.h"
#include "core/refine/plan.h"
#include "core/refine/refinable.h"
#include "core/schemes/all.h"
#include "tests/reference/plain_refine.h"
#include "tests/shapes/build.h"
#include "tests/shapes/shapes.h"

namespace subdivd {
namespace {

template <class Real>
double extent_of(std::span<const Real> values) {
  double extent = 0;
  for (const Real x : values) extent = std::max(extent, std::abs(static_cast<double>(x)));
  return extent;
}

// Largest difference in units of the last place of the extent.
template <class Real>
double ulps(std::span<const Real> a, std::span<const Real> b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double worst = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    worst = std::max(worst, std::abs(static_cast<double>(a[k]) - static_cast<double>(b[k])));
  const double unit = extent_of(b) * static_cast<double>(std::numeric_limits<Real>::epsilon());
  return unit == 0 ? (worst == 0 ? 0 : std::numeric_limits<double>::infinity()) : worst / unit;
}

// Values are sums of products in another order at each of the levels; limits add one more.
constexpr double kUlps = 4;

// Sine of the angle between a vertex's two tangents.
double sine(const RefinedMesh<double>& mesh, std::size_t k) {
  const double *u = &mesh.tangents_u[k], *v = &mesh.tangents_v[k];
  const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
  const double size = std::hypot(u[0], u[1], u[2]) * std::hypot(v[0], v[1], v[2]);
  return size == 0 ? 0 : std::hypot(x, y, z) / size;
}

// Where tangents are nearly parallel (a pillow without filling) the normal's direction is a matter of
// rounding, and more so the less they differ.
void expect_normals(const RefinedMesh<double>& ours, const RefinedMesh<double>& plain,
                    const std::string& what) {
  ASSERT_EQ(ours.normals.size(), plain.normals.size()) << what;
  for (std::size_t k = 0; k < ours.normals.size(); k += 3) {
    const double clear = std::min(sine(ours, k), sine(plain, k));
    if (clear < 1e-6) continue;
    double distance = 0;
    for (std::size_t c = 0; c < 3; ++c) distance += std::abs(ours.normals[k + c] - plain.normals[k + c]);
    ASSERT_LT(distance, 1e-12 / clear) << what << ", vertex " << k / 3;
  }
}

template <class Real>
void expect_scheme_as_plain(const ControlMesh& mesh, const RefineOptions& options, const std::string& what) {
  const auto ours = refine<Real>(mesh, options, {});
  const auto plain = plain::refine<Real>(mesh, options);
  ASSERT_TRUE(ours.ok()) << what << ": " << ours.error().message;
  ASSERT_TRUE(plain.ok()) << what;
  EXPECT_EQ(ours->faces, plain->faces) << what;
  EXPECT_EQ(ours->base_faces, plain->base_faces) << what;
  EXPECT_EQ(ours->face_count, plain->face_count) << what;
  EXPECT_TRUE(std::ranges::equal(
      ours->provenance, plain->provenance,
      [](const Provenance& a, const Provenance& b) { return a.face == b.face && a.i == b.i && a.j == b.j; }))
      << what;
  EXPECT_LE(ulps<Real>(ours->points, plain->points), kUlps) << what << " points";
  EXPECT_LE(ulps<Real>(ours->limit_points, plain->limit_points), kUlps) << what << " limits";
  if constexpr (std::is_same_v<Real, double>) expect_normals(*ours, *plain, what + " normals");
  ASSERT_EQ(ours->primvars.size(), plain->primvars.size()) << what;
  for (std::size_t p = 0; p < ours->primvars.size(); ++p) {
    const std::string name = what + " primvar " + ours->primvars[p].name;
    EXPECT_EQ(ours->primvars[p].indices, plain->primvars[p].indices) << name;
    EXPECT_LE(ulps<Real>(ours->primvars[p].values, plain->primvars[p].values), kUlps) << name;
    EXPECT_LE(ulps<Real>(ours->primvars[p].limit_values, plain->primvars[p].limit_values), kUlps) << name;
  }
}

// By every scheme of the list that splits triangles.
template <class Real>
void expect_as_plain(ControlMesh mesh, const RefineOptions& options, const std::string& what) {
  for_each_scheme(AllGridSchemes(), [&]<class S>(const S&) {
    if (S::split != Split::triangles) return;
    mesh.subdivision_scheme = S::name;
    expect_scheme_as_plain<Real>(mesh, options, what + ' ' + std::string(S::name));
  });
}

RefineOptions everything(Index level, CreaseMethod method = CreaseMethod::uniform) {
  return {.level = level, .crease_method = method, .limit = true, .tangents = true, .normals = true};
}

TEST(engine, equals_the_plain_one_on_every_shape) {
  for (const shapes::NamedShape& shape : shapes::all_shapes())
    for (const CreaseMethod method : {CreaseMethod::uniform, CreaseMethod::chaikin})
      for (Index level = 0; level <= 3; ++level) {
        const std::string what = shape.name + " level " + std::to_string(level);
        expect_as_plain<double>(shape.mesh, everything(level, method), what);
        if (method == CreaseMethod::uniform)
          expect_as_plain<float>(shape.mesh, everything(level, method), what + " float");
        if (HasFailure()) return;
      }
}

TEST(engine, equals_the_plain_one_at_higher_levels) {
  int count = 0;
  for (const shapes::NamedShape& shape : shapes::all_shapes()) {
    if (shape.mesh.face_count() > 24 || ++count % 4 != 0) continue;
    expect_as_plain<double>(shape.mesh, everything(5, CreaseMethod::chaikin), shape.name);
    if (HasFailure()) return;
  }
}

TEST(engine, equals_the_plain_one_on_random_meshes) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const ControlMesh mesh = shapes::random_mesh(seed);
    const CreaseMethod method = seed % 2 == 0 ? CreaseMethod::chaikin : CreaseMethod::uniform;
    expect_as_plain<double>(mesh, everything(static_cast<Index>(seed % 4), method),
                            "seed " + std::to_string(seed));
    if (HasFailure()) return;
  }
}

// The mesh's own corners as a channel's, with values of its own; and once more, as a second channel.
ControlMesh with_values_on_points(ControlMesh mesh) {
  Primvar primvar{"st", Interpolation::face_varying, 2, {}, mesh.face_vertex_indices};
  for (Count v = 0; v < mesh.point_count(); ++v)
    primvar.values.insert(primvar.values.end(), {mesh.points[3 * v] * 2, mesh.points[3 * v + 1] - 1});
  mesh.primvars = {primvar, primvar};
  mesh.primvars[1].name = "uv";
  return mesh;
}

bool has_border(const Connectivity<Triangles>& topology) {
  return std::ranges::count(topology.edge_kinds(), EdgeKind::border) > 0;
}

TEST(engine, channels_that_connect_as_the_mesh_does_equal_the_plain_ones) {
  using enum FaceVaryingInterpolation;
  int as_mesh = 0, of_their_own = 0;
  for (const shapes::NamedShape& shape : shapes::all_shapes())
    for (const auto mode : {none, corners_only, corners_plus1, corners_plus2, boundaries, all}) {
      ControlMesh mesh = with_values_on_points(shape.mesh);
      mesh.face_varying_linear_interpolation = mode;
      const auto plan = Plan::build(mesh, {}, {});
      ASSERT_TRUE(plan.ok()) << shape.name;
      const bool shared = &plan->channel(0) == &plan->mesh();
      EXPECT_EQ(shared, mode != all && !has_border(plan->mesh().lattice()->triangles())) << shape.name;
      EXPECT_EQ(&plan->channel(1), &plan->channel(0)) << shape.name;
      ++(shared ? as_mesh : of_their_own);
      const std::string what = shape.name + " mode " + std::to_string(static_cast<int>(mode));
      expect_as_plain<double>(mesh, everything(2), what);
      if (HasFailure()) return;
    }
  EXPECT_GT(as_mesh, 20);
  EXPECT_GT(of_their_own, 20);
}

template <class Real>
void expect_same_bytes(const RefinedMesh<Real>& a, const RefinedMesh<Real>& b, const std::string& what) {
  EXPECT_EQ(a.points, b.points) << what;
  EXPECT_EQ(a.limit_points, b.limit_points) << what;
  EXPECT_EQ(a.tangents_u, b.tangents_u) << what;
  EXPECT_EQ(a.tangents_v, b.tangents_v) << what;
  EXPECT_EQ(a.normals, b.normals) << what;
  EXPECT_EQ(a.faces, b.faces) << what;
  for (std::size_t p = 0; p < a.primvars.size(); ++p) {
    EXPECT_EQ(a.primvars[p].values, b.primvars[p].values) << what;
    EXPECT_EQ(a.primvars[p].limit_values, b.primvars[p].limit_values) << what;
  }
}

// Which end of an edge is the lower differs between the two, and Chaikin's rule tells its halves apart.
TEST(engine, a_channel_numbered_backwards_equals_the_points) {
  ControlMesh mesh = shapes::icosahedron();
  const std::vector<Index>& corners = mesh.face_vertex_indices;
  shapes::crease(mesh, {corners[0], corners[1]}, 1.4f);
  shapes::crease(mesh, {corners[1], corners[2]}, 3.7f);
  const auto last = static_cast<Index>(mesh.point_count()) - 1;
  Primvar back{.name = "back",
               .interpolation = Interpolation::face_varying,
               .element_size = 3,
               .values = {},
               .indices = {}};
  for (Index v = 0; v <= last; ++v)
    for (Index c = 0; c < 3; ++c) back.values.push_back(mesh.points[3 * (last - v) + c]);
  for (const Index v : corners) back.indices.push_back(last - v);
  mesh.primvars = {back};
  const RefineOptions options = everything(4, CreaseMethod::chaikin);
  expect_as_plain<double>(mesh, options, "backwards");
  const auto refined = refine<double>(mesh, options, {});
  ASSERT_TRUE(refined.ok());
  const auto& values = refined->primvars[0];
  for (std::size_t k = 0; k < refined->faces.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_NEAR(values.values[3 * values.indices[k] + c], refined->points[3 * refined->faces[k] + c],
                  1e-14);
      ASSERT_NEAR(values.limit_values[3 * values.indices[k] + c],
                  refined->limit_points[3 * refined->faces[k] + c], 1e-14);
    }
}

TEST(engine, gives_the_same_bytes_for_any_number_of_threads) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const ControlMesh mesh = shapes::random_mesh(seed);
    RefineOptions options = everything(static_cast<Index>(seed % 7));
    const auto one = refine<float>(mesh, options, {});
    ASSERT_TRUE(one.ok());
    for (const Index threads : {2u, 3u, 7u}) {
      options.threads = threads;
      expect_same_bytes(*one, *refine<float>(mesh, options, {}),
                        "seed " + std::to_string(seed) + ", threads " + std::to_string(threads));
    }
  }
}

template <class Real>
void compare_instruction_sets() {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const ControlMesh mesh = shapes::random_mesh(seed);
    const RefineOptions options = everything(static_cast<Index>(seed % 6));
    kernels::force_instruction_set(0);
    const auto baseline = refine<Real>(mesh, options, {});
    ASSERT_TRUE(baseline.ok());
    for (int set = 1; set < kernels::kInstructionSets; ++set) {
      if (!kernels::has_instruction_set(set)) continue;
      kernels::force_instruction_set(set);
      expect_same_bytes(*baseline, *refine<Real>(mesh, options, {}),
                        std::string(kernels::tri_kernels<Real>().name) + ", seed " + std::to_string(seed));
    }
    kernels::force_instruction_set(-1);
  }
}

TEST(engine, gives_the_same_floats_with_every_instruction_set) { compare_instruction_sets<float>(); }
TEST(engine, gives_the_same_doubles_with_every_instruction_set) { compare_instruction_sets<double>(); }

ControlMesh fan(Index valence) {
  ControlMesh mesh;
  mesh.points = {0, 0, 1};
  for (Index k = 0; k < valence; ++k) {
    const double angle = 2 * 3.14159265358979323846 * k / valence;
    mesh.points.insert(mesh.points.end(), {std::cos(angle), std::sin(angle), 0});
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {0, 1 + k, 1 + (k + 1) % valence});
  }
  return mesh;
}

TEST(engine, takes_any_valence) {
  for (const Index valence : {3u, 4u, 5u, 7u, 12u, 64u, 65u, 100u, 1000u})
    expect_as_plain<double>(fan(valence), everything(2), "valence " + std::to_string(valence));
  const auto hub = refine<float>(fan(70000), everything(3), {});
  ASSERT_TRUE(hub.ok());
  EXPECT_TRUE(std::ranges::all_of(hub->points, [](float x) { return std::isfinite(x); }));
  EXPECT_NEAR(hub->normals[2], 1, 1e-3);
}

TEST(engine, refines_a_million_triangles_that_share_nothing) {
  ControlMesh mesh;
  const Index count = 1000000;
  for (Index f = 0; f < count; ++f) {
    for (const double x : {0.0, 1.0, 0.0}) mesh.points.insert(mesh.points.end(), {x + f, 1 - x, 0});
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {3 * f, 3 * f + 1, 3 * f + 2});
  }
  RefineOptions options{.level = 1};
  options.provenance = false;
  const auto refined = refine<float>(mesh, options, {});
  ASSERT_TRUE(refined.ok());
  EXPECT_EQ(refined->points.size(), 3u * 6 * count);
  EXPECT_EQ(refined->faces.size(), 3u * 4 * count);
}

TEST(engine, refines_one_triangle_to_level_12) {
  ControlMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  mesh.face_vertex_indices = {0, 1, 2};
  RefineOptions options{.level = 12};
  options.provenance = false;
  options.threads = 2;
  const auto refined = refine<float>(mesh, options, {});
  ASSERT_TRUE(refined.ok());
  EXPECT_EQ(refined->points.size() / 3, 4097u * 4098 / 2);
  const Index last = *std::ranges::max_element(refined->faces);
  EXPECT_EQ(last + 1, refined->points.size() / 3);
  for (std::size_t k = 0; k < refined->points.size(); k += 3) {
    ASSERT_GE(refined->points[k], 0);
    ASSERT_LE(refined->points[k] + refined->points[k + 1], 1 + 1e-5);
    ASSERT_EQ(refined->points[k + 2], 0);
  }
}

TEST(engine, evaluates_one_plan_again_for_other_values) {
  const ControlMesh mesh = shapes::random_mesh(5);
  const auto plan = Plan::build(mesh, {.max_level = 3}, {});
  ASSERT_TRUE(plan.ok());
  for (const double scale : {1.0, -2.0, 4.0}) {
    ControlMesh moved = mesh;
    for (double& x : moved.points) x *= scale;
    std::vector<double> values(3 * plan->mesh().value_count(3));
    const auto done =
        evaluate<double>(plan->mesh(), 3, moved.points, 3, Smoothing::smooth, {values.data()}, 1, {});
    ASSERT_TRUE(done.ok());
    const auto once = refine<double>(moved, {.level = 3}, {});
    EXPECT_TRUE(std::ranges::equal(values, once->points)) << scale;
  }
}

TEST(engine, refines_other_values_by_the_plan_of_their_cage) {
  for (const auto& [name, mesh] : shapes::all_shapes()) {
    SCOPED_TRACE(name);
    const auto plan = Plan::build(mesh, {.max_level = 2}, {});
    ASSERT_TRUE(plan.ok());
    ControlMesh moved = mesh;
    for (double& x : moved.points) x = 1 - 2 * x;
    for (Primvar& primvar : moved.primvars)
      for (double& x : primvar.values) x = 3 - x;
    const RefineOptions options = {.level = 2, .limit = true};
    const auto by_plan = refine<double>(moved, *plan, options, {}), anew = refine<double>(moved, options, {});
    ASSERT_TRUE(by_plan.ok());
    ASSERT_TRUE(std::ranges::equal(by_plan->points, anew->points));
    ASSERT_TRUE(std::ranges::equal(by_plan->limit_points, anew->limit_points));
    ASSERT_TRUE(std::ranges::equal(by_plan->faces, anew->faces));
    for (std::size_t k = 0; k < mesh.primvars.size(); ++k)
      ASSERT_TRUE(std::ranges::equal(by_plan->primvars[k].values, anew->primvars[k].values));
  }
}

TEST(engine, stops_when_nobody_waits_any_more) {
  const std::atomic<bool> cancelled{true};
  Budget budget;
  budget.cancelled = &cancelled;
  for (const Index threads : {1u, 3u}) {
    const auto refined = refine<float>(fan(100), {.level = 5, .threads = threads}, budget);
    ASSERT_FALSE(refined.ok());
    EXPECT_EQ(refined.error().code, ErrorCode::cancelled);
  }
}

TEST(engine, stops_at_a_deadline_before_the_end) {
  const ControlMesh mesh = fan(200);
  const auto plan = Plan::build(mesh, {}, {});
  const std::vector<float> control(mesh.points.begin(), mesh.points.end());
  Buffer<float> values(3 * plan->mesh().value_count(9));
  Budget budget;
  budget.deadline = Budget::Clock::now();
  for (const Index threads : {1u, 2u}) {
    values.back() = -7;
    const auto done =
        evaluate<float>(plan->mesh(), 9, control, 3, Smoothing::smooth, {values.data()}, threads, budget);
    ASSERT_FALSE(done.ok());
    EXPECT_EQ(done.error().code, ErrorCode::deadline_exceeded);
    EXPECT_EQ(values.back(), -7);  // nobody got that far
  }
}

}  // namespace
}  // namespace subdivd

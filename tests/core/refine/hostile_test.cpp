// Meshes made to take quadratic time or to be stopped; see tests/core/mesh/hostile_test.cpp about deadlines.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/refine/refine.h"
#include "tests/shapes/build.h"
#include "tests/support/deadlines.h"

namespace subdivd {
namespace {

using testing::expect_stops_midway;
using testing::kLinear;
using testing::within;

RefineOptions everything(Index level) {
  RefineOptions options;
  options.level = level;
  options.limit = options.tangents = options.normals = true;
  return options;
}

// A hub all of whose spokes are sharp has a sector for every face, and each used to count all the spokes.
TEST(HostileRefine, a_hub_of_many_sectors_gets_its_normal_in_linear_time) {
  constexpr Index kFaces = 150000;
  ControlMesh mesh = shapes::disk(kFaces);
  for (Index k = 1; k <= kFaces; ++k) shapes::crease(mesh, {0, k}, 10);
  EXPECT_TRUE(refine<float>(mesh, everything(0), within(kLinear)).ok());
}

// Under Chaikin's rule every one of a hub's values used to look at all its edges.
TEST(HostileRefine, a_hub_of_many_values_and_semi_sharp_spokes_takes_linear_time) {
  constexpr Index kFaces = 60000;
  ControlMesh mesh = shapes::disk(kFaces);
  mesh.face_varying_linear_interpolation = FaceVaryingInterpolation::none;
  for (Index k = 1; k <= kFaces; ++k) shapes::crease(mesh, {0, k}, 2.5f);
  Primvar& primvar = mesh.primvars.emplace_back();
  primvar.name = "st";
  primvar.interpolation = Interpolation::face_varying;
  primvar.values.assign(kFaces + 1 + kFaces / 2, 0.5);
  for (std::size_t h = 0; h < mesh.face_vertex_indices.size(); ++h) {
    const Index v = mesh.face_vertex_indices[h];
    primvar.indices.push_back(v == 0 ? kFaces + 1 + static_cast<Index>(h / 6) : v);
  }
  RefineOptions options;
  options.level = 0;
  options.limit = true;
  options.crease_method = CreaseMethod::chaikin;
  const Budget budget = within(kLinear);
  ASSERT_TRUE(mesh.check(budget).ok());
  EXPECT_TRUE(refine<float>(mesh, options, budget).ok());
}

// A channel used to go through all points, whether faces use them or not.
TEST(HostileRefine, many_channels_over_many_unused_points_take_linear_time) {
  ControlMesh mesh = shapes::tetrahedron();
  mesh.points.resize(3 * 2000000, 0.5);
  for (Index k = 0; k < 10000; ++k) {
    Primvar& primvar = mesh.primvars.emplace_back();
    primvar.name = "p" + std::to_string(k);
    primvar.interpolation = Interpolation::face_varying;
    primvar.values.assign(12, 1);
  }
  RefineOptions options;
  options.level = 0;
  EXPECT_TRUE(refine<float>(mesh, options, within(kLinear)).ok());
}

ControlMesh with_render_meshes(Index columns, Index vertex_count) {
  ControlMesh mesh = shapes::grid(columns, columns);
  for (Index f = 0; f < mesh.face_count(); ++f)
    mesh.render_meshes.push_back({f, f + 1, vertex_count, {0, 1, vertex_count - 1}});
  return mesh;
}

TEST(HostileRefine, a_hundred_thousand_render_meshes_take_linear_time) {
  const ControlMesh mesh = with_render_meshes(224, 3);
  ASSERT_GT(mesh.render_meshes.size(), 100000u);
  RefineOptions options;
  options.level = 1;
  options.threads = 2;
  const auto refined = refine<float>(mesh, options, within(kLinear));
  ASSERT_TRUE(refined.ok());
  for (Count k = 0; k < refined->render_meshes.size(); ++k)
    ASSERT_EQ(refined->render_meshes[k].face_begin, 4 * k);
}

// Refining makes that many vertices, and is refused; saying so must not take as long as doing it.
TEST(HostileRefine, render_meshes_of_many_unused_vertices_are_predicted_in_the_time_of_their_faces) {
  const ControlMesh mesh = with_render_meshes(50, 2000000);
  const auto size = predict_size<float>(mesh, {}, within(kLinear));
  ASSERT_TRUE(size.ok());
  EXPECT_EQ(size->render_vertices[0], 2000000u + 3 * 3 + 3);  // level 2
}

TEST(StopsMidway, predicting) {
  ControlMesh mesh = shapes::grid(500, 500);
  mesh.primvars.push_back(shapes::unindexed(mesh, "st", 2));
  expect_stops_midway([&](const Budget& budget) { return predict_size<float>(mesh, {}, budget); });
}

TEST(StopsMidway, at_one_vertex_of_all_faces) {
  ControlMesh mesh = shapes::disk(150000);
  for (Index k = 1; k <= 150000; ++k) shapes::crease(mesh, {0, k}, 2.5f);
  expect_stops_midway([&](const Budget& budget) { return refine<float>(mesh, everything(0), budget); });
}

// One step of everything, and what it is made of.
TEST(StopsMidway, where_faces_become_quads) {
  ControlMesh mesh = shapes::grid(300, 300);
  mesh.subdivision_scheme = "catmullClark";
  mesh.primvars.push_back(shapes::unindexed(mesh, "st", 2));
  expect_stops_midway([&](const Budget& budget) { return Plan::build(mesh, {.max_level = 1}, budget); });
  expect_stops_midway([&](const Budget& budget) { return refine<float>(mesh, everything(0), budget); });
}

TEST(StopsMidway, within_one_face) {
  const ControlMesh mesh = shapes::tetrahedron();
  RefineOptions options = everything(10);
  expect_stops_midway([&](const Budget& budget) { return refine<float>(mesh, options, budget); });
}

TEST(StopsMidway, where_every_normal_takes_the_long_way) {
  ControlMesh mesh = shapes::tetrahedron();
  mesh.points.assign(mesh.points.size(), 0.25);
  expect_stops_midway([&](const Budget& budget) { return refine<float>(mesh, everything(9), budget); });
}

TEST(StopsMidway, with_values_of_four_thousand_numbers) {
  ControlMesh mesh = shapes::icosahedron();
  mesh.primvars.push_back(shapes::plain_primvar(mesh, "wide", Interpolation::vertex, kMaxElementSize));
  RefineOptions options;
  options.level = 5;
  options.limit = true;
  expect_stops_midway([&](const Budget& budget) { return refine<float>(mesh, options, budget); });
}

// 1 / x is infinite for the smallest of them: normals came out as NaN, and were called too large.
template <class Real>
void expect_finite_at(double scale) {
  for (const auto& [name, shape] : shapes::all_shapes()) {
    ControlMesh mesh = shape;
    for (double& x : mesh.points) x *= scale;
    const auto refined = refine<Real>(mesh, everything(1), {});
    ASSERT_TRUE(refined.ok()) << name;
    for (const auto* values : {&refined->points, &refined->limit_points, &refined->tangents_u,
                               &refined->tangents_v, &refined->normals})
      for (const Real x : *values) ASSERT_TRUE(std::isfinite(x)) << name << ' ' << scale;
  }
}

TEST(Denormals, have_limits_and_normals_in_single_precision) {
  for (const double scale : {1e-38, 1e-40, 1e-43, 1e-45}) expect_finite_at<float>(scale);
}
TEST(Denormals, have_limits_and_normals_in_double_precision) {
  for (const double scale : {1e-308, 1e-311, 1e-320, 1e-323}) expect_finite_at<double>(scale);
}

}  // namespace
}  // namespace subdivd

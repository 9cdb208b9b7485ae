#include "core/refine/refine.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "core/mesh/topology.h"
#include "tests/shapes/build.h"

namespace subdivd {
namespace {

template <class T>
Count bytes_of(const Buffer<T>& items) {
  return items.size() * sizeof(T);
}

template <class Real>
Count bytes_of(const RefinedMesh<Real>& mesh) {
  Count bytes = bytes_of(mesh.points) + bytes_of(mesh.faces) + bytes_of(mesh.base_faces) +
                bytes_of(mesh.provenance) + bytes_of(mesh.limit_points) + bytes_of(mesh.tangents_u) +
                bytes_of(mesh.tangents_v) + bytes_of(mesh.normals);
  for (const auto& primvar : mesh.primvars)
    bytes += bytes_of(primvar.values) + bytes_of(primvar.limit_values) + bytes_of(primvar.indices);
  for (const auto& render : mesh.render_meshes) {
    for (const auto& sources : render.source_values) bytes += bytes_of(sources);
    bytes += bytes_of(render.source_vertices);
  }
  return bytes;
}

RefineOptions everything(Index level) {
  RefineOptions options;
  options.level = level;
  options.limit = options.tangents = options.normals = true;
  return options;
}

TEST(PredictSize, tells_counts_and_bytes_beforehand) {
  for (const auto& [name, mesh] : shapes::all_shapes()) {
    SCOPED_TRACE(name);
    for (Index level : {0, 1, 3}) {
      const auto size = predict_size<float>(mesh, everything(level));
      const auto refined = refine<float>(mesh, everything(level), {});
      ASSERT_TRUE(size.ok());
      ASSERT_TRUE(refined.ok());
      EXPECT_EQ(size->counts.vertices, refined->points.size() / 3);
      EXPECT_EQ(size->counts.faces, refined->faces.size() / 3);
      EXPECT_EQ(size->bytes, bytes_of(*refined));
    }
  }
}

TEST(Refine, level_zero_is_the_control_mesh) {
  const ControlMesh mesh = shapes::icosahedron();
  RefineOptions options;
  options.level = 0;
  const auto refined = refine<double>(mesh, options, {});
  ASSERT_TRUE(refined.ok());
  EXPECT_TRUE(std::ranges::equal(refined->points, mesh.points));
  EXPECT_TRUE(std::ranges::equal(refined->faces, mesh.face_vertex_indices));
}

TEST(Refine, refuses_a_level_over_the_maximum) {
  RefineOptions options;
  options.level = kMaxLevel + 1;
  const auto refined = refine<double>(shapes::cube(), options, {});
  ASSERT_FALSE(refined.ok());
  EXPECT_EQ(refined.error().code, ErrorCode::out_of_range);
}

TEST(Refine, refuses_what_32_bits_cannot_number_before_allocating) {
  RefineOptions options;
  options.level = kMaxLevel;
  const auto refined = refine<double>(shapes::cube(), options, {});  // 12.9 billion triangles
  ASSERT_FALSE(refined.ok());
  EXPECT_EQ(refined.error().code, ErrorCode::too_large);
  EXPECT_GT(refined.error().predicted, refined.error().allowed);
}

TEST(Refine, refuses_more_bytes_than_the_budget_allows) {
  Budget budget;
  budget.max_bytes = 1000;
  const auto refined = refine<double>(shapes::cube(), {}, budget);
  ASSERT_FALSE(refined.ok());
  EXPECT_EQ(refined.error().code, ErrorCode::too_large);
  EXPECT_EQ(refined.error().allowed, 1000u);
}

TEST(Refine, stops_when_the_caller_is_gone_or_time_is_up) {
  const std::atomic<bool> gone{true};
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_EQ(refine<double>(shapes::cube(), {}, budget).error().code, ErrorCode::cancelled);
  budget = {};
  budget.deadline = Budget::Clock::now() - std::chrono::seconds(1);
  EXPECT_EQ(refine<double>(shapes::cube(), {}, budget).error().code, ErrorCode::deadline_exceeded);
}

TEST(Refine, refuses_values_that_would_overflow_the_precision) {
  ControlMesh mesh = shapes::cube();
  mesh.points[4] = 1e33;
  const auto refined = refine<float>(mesh, {}, {});
  ASSERT_FALSE(refined.ok());
  EXPECT_EQ(refined.error().code, ErrorCode::out_of_range);
  EXPECT_EQ(refined.error().where, (Path{"points", std::uint64_t{4}}));
  EXPECT_TRUE(refine<double>(mesh, {}, {}).ok());
}

TEST(Refine, is_finite_for_coordinates_of_any_allowed_size) {
  for (double scale : {1e-40, 1e-30, 1e30, 3e32}) {
    ControlMesh mesh = shapes::double_pyramid(100);
    for (double& x : mesh.points) x = x * scale / 2;
    const auto refined = refine<float>(mesh, everything(2), {});
    ASSERT_TRUE(refined.ok()) << scale;
    for (const auto* values : {&refined->points, &refined->limit_points, &refined->tangents_u,
                               &refined->tangents_v, &refined->normals})
      for (float x : *values) ASSERT_TRUE(std::isfinite(x)) << scale;
  }
}

TEST(Refine, refuses_an_unknown_scheme) {
  ControlMesh mesh = shapes::cube();
  mesh.subdivision_scheme = "catmullclark";
  EXPECT_EQ(refine<double>(mesh, {}, {}).error().code, ErrorCode::bad_enum);
}

TEST(Refine, holes_leave_out_their_triangles_and_keep_everything_else) {
  ControlMesh mesh = shapes::icosahedron();
  const auto whole = refine<double>(mesh, {}, {});
  mesh.hole_indices = {3};
  const auto holed = refine<double>(mesh, {}, {});
  EXPECT_EQ(holed->points, whole->points);
  Buffer<Index> expected = whole->faces;
  expected.erase(expected.begin() + 3 * 3 * 16, expected.begin() + 4 * 3 * 16);
  EXPECT_EQ(holed->faces, expected);
}

TEST(Refine, provenance_names_the_place_of_every_vertex) {
  const ControlMesh mesh = shapes::torus(4, 5);
  RefineOptions options;
  options.level = 2;
  const auto refined = refine<double>(mesh, options, {});
  for (Index v = 0; v < refined->provenance.size(); ++v) {
    const auto [face, i, j, corner] = refined->provenance[v];
    ASSERT_LT(face, mesh.face_count());
    ASSERT_LE(i + j, 4u);
  }
  for (std::size_t t = 0; t < refined->base_faces.size(); ++t) ASSERT_EQ(refined->base_faces[t], t / 16);
}

// A tag on a point without faces used to step a ring that is empty.
TEST(Refine, an_unreferenced_point_with_a_semi_sharp_corner_stays_where_it_is) {
  ControlMesh mesh = shapes::tetrahedron();
  mesh.points.insert(mesh.points.end(), {7, 8, 9});
  shapes::corner(mesh, 4, 2.5f);
  const auto refined = refine<double>(mesh, everything(1), {});
  ASSERT_TRUE(refined.ok());
  EXPECT_EQ(refined->limit_points[12], 7);
  EXPECT_EQ(refined->normals[12], 0);
}

TEST(Normals, of_a_cone_tip_point_outwards) {
  const auto refined = refine<double>(shapes::double_pyramid(7), everything(2), {});
  const double* n = refined->normals.data();
  EXPECT_GT(n[2], 0.9);
  EXPECT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-14);
}

TEST(Normals, are_zero_where_all_points_coincide) {
  ControlMesh mesh = shapes::tetrahedron();
  mesh.points.assign(mesh.points.size(), 0.25);
  const auto refined = refine<double>(mesh, everything(1), {});
  for (double x : refined->normals) EXPECT_EQ(x, 0);
}

// Lengths of tangents, their products and squares leave what single precision can hold long before points do.
TEST(Normals, do_not_depend_on_the_size) {
  for (ControlMesh mesh : {shapes::double_pyramid(7), shapes::icosahedron()}) {
    const auto at = [&](double scale, Index level) {
      ControlMesh scaled = mesh;
      for (double& x : scaled.points) x *= scale;
      return *refine<float>(scaled, everything(level), {});
    };
    for (const Index level : {0u, 1u, 2u, 3u, 4u}) {
      const RefinedMesh<float> one = at(1, level);
      for (const double scale : {1e-18, 1e-9, 1e12, 1e30}) {
        const RefinedMesh<float> other = at(scale, level);
        for (std::size_t k = 0; k < one.normals.size(); ++k)
          ASSERT_NEAR(one.normals[k], other.normals[k], 1e-5) << scale << ' ' << level << ' ' << k;
      }
    }
  }
}

TEST(Normals, at_a_crease_stand_in_the_middle_of_the_two_sides) {
  ControlMesh mesh;  // a roof: ridge 0-1-2 along y, falling at 45 degrees to both sides
  for (int y = 0; y < 3; ++y)
    for (int x = -1; x <= 1; ++x)
      mesh.points.insert(mesh.points.end(), {double(x), double(y), -std::abs(double(x))});
  for (Index row : {0, 3})
    for (Index column : {0, 1}) {
      const Index a = row + column;
      mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {a, a + 1, a + 4, a, a + 4, a + 3});
    }
  shapes::crease(mesh, {1, 4, 7}, kInfiniteSharpness);
  const auto refined = refine<double>(mesh, everything(2), {});
  EXPECT_NEAR(refined->normals[3 * 4 + 0], 0, 1e-15);
  EXPECT_NEAR(refined->normals[3 * 4 + 2], 1, 1e-15);
}

TEST(Primvars, every_interpolation_has_its_rule) {
  ControlMesh mesh = shapes::icosahedron();
  Primvar rest{"rest", Interpolation::vertex, 3, mesh.points, {}};
  mesh.primvars = {rest,
                   shapes::plain_primvar(mesh, "linear", Interpolation::varying, 1),
                   shapes::plain_primvar(mesh, "id", Interpolation::uniform, 2),
                   {"k", Interpolation::constant, 1, {42}, {}}};
  RefineOptions options;
  options.level = 1;
  options.limit = true;
  const auto refined = refine<double>(mesh, options, {});
  EXPECT_EQ(refined->primvars[0].values, refined->points);
  EXPECT_EQ(refined->primvars[0].limit_values, refined->limit_points);
  const Topology<Triangles> topology(12, Triangles(mesh.face_vertex_indices));
  const auto& linear = mesh.primvars[1].values;
  for (Index v = 0; v < 12; ++v) EXPECT_EQ(refined->primvars[1].values[v], linear[v]);
  for (Index e = 0; e < topology.edge_count(); ++e) {
    const auto [a, b] = topology.edge_vertices(e);
    EXPECT_EQ(refined->primvars[1].values[12 + e], 0.5 * linear[a] + 0.5 * linear[b]);
  }
  ASSERT_EQ(refined->primvars[2].values.size(), 2u * 80);
  EXPECT_EQ(refined->primvars[2].values[2 * 79], mesh.primvars[2].values[2 * 19]);
  EXPECT_EQ(refined->primvars[3].values, Buffer<double>{42});
}

TEST(Primvars, a_value_that_no_corner_uses_is_kept) {
  ControlMesh mesh = shapes::icosahedron();
  mesh.primvars = {
      {"st", Interpolation::face_varying, 1, std::vector<double>(13, 1), mesh.face_vertex_indices}};
  mesh.primvars[0].values[12] = 99;
  const auto refined = refine<double>(mesh, {}, {});
  EXPECT_EQ(refined->primvars[0].values[12], 99);
}

}  // namespace
}  // namespace subdivd

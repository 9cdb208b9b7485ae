// The plain engine's step that makes a vertex of every corner, with Doo and Sabin's masks: what holds for every mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/engine/plain/base_faces.h"
#include "core/engine/plain/corner_rows.h"
#include "core/engine/plain/corner_split.h"
#include "core/schemes/catmull_clark.h"
#include "core/schemes/doo_sabin.h"
#include "core/schemes/tags.h"
#include "tests/core/engine/doo_sabin_surface.h"
#include "tests/core/engine/levels.h"
#include "tests/shapes/build.h"
#include "tests/shapes/polygons.h"

namespace subdivd::plain {
namespace {

TEST(DooSabinMask, is_that_of_1978_and_that_of_the_course) {
  for (const Index n : {3u, 4u, 5u, 7u, 12u, 100u}) {
    const CornerMask mask = DooSabin{}.corner_mask(n), middle = kBothWeights[1].corner_mask(n);
    for (Index i = 0; i < n; ++i) {
      const double wave = std::cos(2 * std::numbers::pi * i / n);
      const double weight = (i == 0 ? mask.self : 0) + (mask.mean + mask.wave * wave) / n;
      EXPECT_NEAR(weight, i == 0 ? 1.0 / 4 + 5.0 / (4 * n) : (3 + 2 * wave) / (4 * n), 1e-15);
      const double of_middle = (i == 0 ? middle.self : 0) + (i == 1 || i == n - 1 ? middle.beside : 0) +
                               (middle.mean + middle.wave * wave) / n;
      EXPECT_NEAR(of_middle, (i == 0 ? 1.0 / 2 : i == 1 || i == n - 1 ? 1.0 / 8 : 0) + 1.0 / (4 * n), 1e-15);
      if (n == 4) {
        EXPECT_NEAR(weight, of_middle, 1e-16);
      }
    }
  }
}

TEST(DooSabinScheme, refuses_semi_sharpness_by_its_own_name) {
  ControlMesh mesh = shapes::octahedron();
  shapes::crease(mesh, {0, 2}, kInfiniteSharpness);
  EXPECT_TRUE(refuse_semi_sharp(DooSabin::name, mesh).ok());
  shapes::crease(mesh, {0, 3}, 2.5f);
  const auto refused = refuse_semi_sharp(DooSabin::name, mesh);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
  EXPECT_EQ(refused.error().where, (Path{"creaseSharpnesses", std::uint64_t{1}}));
  EXPECT_NE(refused.error().message.find("dooSabin"), std::string::npos);
  mesh.crease_sharpnesses[1] = 0;
  shapes::corner(mesh, 1, 0.5f);
  EXPECT_EQ(refuse_semi_sharp(DooSabin::name, mesh).error().where,
            (Path{"cornerSharpnesses", std::uint64_t{0}}));
  EXPECT_FALSE(takes_semi_sharp<DooSabin>());
  EXPECT_TRUE(takes_semi_sharp<CatmullClark>());
}

TEST(DooSabinScheme, has_an_option_for_its_weights) {
  ASSERT_EQ(DooSabin::options().size(), 1);
  const SchemeOption<DooSabin>& option = DooSabin::options()[0];
  EXPECT_EQ(option.name, "dooSabinWeights");
  DooSabin scheme;
  EXPECT_EQ(option.words[option.get(scheme)], "dooSabin");
  option.set(scheme, 1);
  EXPECT_EQ(scheme.weights, DooSabinWeights::midpoint);
  EXPECT_EQ(option.words[option.get(scheme)], "midpoint");
}

TEST(CornerRows, have_weights_that_sum_to_one) {
  for (const auto& [name, mesh] : doo_sabin_meshes())
    for (const DooSabin& scheme : kBothWeights) {
      Level level = first_of(mesh);
      for (int depth = 0; depth < 3; ++depth) {
        CornerSplit split = split_corners(level);
        const SparseRows rows = written_out(step_rows(scheme, level, split)),
                         limits = written_out(limit_rows(scheme, level, split)),
                         tangents = written_out(tangent_rows(scheme, level, split));
        ASSERT_EQ(rows.row_count(), level.faces.half_edge_count() + split.more.size());
        ASSERT_EQ(rows.row_count(), split.faces.vertex_count());
        ASSERT_EQ(limits.row_count(), level.faces.vertex_count());
        ASSERT_EQ(tangents.row_count(), 2 * limits.row_count());
        for (Count r = 0; r < rows.row_count(); ++r)
          ASSERT_NEAR(sum_of_row(rows, r), 1, 1e-12) << name << ' ' << depth << ' ' << r;
        for (Count r = 0; r < limits.row_count(); ++r) {
          ASSERT_NEAR(sum_of_row(limits, r), 1, 1e-12) << name << ' ' << depth << ' ' << r;
          ASSERT_NEAR(sum_of_row(tangents, 2 * r), 0, 1e-12) << name << ' ' << r;
          ASSERT_NEAR(sum_of_row(tangents, 2 * r + 1), 0, 1e-12) << name << ' ' << r;
        }
        level = next_level(std::move(split));
      }
    }
}

// With all that is sharp or not manifold, a step leaves a surface whose borders are curves or open.
TEST(CornerSplit, leaves_a_manifold_whose_every_vertex_has_a_face) {
  for (const auto& [name, mesh] : doo_sabin_meshes()) {
    Level level = first_of(mesh);
    for (int depth = 0; depth < 3; ++depth) {
      level = next_level(split_corners(level));
      ASSERT_TRUE(is_manifold(level.faces)) << name << ' ' << depth;
      for (Index e = 0; e < level.faces.edge_count(); ++e) {
        const bool border = level.faces.edge_half_edges(e).size() == 1;
        const auto [a, b] = level.faces.edge_vertices(e);
        if (!border && is_sharp(level.sharpness.edges[e])) {  // a slit between two pinned points
          ASSERT_TRUE(is_infinite(level.sharpness.vertices[a]) && is_infinite(level.sharpness.vertices[b]))
              << name << ' ' << depth;
        } else if (!border) {
          ASSERT_EQ(level.sharpness.edges[e], 0) << name << ' ' << depth;
        } else if (mesh.interpolate_boundary != BoundaryInterpolation::none) {
          ASSERT_EQ(level.sharpness.edges[e], kInfiniteSharpness) << name << ' ' << depth << ' ' << e;
        }
      }
      for (Index v = 0; v < level.faces.vertex_count(); ++v) {
        const std::size_t corners = level.faces.vertex_corners(v).size();
        ASSERT_GE(corners, 1) << name << ' ' << depth;
        ASSERT_LE(level.faces.vertex_edges(v).size(), corners + 1) << name << ": several fans at " << v;
      }
    }
  }
}

TEST(CornerSplit, makes_of_a_closed_mesh_a_vertex_per_corner_and_a_face_per_face_edge_and_vertex) {
  for (const auto& [name, mesh] : doo_sabin_meshes()) {
    const Level level = base_level(mesh);
    bool ordinary = std::ranges::none_of(level.sharpness.edges, is_sharp) &&
                    std::ranges::none_of(level.sharpness.vertices, is_sharp);
    for (Index v = 0; v < level.faces.vertex_count(); ++v)
      ordinary &= level.faces.vertex_corners(v).size() > 2;
    if (!ordinary) continue;
    const CornerSplit split = split_corners(level);
    EXPECT_EQ(split.faces.vertex_count(), level.faces.half_edge_count()) << name;
    EXPECT_EQ(split.faces.face_count(),
              level.faces.face_count() + level.faces.edge_count() + level.faces.vertex_count())
        << name;
    EXPECT_EQ(split.faces.edge_count(), 2 * level.faces.half_edge_count()) << name;
    ASSERT_EQ(split.face_parents.size(), split.faces.face_count());
    for (Index f = 0; f < level.faces.face_count(); ++f) EXPECT_EQ(split.face_parents[f], f);
  }
}

TEST(DooSabinByRows, knows_the_base_face_of_every_part) {
  for (const auto& [name, mesh] : doo_sabin_meshes()) {
    DooSabinSurface surface(mesh);
    BaseFaces base = first_base_faces(surface.level.faces);
    const Adjacency control = surface.level.faces;
    for (int depth = 0; depth < 2; ++depth) {
      base = next_base_faces(base, surface.level, surface.split);
      surface.refine();
      ASSERT_EQ(base.of_vertices.size(), surface.level.faces.vertex_count()) << name;
      ASSERT_EQ(base.of_faces.size(), surface.level.faces.face_count()) << name;
      for (const Index f : base.of_vertices) ASSERT_LT(f, control.face_count()) << name;
      for (const Index f : base.of_faces) ASSERT_LT(f, control.face_count()) << name;
      for (Index h = 0; h < control.half_edge_count() && depth == 0; ++h)
        ASSERT_EQ(base.of_vertices[h], control.face_of(h)) << name;
      for (Index f = 0; f < control.face_count(); ++f) ASSERT_EQ(base.of_faces[f], f) << name;
    }
  }
}

// --- Order and size ------------------------------------------------------------------------------------------

TEST(DooSabinByRows, does_not_depend_on_how_points_and_faces_are_numbered) {
  for (const auto& [name, mesh] : doo_sabin_meshes()) {
    const Renumbered other = renumbered(mesh, 7);
    DooSabinSurface a(mesh), b(other.mesh);
    const Adjacency from = a.level.faces, to = b.level.faces;
    a.refine();
    b.refine();
    ASSERT_EQ(a.level.faces.vertex_count(), b.level.faces.vertex_count()) << name;
    ASSERT_EQ(a.level.faces.face_count(), b.level.faces.face_count()) << name;
    for (Index f = 0; f < from.face_count(); ++f) {
      const Index n = from.face_size(f);
      for (Index k = 0; k < n; ++k) {
        const Index there = to.face_begin(other.face_at[f]) + (k + n - other.turned[f]) % n;
        ASSERT_LT(distance(a.at(from.face_begin(f) + k), b.at(there)), 1e-14) << name;
      }
    }
  }
}

TEST(DooSabinByRows, keeps_a_plane_a_plane) {
  for (auto [name, mesh] : doo_sabin_meshes()) {
    for (std::size_t k = 0; k < mesh.points.size(); k += 3)
      mesh.points[k + 2] = 1 + 2 * mesh.points[k] - 3 * mesh.points[k + 1];
    DooSabinSurface surface(mesh);
    surface.refine();
    surface.refine();
    for (Index v = 0; v < surface.level.faces.vertex_count(); ++v) {
      const auto [x, y, z] = surface.at(v);
      ASSERT_NEAR(z, 1 + 2 * x - 3 * y, 1e-13) << name;
    }
  }
}

// Two faces of 100,000 corners see all of them from each: rows written out would have 2e10 weights.
TEST(DooSabinByRows, are_linear_in_the_corners_of_a_face) {
  const Index n = 100000;
  ControlMesh mesh;
  for (Index k = 0; k < 2 * n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    mesh.points.insert(mesh.points.end(), {std::cos(angle), std::sin(angle), k < n ? -0.5 : 0.5});
  }
  mesh.face_vertex_counts = {n, n};
  for (Index k = 0; k < n; ++k) mesh.face_vertex_indices.push_back(n - 1 - k);
  for (Index k = 0; k < n; ++k) mesh.face_vertex_indices.push_back(n + k);
  for (Index k = 0; k < n; ++k) {
    mesh.face_vertex_counts.push_back(4);
    mesh.face_vertex_indices.insert(mesh.face_vertex_indices.end(), {k, (k + 1) % n, n + (k + 1) % n, n + k});
  }
  const Level level = base_level(mesh);
  const CornerSplit split = split_corners(level);
  for (const StepRows& rows : {step_rows(DooSabin{}, level, split), limit_rows(DooSabin{}, level, split)}) {
    EXPECT_LT(rows.rows.columns.size() + rows.sums.columns.size(), Count{60} * n);
    const std::vector<double> points = apply<double>(rows, std::span<const double>(mesh.points), 3);
    for (std::size_t k = 0; k < points.size(); k += 3) ASSERT_LT(std::abs(points[k + 2]), 0.5 + 1e-9);
  }
  // All corners of such a face are its own shrunk by half.
  const std::vector<double> points =
      apply<double>(step_rows(DooSabin{}, level, split), std::span<const double>(mesh.points), 3);
  for (Index k = 0; k < n; k += 997) EXPECT_NEAR(std::hypot(points[3 * k], points[3 * k + 1]), 0.5, 1e-9);
}

TEST(CornerSplit, stops_when_the_budget_says_so) {
  Level level = base_level(shapes::icosahedron());
  for (int depth = 0; depth < 4; ++depth) level = next_level(split_corners(level));
  Budget budget;
  budget.deadline = Budget::Clock::now();
  EXPECT_FALSE(stoppable(budget, [&](const Pace& pace) { split_corners(level, pace); }).ok());
  const CornerSplit split = split_corners(level);
  EXPECT_FALSE(stoppable(budget, [&](const Pace& pace) { step_rows(DooSabin{}, level, split, pace); }).ok());
}

}  // namespace
}  // namespace subdivd::plain

// Kobbelt's interpolating quads by the plain engine: four-point curves along the lines of the net.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/curves/subdivision.h"
#include "core/engine/plain/line_rows.h"
#include "core/engine/plain/split.h"
#include "core/schemes/kobbelt.h"
#include "tests/core/engine/kobbelt_surface.h"
#include "tests/core/engine/levels.h"
#include "tests/shapes/build.h"
#include "tests/shapes/polygons.h"

namespace subdivd::plain {
namespace {

TEST(KobbeltMask, goes_straight_on_at_a_regular_vertex) {
  const ExtensionMask mask = Kobbelt{}.extension_mask(4);
  EXPECT_EQ(mask.all_ends + mask.near_ends, 0);    // l_{i-1}, l_i, l_{i+1}
  EXPECT_EQ(mask.all_ends, 1);                     // l_{i+2}
  EXPECT_EQ(mask.near_faces + mask.all_faces, 0);  // all four k
  for (const Index n : {3u, 5u, 8u, 100u}) {
    const ExtensionMask other = Kobbelt{}.extension_mask(n);
    EXPECT_NEAR(n * (other.all_ends + other.all_faces) + 3 * other.near_ends + 4 * other.near_faces, 1,
                1e-15);
  }
}

TEST(LineRows, have_weights_that_sum_to_one) {
  for (const auto& [name, mesh] : kobbelt_meshes()) {
    Level level = base_level(mesh);
    for (int depth = 0; depth < 2; ++depth, level = next_level(level, Split::quads, CreaseMethod::uniform))
      for (const bool linear : {false, true}) {
        const SparseRows rows = written_out(step_rows(Kobbelt{}, level, linear)),
                         tangents = written_out(tangent_rows(Kobbelt{}, level, linear));
        ASSERT_EQ(rows.row_count(), child_count(Split::quads, level.faces)) << name;
        ASSERT_EQ(tangents.row_count(), 2 * level.faces.vertex_count()) << name;
        for (Count r = 0; r < rows.row_count(); ++r)
          ASSERT_NEAR(sum_of_row(rows, r), 1, 1e-12) << name << ' ' << r;
        for (Count r = 0; r < tangents.row_count(); ++r)
          ASSERT_NEAR(sum_of_row(tangents, r), 0, 1e-12) << name;
      }
  }
}

TEST(KobbeltByRows, keeps_old_points_to_the_bit) {
  for (const auto& [name, mesh] : kobbelt_meshes()) {
    KobbeltSurface surface(mesh);
    surface.refine();
    surface.refine();
    for (std::size_t k = 0; k < mesh.points.size(); ++k) ASSERT_EQ(surface.points[k], mesh.points[k]) << name;
  }
}

// --- The witness: four-point curves along the rows, and then along the columns --------------------------------

// Every row of a grid as a curve, one step.
std::vector<double> refined_rows(const std::vector<double>& points, Index columns, CurveWrap wrap) {
  ControlCurves curves;
  curves.points = points;
  curves.vertex_counts.assign(points.size() / 3 / columns, columns);
  curves.wrap = wrap;
  curves.basis = FourPoint{};
  const auto refined = refine<double>(curves, {.level = 1}, {});
  return {refined->points.begin(), refined->points.end()};
}

std::vector<double> transposed(const std::vector<double>& points, Index columns) {
  std::vector<double> out;
  const std::size_t rows = points.size() / 3 / columns;
  for (Index i = 0; i < columns; ++i)
    for (std::size_t j = 0; j < rows; ++j)
      for (std::size_t axis = 0; axis < 3; ++axis) out.push_back(points[3 * (j * columns + i) + axis]);
  return out;
}

// In the first direction first, or last.
std::vector<double> refined_grid(const std::vector<double>& points, Index columns, CurveWrap wrap,
                                 bool rows_first) {
  const auto rows = static_cast<Index>(points.size() / 3 / columns);
  const auto longer = [&](Index n) { return wrap == CurveWrap::periodic ? 2 * n : 2 * n - 1; };
  if (rows_first) {
    const std::vector<double> wide = refined_rows(points, columns, wrap);
    return transposed(refined_rows(transposed(wide, longer(columns)), rows, wrap), longer(rows));
  }
  const std::vector<double> tall =
      transposed(refined_rows(transposed(points, columns), rows, wrap), longer(rows));
  return refined_rows(tall, columns, wrap);
}

ControlMesh grid_of(Index columns, Index rows, bool closed) {
  std::vector<shapes::Point> points;
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i)
      points.push_back({0.3 * i, 0.2 * j, std::sin(1.7 * i) + std::cos(2.3 * j)});
  ControlMesh mesh = shapes::mesh_of(points, {});
  for (Index j = 0; j + (closed ? 0 : 1) < rows; ++j)
    for (Index i = 0; i + (closed ? 0 : 1) < columns; ++i) {
      const Index right = (i + 1) % columns, above = (j + 1) % rows;
      mesh.face_vertex_counts.push_back(4);
      mesh.face_vertex_indices.insert(
          mesh.face_vertex_indices.end(),
          {j * columns + i, j * columns + right, above * columns + right, above * columns + i});
    }
  return mesh;
}

TEST(KobbeltByRows, is_rows_of_four_point_curves_on_grids_in_either_order) {
  for (const bool closed : {false, true})
    for (const auto& [columns, rows] : {std::pair{5u, 4u}, {7u, 6u}, {3u, 3u}}) {
      const ControlMesh mesh = grid_of(columns, rows, closed);
      const CurveWrap wrap = closed ? CurveWrap::periodic : CurveWrap::pinned;
      KobbeltSurface surface(mesh);
      std::vector<double> grid = mesh.points;
      Index width = columns;
      for (int step = 0; step < 2; ++step) {
        const std::vector<double> one = refined_grid(grid, width, wrap, true),
                                  other = refined_grid(grid, width, wrap, false);
        ASSERT_EQ(one.size(), other.size());
        for (std::size_t k = 0; k < one.size(); ++k) ASSERT_NEAR(one[k], other[k], 1e-14);
        grid = one;
        width = closed ? 2 * width : 2 * width - 1;
        surface.refine();
        ASSERT_EQ(surface.points.size(), grid.size());
        for (std::size_t k = 0; k < grid.size(); k += 3) ASSERT_LT(surface.nearest(&grid[k]), 1e-14);
      }
    }
}

TEST(KobbeltByRows, reproduces_bicubics_on_regular_nets) {
  ControlMesh mesh = grid_of(9, 9, false);
  const auto cubic = [](double x, double y) {
    return (1 + x - 0.2 * x * x * x) * (0.1 * y * y * y - y * y + 2) / 10;
  };
  for (std::size_t k = 0; k < mesh.points.size(); k += 3) {
    const double x = static_cast<double>(k / 3 % 9), y = static_cast<double>(k / 3 / 9);
    mesh.points[k] = x;
    mesh.points[k + 1] = y;
    mesh.points[k + 2] = cubic(x, y);
  }
  KobbeltSurface surface(mesh);
  surface.refine();
  int inside = 0;
  for (std::size_t k = 0; k < surface.points.size(); k += 3) {
    const double x = surface.points[k], y = surface.points[k + 1];
    if (std::min(x, y) < 1 || std::max(x, y) > 7) continue;
    ++inside;
    EXPECT_NEAR(surface.points[k + 2], cubic(x, y), 1e-11 * std::max(1.0, std::abs(cubic(x, y))));
  }
  EXPECT_EQ(inside, 169);
}

TEST(KobbeltTangents, are_halved_by_every_step_and_exact_for_cubics) {
  ControlMesh mesh = grid_of(9, 9, false);
  for (std::size_t k = 0; k < mesh.points.size(); k += 3) {
    const double x = mesh.points[k] = static_cast<double>(k / 3 % 9),
                 y = mesh.points[k + 1] = static_cast<double>(k / 3 / 9);
    mesh.points[k + 2] = 0.1 * x * x * x - y * y * y / 7 + x * y;
  }
  KobbeltSurface surface(mesh);
  for (int depth = 0; depth < 2; ++depth) {
    const std::vector<double> tangents = surface.applied(tangent_rows(Kobbelt{}, surface.level, false));
    const double x = surface.points[3 * 40], y = surface.points[3 * 40 + 1],
                 h = depth == 0 ? 1 : 0.5;  // the middle
    for (const std::size_t row : {80u, 81u}) {
      const double* t = &tangents[3 * row];
      EXPECT_NEAR(std::hypot(t[0], t[1]), h, 1e-13);
      EXPECT_NEAR(t[2], t[0] * (0.3 * x * x + y) + t[1] * (x - 3 * y * y / 7), 1e-12);
    }
    EXPECT_GT(tangents[3 * 80] * tangents[3 * 81 + 1] - tangents[3 * 80 + 1] * tangents[3 * 81], 0);
    surface.refine();
  }
}

// --- Borders, order and size ------------------------------------------------------------------------------------

TEST(KobbeltByRows, has_the_four_point_curve_as_border) {
  ControlMesh mesh = flat_disk(5);
  for (std::size_t k = 2; k < mesh.points.size(); k += 3) mesh.points[k] = std::sin(static_cast<double>(k));
  mesh.interpolate_boundary = BoundaryInterpolation::edge_only;
  KobbeltSurface surface(mesh);
  for (Index l = 1; l <= 3; ++l) {
    surface.refine();
    ControlCurves curve;
    curve.points.assign(mesh.points.begin() + 3, mesh.points.end());
    curve.wrap = CurveWrap::periodic;
    curve.basis = FourPoint{};
    const auto refined = refine<double>(curve, {.level = l}, {});
    for (std::size_t k = 0; k < refined->points.size(); k += 3)
      EXPECT_LT(surface.nearest(&refined->points[k]), 1e-14);
  }
}

TEST(KobbeltByRows, does_not_depend_on_how_points_and_faces_are_numbered) {
  for (const auto& [name, mesh] : kobbelt_meshes()) {
    const Renumbered other = renumbered(mesh, 3);
    KobbeltSurface a(mesh), b(other.mesh);
    const Adjacency from = a.level.faces, to = b.level.faces;
    a.refine();
    b.refine();
    for (Index h = 0; h < from.half_edge_count(); ++h) {
      const Index f = h / 4, there = 4 * other.face_at[f] + (h % 4 + 4 - other.turned[f]) % 4;
      const Index on_edge[] = {from.vertex_count() + from.half_edge_edge(h),
                               to.vertex_count() + to.half_edge_edge(there)};
      const Index in_face[] = {from.vertex_count() + from.edge_count() + f,
                               to.vertex_count() + to.edge_count() + other.face_at[f]};
      for (const auto& [v, w] : {std::pair{on_edge[0], on_edge[1]}, {in_face[0], in_face[1]}})
        for (Index axis = 0; axis < 3; ++axis)
          ASSERT_NEAR(a.points[3 * v + axis], b.points[3 * w + axis], 1e-13) << name << ' ' << h;
    }
  }
}

TEST(KobbeltByRows, keeps_a_plane_a_plane) {
  for (auto [name, mesh] : kobbelt_meshes()) {
    for (std::size_t k = 0; k < mesh.points.size(); k += 3)
      mesh.points[k + 2] = 1 + 2 * mesh.points[k] - 3 * mesh.points[k + 1];
    KobbeltSurface surface(mesh);
    surface.refine();
    surface.refine();
    for (std::size_t k = 0; k < surface.points.size(); k += 3)
      ASSERT_NEAR(surface.points[k + 2], 1 + 2 * surface.points[k] - 3 * surface.points[k + 1], 1e-12)
          << name;
  }
}

// Every edge at a pole sees all others, and so does every face.
TEST(KobbeltByRows, are_linear_in_the_faces_of_a_pole) {
  const ControlMesh mesh = flat_disk(100000);
  const Level level = base_level(mesh);
  const StepRows rows = step_rows(Kobbelt{}, level, false);
  EXPECT_EQ(rows.sums.row_count(), 2);
  EXPECT_LT(rows.rows.columns.size() + rows.sums.columns.size(), Count{20} * level.faces.half_edge_count());
}

TEST(LineRows, stop_when_the_budget_says_so) {
  Level level = base_level(grid_of(40, 40, true));
  level = next_level(level, Split::quads, CreaseMethod::uniform);
  Budget budget;
  budget.deadline = Budget::Clock::now();
  EXPECT_FALSE(stoppable(budget, [&](const Pace& pace) { step_rows(Kobbelt{}, level, false, pace); }).ok());
}

}  // namespace
}  // namespace subdivd::plain

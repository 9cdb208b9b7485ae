// The schemes that OpenSubdiv does not have, beside CGAL and OpenMesh: every point of theirs is one of ours. They number
// in ways of their own, so points are found by place; no two coincide on these shapes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/engine/plain/centroid_rows.h"
#include "core/engine/plain/corner_rows.h"
#include "core/engine/plain/ring_rows.h"
#include "core/schemes/butterfly.h"
#include "core/schemes/doo_sabin.h"
#include "core/schemes/sqrt3.h"
#include "tests/core/engine/levels.h"
#include "tests/core/engine/peers.h"
#include "tests/shapes/build.h"
#include "tests/shapes/polygons.h"

namespace subdivd::plain {
namespace {

// The largest distance from a point of theirs to the nearest of ours that is nearest to no other; infinite when the
// numbers of points differ.
double deviation(const std::vector<double>& theirs, const std::vector<double>& ours) {
  if (theirs.size() != ours.size()) return std::numeric_limits<double>::infinity();
  std::vector<bool> taken(ours.size() / 3);
  double largest = 0;
  for (std::size_t k = 0; k < theirs.size(); k += 3) {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < ours.size(); j += 3) {
      const double d =
          std::hypot(theirs[k] - ours[j], theirs[k + 1] - ours[j + 1], theirs[k + 2] - ours[j + 2]);
      if (d < least && !taken[j / 3]) {
        least = d;
        nearest = j;
      }
    }
    taken[nearest / 3] = true;
    largest = std::max(largest, least);
  }
  return largest;
}

bool is_closed(const ControlMesh& mesh) {
  const Level level = base_level(mesh);
  return std::ranges::none_of(level.sharpness.edges, is_sharp) &&
         std::ranges::none_of(level.sharpness.vertices, is_sharp) && mesh.points.size() < 300;
}

bool has_valence_two(const ControlMesh& mesh) {
  const Level level = base_level(mesh);
  for (Index v = 0; v < level.faces.vertex_count(); ++v)
    if (level.faces.vertex_corners(v).size() < 3) return true;
  return false;
}

constexpr double kTolerance = 1e-13;  // of the diagonal; both compute in double

TEST(DooSabinByRows, is_cgals_on_closed_meshes) {
  int compared = 0;
  for (const auto& [name, mesh] : shapes::polygon_shapes()) {
    if (!is_closed(mesh) || has_valence_two(mesh)) continue;
    Level level = base_level(mesh);
    std::vector<double> points = mesh.points;
    for (int steps = 1; steps <= 2; ++steps) {
      CornerSplit split = split_corners(level);
      points = apply<double>(step_rows(DooSabin{}, level, split), std::span<const double>(points), 3);
      level = next_level(std::move(split));
      EXPECT_LT(deviation(peers::cgal_doo_sabin(mesh, steps), points), kTolerance * diagonal(mesh.points))
          << name << ' ' << steps;
    }
    ++compared;
  }
  EXPECT_GE(compared, 6);
}

TEST(DooSabinByRows, is_cgals_where_borders_are_open) {
  for (auto [name, mesh] : shapes::polygon_shapes()) {
    if (name != "grid_border_none" && name != "pole_of_5_quads" && name != "pole_of_8_triangles") continue;
    Level level = base_level(mesh);
    open_borders(level, mesh);
    const CornerSplit split = split_corners(level);
    const std::vector<double> points =
        apply<double>(step_rows(DooSabin{}, level, split), std::span<const double>(mesh.points), 3);
    EXPECT_LT(deviation(peers::cgal_doo_sabin(mesh, 1), points), kTolerance * diagonal(mesh.points)) << name;
  }
}

// CGAL has the same borders (its vertices of one face are no corners).
TEST(Sqrt3ByRows, is_cgals_with_and_without_borders) {
  int compared = 0;
  for (auto [name, mesh] : shapes::all_shapes()) {
    mesh.corner_indices.clear();
    mesh.corner_sharpnesses.clear();
    mesh.crease_indices.clear();
    mesh.crease_lengths.clear();
    mesh.crease_sharpnesses.clear();
    mesh.interpolate_boundary = BoundaryInterpolation::edge_only;
    const Level base = base_level(mesh);
    bool has_free_points = false;
    for (Index v = 0; v < base.faces.vertex_count(); ++v)
      has_free_points |= base.faces.vertex_corners(v).empty();
    if (has_free_points || mesh.points.size() > 150 ||
        std::ranges::any_of(base.sharpness.vertices, is_sharp) || !is_manifold(base.faces))
      continue;
    Level level = base;
    std::vector<double> points = mesh.points;
    for (int steps = 1; steps <= 3; ++steps) {
      points = apply<double>(step_rows(Sqrt3{}, level, false), std::span<const double>(points), 3);
      level = next_level_by_centroids(level);
      EXPECT_LT(deviation(peers::cgal_sqrt3(mesh, steps), points), kTolerance * diagonal(mesh.points))
          << name << ' ' << steps;
    }
    ++compared;
  }
  EXPECT_GE(compared, 20);
}

TEST(Sqrt3ByRows, is_openmeshs_on_closed_meshes) {
  int compared = 0;
  for (const auto& [name, mesh] : shapes::closed_shapes()) {
    if (!is_closed(mesh) || has_valence_two(mesh)) continue;
    Level level = base_level(mesh);
    std::vector<double> points = mesh.points;
    for (int steps = 1; steps <= 3; ++steps) {
      points = apply<double>(step_rows(Sqrt3{}, level, false), std::span<const double>(points), 3);
      level = next_level_by_centroids(level);
      EXPECT_LT(deviation(peers::openmesh_sqrt3(mesh, steps), points), kTolerance * diagonal(mesh.points))
          << name << ' ' << steps;
    }
    ++compared;
  }
  EXPECT_GE(compared, 6);
}

double deviation_of_butterflies(const ControlMesh& mesh, int steps) {
  Level level = base_level(mesh);
  std::vector<double> points = mesh.points;
  for (int step = 0; step < steps; ++step) {
    points = apply<double>(step_rows(Butterfly{}, level, false), std::span<const double>(points), 3);
    level = next_level(level, Split::triangles, CreaseMethod::uniform);
  }
  return deviation(peers::openmesh_butterfly(mesh, steps), points);
}

TEST(ButterflyByRows, is_openmeshs_on_closed_meshes) {
  int compared = 0;
  for (const auto& [name, mesh] : shapes::closed_shapes()) {
    if (!is_closed(mesh) || has_valence_two(mesh)) continue;
    for (int steps = 1; steps <= 2; ++steps)
      EXPECT_LT(deviation_of_butterflies(mesh, steps), kTolerance * diagonal(mesh.points))
          << name << ' ' << steps;
    ++compared;
  }
  EXPECT_GE(compared, 6);
}

// Its borders inside are ours where they are regular: a tube has six edges inside and four on its ends.
TEST(ButterflyByRows, is_openmeshs_at_regular_borders) {
  const ControlMesh mesh = shapes::tube(7, 5);
  for (int steps = 1; steps <= 2; ++steps)
    EXPECT_LT(deviation_of_butterflies(mesh, steps), kTolerance * diagonal(mesh.points)) << steps;
}

}  // namespace
}  // namespace subdivd::plain

// The plain engine's step into quads, beside OpenSubdiv: every point of every level.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/engine/plain/level.h"
#include "core/engine/plain/mask_rows.h"
#include "core/mesh/topology.h"
#include "core/oracle/far_polygons.h"
#include "core/schemes/bilinear.h"
#include "core/schemes/catmull_clark.h"
#include "tests/core/engine/levels.h"
#include "tests/shapes/build.h"
#include "tests/shapes/polygons.h"
#include "tests/shapes/random.h"

namespace subdivd::plain {
namespace {

// The largest distance between our points and Far's at any corner of the levels up to `depth`.
template <class Scheme>
double deviation(const ControlMesh& mesh, const Scheme& scheme, const oracle::FarPolygonRules& rules,
                 Index depth) {
  const auto far = oracle::far_refine_polygons(mesh, rules, depth);
  if (!far.ok()) {
    ADD_FAILURE() << far.error().message;
    return 0;
  }
  Level level = base_level(mesh, rules.crease_method);
  std::vector<double> points = mesh.points;
  double largest = 0;
  for (Index k = 0;; ++k) {
    const oracle::FarPolygons& theirs = (*far)[k];
    EXPECT_EQ(level.faces.half_edge_count(), theirs.corners.size());
    if (level.faces.half_edge_count() != theirs.corners.size())
      return std::numeric_limits<double>::infinity();
    for (Index h = 0; h < level.faces.half_edge_count(); ++h)
      for (Index axis = 0; axis < 3; ++axis)
        largest = std::max(largest, std::abs(points[3 * level.faces.corner_vertex(h) + axis] -
                                             theirs.points[3 * theirs.corners[h] + axis]));
    if (k == depth) return largest;
    points =
        apply<double>(rows_of(scheme, rules.crease_method, level, false), std::span<const double>(points), 3);
    level = next_level(level, Split::quads, rules.crease_method);
  }
}

constexpr double kTolerance = 1e-12;  // of the diagonal

TEST(CatmullClarkByRows, is_opensubdivs_on_every_shape) {
  for (const auto& [name, mesh] : shapes::polygon_shapes())
    for (const CreaseMethod method : {CreaseMethod::uniform, CreaseMethod::chaikin})
      for (const TriangleRule triangles : {TriangleRule::catmull_clark, TriangleRule::smooth}) {
        const Index depth = mesh.face_vertex_indices.size() > 1000 ? 2 : 4;
        EXPECT_LT(deviation(mesh, CatmullClark{triangles}, {method, false, triangles}, depth),
                  kTolerance * diagonal(mesh.points))
            << name << ' ' << static_cast<int>(method) << ' ' << static_cast<int>(triangles);
      }
}

TEST(BilinearByRows, is_opensubdivs_on_every_shape) {
  for (const auto& [name, mesh] : shapes::polygon_shapes())
    EXPECT_LT(deviation(mesh, Bilinear{}, {.bilinear = true}, 2), kTolerance * diagonal(mesh.points)) << name;
}

TEST(CatmullClarkByRows, is_opensubdivs_on_random_polygons) {
  for (Index seed = 1; seed <= 150; ++seed) {
    const ControlMesh mesh = shapes::with_joined_faces(shapes::random_mesh(seed), 4 + seed % 6, seed);
    const auto method = seed % 2 == 0 ? CreaseMethod::uniform : CreaseMethod::chaikin;
    EXPECT_LT(deviation(mesh, CatmullClark{}, {.crease_method = method}, 3),
              kTolerance * diagonal(mesh.points))
        << seed;
  }
}

TEST(CatmullClarkByRows, have_weights_that_sum_to_one) {
  for (const auto& [name, mesh] : shapes::polygon_shapes()) {
    const Level level = base_level(mesh, CreaseMethod::uniform);
    const SparseRows rows = written_out(rows_of(CatmullClark{}, CreaseMethod::uniform, level, false));
    ASSERT_EQ(rows.row_count(),
              Count{level.faces.vertex_count()} + level.faces.edge_count() + level.faces.face_count());
    for (Count r = 0; r < rows.row_count(); ++r) {
      double sum = 0;
      for (Count k = rows.offsets[r]; k < rows.offsets[r + 1]; ++k) sum += rows.weights[k];
      ASSERT_NEAR(sum, 1, 1e-12) << name << ' ' << r;
      std::vector<Index> columns(rows.columns.begin() + static_cast<std::ptrdiff_t>(rows.offsets[r]),
                                 rows.columns.begin() + static_cast<std::ptrdiff_t>(rows.offsets[r + 1]));
      std::ranges::sort(columns);
      ASSERT_EQ(std::ranges::adjacent_find(columns), columns.end()) << name << ' ' << r << ": a column twice";
    }
  }
}

}  // namespace
}  // namespace subdivd::plain

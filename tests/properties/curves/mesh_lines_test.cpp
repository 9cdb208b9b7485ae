// A border of a mesh, and an infinitely sharp crease through one, are the cubic curve of their own points:
// refined points, limits and tangents, whatever stands beside them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/lattice/numbering.h"
#include "core/mesh/topology.h"
#include "core/refine/refine.h"
#include "tests/properties/curves/mesh_lines.h"

namespace subdivd::testing {
namespace {

constexpr Index kLevels = 5;
// Of the extent. The weights are the same numbers on both sides, added in another order (measured: 7e-17).
// A weight that is off by 1e-13 shows.
constexpr double kTolerance = 1e-15;

class LineOfAMesh : public ::testing::TestWithParam<MeshLine> {};

INSTANTIATE_TEST_SUITE_P(Every, LineOfAMesh, ::testing::ValuesIn(all_mesh_lines()),
                         [](const auto& line) { return line.param.name; });

struct Refinement {
  RefinedMesh<double> mesh;
  RefinedCurves<double> curve;
  std::vector<Index> vertices;  // of the mesh, per point of the curve
};

Refinement refined(const MeshLine& line, Index level) {
  RefineOptions options;
  options.level = level;
  options.limit = options.tangents = true;
  auto mesh = refine<double>(line.mesh, options, Budget{});
  auto curve = refine<double>(curve_of(line), {.level = level, .limit = true, .tangents = true}, Budget{});
  if (!mesh || !curve) {
    ADD_FAILURE() << (mesh ? curve.error() : mesh.error()).message;
    return {};
  }
  const Topology<Triangles> topology(static_cast<Index>(line.mesh.point_count()),
                                     Triangles(line.mesh.face_vertex_indices));
  const Numbering numbering(topology, level);
  Refinement both{std::move(*mesh), std::move(*curve), {}};
  for (const Provenance& place : places_along(line, level))
    both.vertices.push_back(numbering.vertex(place.face, place.i, place.j));
  return both;
}

TEST(MeshLines, are_of_every_sort) {
  for (const auto& lines : {border_lines(), crease_lines()})
    for (const bool closed : {false, true})
      EXPECT_GE(std::ranges::count(lines, closed, &MeshLine::closed), 8);
}

TEST_P(LineOfAMesh, passes_the_door) {
  const auto checked = GetParam().mesh.check();
  EXPECT_TRUE(checked.ok()) << checked.error().message;
  EXPECT_TRUE(curve_of(GetParam()).check().ok());
}

TEST_P(LineOfAMesh, has_the_points_and_limits_of_the_cubic_curve) {
  const double tolerance = kTolerance * extent(GetParam());
  for (Index level = 0; level <= kLevels; ++level) {
    const auto [mesh, curve, vertices] = refined(GetParam(), level);
    ASSERT_EQ(curve.points.size(), 3 * vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_NEAR(mesh.points[3 * vertices[i] + k], curve.points[3 * i + k], tolerance)
            << "point " << i << " of level " << level;
        ASSERT_NEAR(mesh.limit_points[3 * vertices[i] + k], curve.limit_points[3 * i + k], tolerance)
            << "limit " << i << " of level " << level;
      }
  }
}

// The mesh's tangent along a crease is the difference of the neighbours, twice the curve's per step, forth or
// back. Corners have tangents along their edges or none at all.
TEST_P(LineOfAMesh, has_the_tangents_of_the_cubic_curve) {
  const double tolerance = 4 * kTolerance * extent(GetParam());
  const bool closed = GetParam().closed;
  for (Index level = 0; level <= kLevels; ++level) {
    const auto [mesh, curve, vertices] = refined(GetParam(), level);
    for (std::size_t i = closed ? 0 : 1; i + (closed ? 0 : 1) < vertices.size(); ++i) {
      double forth = 0, back = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double step = std::ldexp(curve.tangents[3 * i + k], 1 - static_cast<int>(level));
        forth = std::max(forth, std::abs(mesh.tangents_u[3 * vertices[i] + k] - step));
        back = std::max(back, std::abs(mesh.tangents_u[3 * vertices[i] + k] + step));
      }
      ASSERT_LE(std::min(forth, back), tolerance) << "point " << i << " of level " << level;
    }
  }
}

}  // namespace
}  // namespace subdivd::testing

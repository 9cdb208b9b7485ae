// Our cubic curves against Far, which knows surfaces only: its borders and its creases are such curves.
// (A strip of triangles of their own, every wrap, width and depth: tests/core/oracle/verify_curves_test.cpp.)

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "core/oracle/far.h"
#include "core/oracle/verify.h"
#include "tests/properties/curves/mesh_lines.h"
#include "tests/shapes/random.h"

namespace subdivd::differential {
namespace {

using testing::MeshLine;

constexpr Index kLevels = 5;
// Of the extent. The weights are the same numbers, and so far the answers are the same bits.
constexpr double kTolerance = 1e-15, kSingleTolerance = 5e-7;

class FarLine : public ::testing::TestWithParam<MeshLine> {};

INSTANTIATE_TEST_SUITE_P(Every, FarLine, ::testing::ValuesIn(testing::all_mesh_lines()),
                         [](const auto& line) { return line.param.name; });

// Far's vertices along the line, found by the places of its face corners.
template <class Real>
std::vector<Index> vertices_along(const MeshLine& line, const oracle::FarLevel<Real>& far) {
  std::map<std::tuple<Index, Index, Index>, Index> at;
  for (std::size_t corner = 0; corner < far.faces.size(); ++corner)
    at[{far.base_faces[corner / 3], far.corners[corner].i, far.corners[corner].j}] = far.faces[corner];
  std::vector<Index> vertices;
  for (const Provenance& place : testing::places_along(line, far.level))
    vertices.push_back(at.at({place.face, place.i, place.j}));
  return vertices;
}

// The largest difference of a coordinate, of points and of limits.
template <class Real>
std::array<double, 2> difference(const MeshLine& line, Index level) {
  RefineOptions options;
  options.level = level;
  options.limit = true;
  const auto far = oracle::far_refine<Real>(line.mesh, options, Budget{});
  const auto curve = refine<Real>(testing::curve_of(line), {.level = level, .limit = true}, Budget{});
  if (!far || !curve) {
    ADD_FAILURE() << (far ? curve.error() : far.error()).message;
    return {};
  }
  const std::vector<Index> vertices = vertices_along(line, *far);
  EXPECT_EQ(curve->points.size(), 3 * vertices.size());
  std::array<double, 2> worst{};
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t theirs = 3 * std::size_t{vertices[i]} + k;
      worst[0] = std::max(worst[0], std::abs(double{far->points[theirs]} - double{curve->points[3 * i + k]}));
      worst[1] = std::max(
          worst[1], std::abs(double{far->limit_points[theirs]} - double{curve->limit_points[3 * i + k]}));
    }
  return worst;
}

TEST_P(FarLine, has_the_points_and_limits_of_our_curve_in_double_precision) {
  for (Index level = 1; level <= kLevels; ++level) {
    const auto [points, limits] = difference<double>(GetParam(), level);
    EXPECT_LE(points, kTolerance * extent(GetParam())) << "level " << level;
    EXPECT_LE(limits, kTolerance * extent(GetParam())) << "level " << level;
  }
}

TEST_P(FarLine, has_the_points_and_limits_of_our_curve_in_single_precision) {
  for (Index level = 1; level <= kLevels; ++level) {
    const auto [points, limits] = difference<float>(GetParam(), level);
    EXPECT_LE(points, kSingleTolerance * extent(GetParam())) << "level " << level;
    EXPECT_LE(limits, kSingleTolerance * extent(GetParam())) << "level " << level;
  }
}

// Random points, counts and wraps, through the report that callers get.
TEST(RandomCurves, agree_with_far) {
  constexpr CurveWrap kWraps[] = {CurveWrap::nonperiodic, CurveWrap::periodic, CurveWrap::pinned};
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    shapes::Random random(seed);
    ControlCurves curves;
    curves.wrap = kWraps[random.below(3)];
    curves.width = 1 + random.below(4);
    for (Index curve = 0, bodies = 1 + random.below(3); curve < bodies; ++curve)
      curves.vertex_counts.push_back(least_points(curves) + random.below(12));
    for (const Index count : curves.vertex_counts)
      for (Index k = 0; k < count * curves.width; ++k) curves.points.push_back(random.centred());
    const CurveOptions options{.level = 1 + random.below(kLevels), .limit = true};
    const auto in_double = oracle::verify<double>(curves, options, Budget{});
    const auto in_single = oracle::verify<float>(curves, options, Budget{});
    ASSERT_TRUE(in_double.ok() && in_single.ok()) << "seed " << seed;
    EXPECT_EQ(both(in_double->verdict, in_single->verdict), oracle::Verdict::passed) << "seed " << seed;
  }
}

}  // namespace
}  // namespace subdivd::differential

#include <gtest/gtest.h>

#include <atomic>

#include "core/oracle/verify.h"
#include "tests/core/oracle/surface_fixtures.h"

namespace subdivd::oracle::testing {
namespace {

template <class Real>
SurfaceReport verified(const ControlPatch& patch, const PatchOptions& options) {
  const auto report = verify<Real>(patch, options, Budget{});
  EXPECT_TRUE(report.ok()) << name_of(patch) << (report.ok() ? "" : ": " + report.error().message);
  return report.ok() ? *report : SurfaceReport{};
}

template <class Real>
void expect_passes(const ControlPatch& patch, const PatchOptions& options) {
  const SurfaceReport report = verified<Real>(patch, options);
  EXPECT_EQ(report.verdict, Verdict::passed) << name_of(patch) << ", seed " << kSeed;
  ASSERT_EQ(report.levels.size(), std::max<Index>(1, options.level));
  for (const LevelReport& level : report.levels) {
    EXPECT_EQ(missed(level), "") << name_of(patch) << ", level " << level.level;
    EXPECT_EQ(level.deviations.size(), 1u + (options.limit ? 1 : 0) + (options.normals ? 1 : 0));
    EXPECT_EQ(find(level, "points").compared, level.vertices);
  }
}

Error refusal(const ControlPatch& patch, const PatchOptions& options, const Budget& budget = {}) {
  const auto report = verify<double>(patch, options, budget);
  EXPECT_FALSE(report.ok());
  return report.ok() ? Error{} : report.error();
}

// --- What agrees ------------------------------------------------------------------------------------------

TEST(VerifySurfaces, passes_every_pair_of_wraps_and_size) {
  for_each_pair_of_wraps([](CurveWrap u, CurveWrap v) {
    for (const auto& [more_u, more_v] : {std::pair{0u, 0u}, {1u, 0u}, {0u, 3u}, {2u, 1u}, {5u, 4u}}) {
      const ControlPatch patch = random_patch(u, fewest(u) + more_u, v, fewest(v) + more_v);
      for (const Index level : {0u, 4u}) {
        expect_passes<double>(patch, frames(level));
        expect_passes<float>(patch, frames(level));
      }
    }
  });
}

TEST(VerifySurfaces, compares_every_limit_and_normal_of_the_surface) {
  for_each_pair_of_wraps([](CurveWrap u, CurveWrap v) {
    const ControlPatch patch = hill(u, 5, v, 6);
    for (const LevelReport& level : verified<double>(patch, frames(3)).levels)
      for (const char* quantity : {"limitPoints", "normals"}) {
        const Count beyond = points_beyond(patch, level.level);
        EXPECT_EQ(find(level, quantity).excepted, beyond) << name_of(patch) << quantity;
        EXPECT_EQ(find(level, quantity).compared, level.vertices - beyond) << name_of(patch) << quantity;
      }
  });
}

TEST(VerifySurfaces, passes_points_of_every_width) {
  for (Index width = 1; width <= kMaxPatchWidth; ++width)
    for_each_pair_of_wraps([&](CurveWrap u, CurveWrap v) {
      expect_passes<double>(random_patch(u, 5, v, 4, width), {.level = 2, .limit = true});
    });
}

TEST(VerifySurfaces, passes_a_torus_at_level_five) {
  expect_passes<double>(torus(8, 6), frames(5));
  expect_passes<float>(torus(8, 6), frames(5));
  const SurfaceReport report = verified<double>(torus(8, 6), frames(5));
  EXPECT_EQ(report.levels.back().vertices, 8u * 6 * 1024);
  EXPECT_EQ(report.levels.back().faces, 8u * 6 * 1024);
  EXPECT_EQ(find(report.levels.back(), "normals").compared, 8u * 6 * 1024);
}

TEST(VerifySurfaces, passes_huge_and_tiny_surfaces) {
  for_each_pair_of_wraps([](CurveWrap u, CurveWrap v) {
    for (const double size : {1e-150, 1e150}) {
      ControlPatch patch = hill(u, 5, v, 5);
      for (double& x : patch.points) x *= size;
      expect_passes<double>(patch, frames(3));
      EXPECT_EQ(find(verified<double>(patch, frames(1)).levels[0], "normals").excepted,
                points_beyond(patch, 1));
    }
    for (const double size : {1e-30, 1e30}) {
      ControlPatch patch = hill(u, 5, v, 5);
      for (double& x : patch.points) x *= size;
      expect_passes<float>(patch, frames(3));
    }
  });
}

TEST(VerifySurfaces, level_zero_compares_the_limits_of_the_control_points) {
  const SurfaceReport report =
      verified<double>(hill(CurveWrap::pinned, 4, CurveWrap::periodic, 5), frames(0));
  ASSERT_EQ(report.levels.size(), 1u);
  EXPECT_EQ(report.levels[0].level, 0u);
  EXPECT_EQ(find(report.levels[0], "limitPoints").compared, 20u);
  EXPECT_EQ(find(report.levels[0], "normals").compared, 20u);
  EXPECT_EQ(report.verdict, Verdict::passed);
}

TEST(VerifySurfaces, compares_limits_and_normals_only_when_asked) {
  const ControlPatch patch = hill(CurveWrap::pinned, 4, CurveWrap::pinned, 4);
  expect_passes<double>(patch, {.level = 2});
  expect_passes<double>(patch, {.level = 2, .limit = true});
  expect_passes<double>(patch, {.level = 2, .normals = true});
}

TEST(VerifySurfaces, compares_quads_whatever_faces_were_asked_for) {
  const ControlPatch patch = hill(CurveWrap::pinned, 4, CurveWrap::periodic, 4);
  for (const PatchFaces faces : {PatchFaces::none, PatchFaces::triangles, PatchFaces::quads})
    EXPECT_EQ(verified<double>(patch, frames(1, faces)).levels[0].faces, 6u * 8);
}

TEST(VerifySurfaces, says_how_it_compared) {
  const SurfaceReport report =
      verified<float>(hill(CurveWrap::nonperiodic, 5, CurveWrap::periodic, 5), frames(2));
  EXPECT_EQ(report.name, "patch");
  EXPECT_EQ(report.precision, "single");
  ASSERT_EQ(report.remarks.size(), 4u);
  EXPECT_TRUE(report.remarks[0].starts_with("u is nonperiodic"));
  EXPECT_TRUE(report.remarks[1].starts_with("v is periodic"));
  EXPECT_TRUE(report.remarks[2].starts_with("limitPoints: left out"));
  EXPECT_TRUE(report.remarks[3].starts_with("normals: left out"));
}

TEST(VerifySurfaces, widens_the_tolerance_far_from_the_origin_and_says_so) {
  ControlPatch patch = hill(CurveWrap::pinned, 5, CurveWrap::pinned, 5);
  for (double& x : patch.points) x += 1e6;
  const SurfaceReport report = verified<double>(patch, frames(3));
  EXPECT_EQ(report.verdict, Verdict::passed);
  EXPECT_NE(report.remarks.back().find("origin"), std::string::npos);
}

// --- Where Far is no witness ------------------------------------------------------------------------------

TEST(VerifySurfaces, leaves_out_normals_that_a_single_point_does_not_have) {
  ControlPatch patch = random_patch(CurveWrap::pinned, 4, CurveWrap::periodic, 4);
  for (std::size_t k = 0; k < patch.points.size(); ++k) patch.points[k] = k % 3 == 0 ? 0.1 : 0.7;
  for (const LevelReport& level : verified<double>(patch, frames(3)).levels) {
    EXPECT_EQ(level.verdict(), Verdict::nothing_compared);
    EXPECT_EQ(find(level, "points").verdict, Verdict::passed);
    EXPECT_EQ(find(level, "normals").compared, 0u);
    EXPECT_NE(find(level, "normals").exception.find("degenerate"), std::string::npos);
  }
}

// A border drawn together into a point, as a sphere's pole: nothing but the pole is left out.
TEST(VerifySurfaces, leaves_out_the_normals_of_a_pole_and_no_others) {
  ControlPatch patch = hill(CurveWrap::pinned, 6, CurveWrap::pinned, 5);
  for (Index i = 0; i < 6; ++i) std::copy_n(patch.points.begin(), 3, patch.points.begin() + 3 * i);
  for (const LevelReport& level : verified<double>(patch, frames(3)).levels) {
    EXPECT_EQ(level.verdict(), Verdict::passed);
    EXPECT_EQ(find(level, "normals").excepted, (5u << level.level) + 1);
  }
}

TEST(VerifySurfaces, a_straight_line_has_no_normals) {
  ControlPatch patch = random_patch(CurveWrap::pinned, 5, CurveWrap::pinned, 5);
  for (Index p = 0; p < 25; ++p) patch.points[3 * p + 1] = patch.points[3 * p + 2] = patch.points[3 * p];
  for (const LevelReport& level : verified<double>(patch, frames(3)).levels) {
    EXPECT_EQ(level.verdict(), Verdict::nothing_compared);
    EXPECT_EQ(find(level, "points").verdict, Verdict::passed);
    EXPECT_EQ(find(level, "normals").compared, 0u);
  }
}

// --- What is refused --------------------------------------------------------------------------------------

TEST(VerifySurfaces, refuses_degrees_that_far_does_not_know) {
  ControlPatch patch = random_patch(CurveWrap::pinned, 5, CurveWrap::pinned, 5);
  patch.u_degree = 2;
  EXPECT_EQ(refusal(patch, frames(1)).code, ErrorCode::unsupported);
  EXPECT_EQ(refusal(patch, frames(1)).where, Path{"uDegree"});
  patch.u_degree = 3, patch.v_degree = 2;
  EXPECT_EQ(refusal(patch, frames(1)).code, ErrorCode::unsupported);
  EXPECT_EQ(refusal(patch, frames(1)).where, Path{"vDegree"});
}

TEST(VerifySurfaces, refuses_too_much_memory_before_any_work) {
  Budget budget;
  budget.max_bytes = 1000000;
  budget.deadline = Budget::Clock::now();
  const Error error = refusal(random_patch(CurveWrap::pinned, 5, CurveWrap::pinned, 5), frames(6), budget);
  EXPECT_EQ(error.code, ErrorCode::too_large);
  EXPECT_GT(error.predicted, error.allowed);
  EXPECT_EQ(error.allowed, 1000000u);
}

TEST(VerifySurfaces, refuses_more_corners_than_far_numbers) {
  Budget impatient;  // nothing of that size is begun, should the refusal fail
  impatient.deadline = Budget::Clock::now();
  const Error error =
      refusal(random_patch(CurveWrap::periodic, 6, CurveWrap::periodic, 6), frames(12), impatient);
  EXPECT_EQ(error.code, ErrorCode::too_large);
  EXPECT_EQ(error.allowed, Count{std::numeric_limits<int>::max()});
  EXPECT_EQ(error.predicted, Count{6 * 6} * 4096 * 4096 * 5);
}

TEST(VerifySurfaces, refuses_what_refining_refuses) {
  const ControlPatch patch = random_patch(CurveWrap::pinned, 2, CurveWrap::pinned, 2, 2);
  EXPECT_EQ(refusal(patch, frames(1)).code, ErrorCode::unsupported);  // normals of plane points
  EXPECT_EQ(refusal(patch, {.level = kMaxPatchLevel + 1}).code, ErrorCode::out_of_range);
}

TEST(VerifySurfaces, refuses_coordinates_that_single_precision_cannot_hold) {
  ControlPatch patch = random_patch(CurveWrap::pinned, 2, CurveWrap::pinned, 2);
  patch.points[4] = 1e39;
  const auto report = verify<float>(patch, frames(1), Budget{});
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().code, ErrorCode::out_of_range);
}

TEST(VerifySurfaces, stops_when_nobody_waits_any_more) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_EQ(refusal(random_patch(CurveWrap::pinned, 5, CurveWrap::pinned, 5), frames(1), budget).code,
            ErrorCode::cancelled);
}

}  // namespace
}  // namespace subdivd::oracle::testing

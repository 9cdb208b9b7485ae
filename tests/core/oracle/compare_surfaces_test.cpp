#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/oracle/compare.h"
#include "core/oracle/far_surfaces.h"
#include "tests/core/oracle/surface_fixtures.h"

namespace subdivd::oracle::testing {
namespace {

// Our answer and Far's, step by step as verify() gets it.
struct Answers {
  ControlPatch patch;
  RefinedPatch<double> ours;
  FarSurface far;

  LevelReport compared() const { return compare(patch, ours, far, patient()); }
};

FarSurface far_at(const ControlPatch& patch, Index level) {
  FarSurface far = far_control(patch);
  for (Index l = 0; l < level; ++l) {
    auto next = far_refine_surface<double>(far, {1, true, patch.width == 3}, Budget{});
    EXPECT_TRUE(next.ok());
    far = std::move(*next);
  }
  return far;
}

Answers answers_to(const ControlPatch& patch, Index level = 2) {
  auto ours = refine<double>(patch, frames(level), Budget{});
  EXPECT_TRUE(ours.ok());
  return {patch, std::move(*ours), far_at(patch, level)};
}

// --- Far itself -------------------------------------------------------------------------------------------

TEST(FarSurfaces, keeps_the_corners_of_an_open_grid) {
  const ControlPatch patch = random_patch(CurveWrap::pinned, 4, CurveWrap::pinned, 3);
  const FarSurface far = far_at(patch, 3);
  const Count last_u = far.u.points - 1, last_row = (far.v.points - 1) * far.u.points;
  for (Count k = 0; k < 3; ++k) {
    EXPECT_EQ(far.points[k], patch.points[k]);
    EXPECT_EQ(far.points[3 * last_u + k], patch.points[3 * 3 + k]);
    EXPECT_EQ(far.points[3 * last_row + k], patch.points[3 * 8 + k]);
    EXPECT_EQ(far.points[3 * (last_row + last_u) + k], patch.points[3 * 11 + k]);
  }
}

TEST(FarSurfaces, has_a_pinned_curve_for_a_border) {
  const ControlPatch patch = random_patch(CurveWrap::pinned, 5, CurveWrap::pinned, 4);
  const FarSurface far = far_at(patch, 3);
  ControlCurves border;
  border.points.assign(patch.points.begin(), patch.points.begin() + 15);
  const auto curve = refine<double>(border, CurveOptions{.level = 3, .limit = true}, Budget{});
  ASSERT_TRUE(curve.ok());
  ASSERT_EQ(curve->points.size(), 3 * far.u.points);
  for (std::size_t k = 0; k < curve->points.size(); ++k) {
    EXPECT_NEAR(far.points[k], curve->points[k], 1e-15);
    EXPECT_NEAR(far.limits[k], curve->limit_points[k], 1e-15);
  }
}

// Far numbers the vertices of a shifted grid otherwise; their places must not depend on it.
TEST(FarSurfaces, a_closed_surface_begins_anywhere) {
  const ControlPatch patch = random_patch(CurveWrap::periodic, 5, CurveWrap::periodic, 4);
  ControlPatch shifted = patch;
  for (Index j = 0; j < 4; ++j)
    for (Index i = 0; i < 5; ++i)
      for (Index k = 0; k < 3; ++k)
        shifted.points[(j * 5 + i) * 3 + k] = patch.points[(j * 5 + (i + 2) % 5) * 3 + k];
  const FarSurface far = far_at(patch, 2), other = far_at(shifted, 2);
  for (Count j = 0; j < far.v.points; ++j)
    for (Count i = 0; i < far.u.points; ++i)
      for (Count k = 0; k < 3; ++k)
        EXPECT_NEAR(other.points[(j * 20 + i) * 3 + k], far.points[(j * 20 + (i + 8) % 20) * 3 + k], 1e-15);
}

// Their length decides which normals are left out.
TEST(FarSurfaces, has_tangents_of_length_one_in_a_plane_of_unit_steps) {
  ControlPatch plane = random_patch(CurveWrap::pinned, 4, CurveWrap::nonperiodic, 5);
  for (Index p = 0; p < 20; ++p) {
    double* at = &plane.points[std::size_t{3} * p];
    at[0] = p % 4, at[1] = p / 4, at[2] = 0;
  }
  const FarSurface far = far_at(plane, 1);  // whose steps are half as long
  for (const Buffer<double>& tangents : {far.u_tangents, far.v_tangents}) {
    ASSERT_EQ(tangents.size(), 3 * far.u.points * far.v.points);
    for (std::size_t k = 0; k < tangents.size(); k += 3)
      EXPECT_NEAR(std::hypot(tangents[k], tangents[k + 1]), 0.5, 1e-15) << k / 3;
  }
}

// --- What is found ----------------------------------------------------------------------------------------

TEST(CompareSurfaces, finds_a_planted_point_in_every_pair_of_wraps) {
  for_each_pair_of_wraps([](CurveWrap u, CurveWrap v) {
    Answers answers = answers_to(random_patch(u, 5, v, 6));
    const double extent = point_scale(answers.patch.points, 3, patient()).diagonal;
    const Index planted = 3 * answers.ours.u_count + 5;
    answers.ours.points[std::size_t{3} * planted + 1] += 1e-9 * extent;
    const LevelReport report = answers.compared();
    EXPECT_EQ(report.verdict(), Verdict::failed);
    EXPECT_EQ(missed(report), "points") << name_of(answers.patch);
    const Deviation& found = find(report, "points");
    EXPECT_EQ(found.worst_vertex, planted);
    EXPECT_NEAR(found.max_relative, 1e-9, 1e-12);
    EXPECT_NEAR(found.max_absolute, 1e-9 * extent, 1e-12);
    EXPECT_EQ(found.worst_u, patch_parameter(u, 3, 5, 2, 5));
    EXPECT_EQ(found.worst_v, patch_parameter(v, 3, 6, 2, 3));
  });
}

TEST(CompareSurfaces, finds_every_single_point_and_limit) {
  for_each_pair_of_wraps([](CurveWrap u, CurveWrap v) {
    Answers answers = answers_to(random_patch(u, fewest(u), v, fewest(v)), 1);
    const Count points = Count{answers.ours.u_count} * answers.ours.v_count;
    Count found_limits = 0;
    for (Count p = 0; p < points; ++p) {
      double& point = answers.ours.points[3 * p];
      double& limit = answers.ours.limit_points[3 * p];
      const double kept_point = point, kept_limit = limit;
      point += 1e-9, limit += 1e-9;
      const LevelReport report = answers.compared();
      EXPECT_EQ(find(report, "points").verdict, Verdict::failed) << name_of(answers.patch) << ": " << p;
      if (find(report, "limitPoints").verdict == Verdict::failed) ++found_limits;
      point = kept_point, limit = kept_limit;
    }
    EXPECT_EQ(found_limits, points - points_beyond(answers.patch, 1)) << name_of(answers.patch);
    EXPECT_EQ(answers.compared().verdict(), Verdict::passed);
  });
}

TEST(CompareSurfaces, names_the_quad_of_the_control_grid) {
  Answers answers = answers_to(random_patch(CurveWrap::periodic, 5, CurveWrap::pinned, 4), 1);
  answers.ours.points[3 * (3 * 10 + 9)] += 1;  // u = 4.5, v = 1.5: the last quad of five in the second row
  EXPECT_EQ(find(answers.compared(), "points").worst_face, 9u);
  answers = answers_to(random_patch(CurveWrap::pinned, 5, CurveWrap::pinned, 4), 1);
  answers.ours.points[3 * (6 * 9 + 8)] += 1;  // the last corner, of the last quad of 4 x 3
  EXPECT_EQ(find(answers.compared(), "points").worst_face, 11u);
}

TEST(CompareSurfaces, finds_normals_that_are_turned_flipped_missing_or_too_long) {
  const Answers right = answers_to(hill(CurveWrap::pinned, 5, CurveWrap::periodic, 5));
  ASSERT_EQ(right.compared().verdict(), Verdict::passed);
  const auto with = [&](double x_more, double scale) {
    Answers wrong = right;
    double* normal = &wrong.ours.normals[3 * 40];
    for (int k = 0; k < 3; ++k) normal[k] *= scale;
    normal[0] += x_more;
    return missed(wrong.compared());
  };
  EXPECT_EQ(with(0, 1), "");
  EXPECT_EQ(with(1e-3, 1), "normals");
  EXPECT_EQ(with(0, -1), "normals");
  EXPECT_EQ(with(0, 0), "normals");
  EXPECT_EQ(with(0, 2), "normals");
}

TEST(CompareSurfaces, the_order_of_quads_is_ours_but_not_their_orientation) {
  Answers answers = answers_to(hill(CurveWrap::pinned, 4, CurveWrap::periodic, 4));
  Buffer<Index>& faces = answers.ours.faces;
  std::swap_ranges(faces.begin(), faces.begin() + 4, faces.begin() + 40);
  std::rotate(faces.begin(), faces.begin() + 1, faces.begin() + 4);
  EXPECT_EQ(answers.compared().verdict(), Verdict::passed);
  std::swap(faces[1], faces[3]);
  EXPECT_FALSE(answers.compared().connectivity_identical);
}

TEST(CompareSurfaces, finds_missing_foreign_and_repeated_quads) {
  const Answers right = answers_to(hill(CurveWrap::nonperiodic, 5, CurveWrap::pinned, 4));
  Answers wrong = right;
  wrong.ours.faces.resize(wrong.ours.faces.size() - 4);
  EXPECT_FALSE(wrong.compared().connectivity_identical);
  wrong = right;
  wrong.ours.faces[6] = 0;
  EXPECT_EQ(wrong.compared().verdict(), Verdict::failed);
  wrong = right;
  std::copy_n(wrong.ours.faces.begin(), 4, wrong.ours.faces.begin() + 4);
  EXPECT_EQ(wrong.compared().verdict(), Verdict::failed);
}

TEST(CompareSurfaces, finds_u_and_v_in_each_others_place) {
  Answers answers = answers_to(random_patch(CurveWrap::pinned, 5, CurveWrap::pinned, 5));
  const Index n = answers.ours.u_count;
  Buffer<double>& points = answers.ours.points;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < j; ++i)
      std::swap_ranges(&points[std::size_t{3} * (j * n + i)], &points[std::size_t{3} * (j * n + i)] + 3,
                       &points[std::size_t{3} * (i * n + j)]);
  const LevelReport report = answers.compared();
  EXPECT_TRUE(report.connectivity_identical);
  EXPECT_EQ(missed(report), "points");
}

TEST(CompareSurfaces, finds_another_wrap) {
  Answers answers = answers_to(random_patch(CurveWrap::pinned, 5, CurveWrap::pinned, 5));
  for (const CurveWrap wrap : {CurveWrap::periodic, CurveWrap::nonperiodic}) {
    Answers other = answers;
    other.patch.v_wrap = wrap;
    other.ours = answers_to(other.patch).ours;
    other.patch.v_wrap = CurveWrap::pinned;
    EXPECT_EQ(other.compared().verdict(), Verdict::failed);
  }
}

TEST(CompareSurfaces, finds_arrays_of_the_wrong_length) {
  const Answers right = answers_to(hill(CurveWrap::pinned, 4, CurveWrap::pinned, 4));
  for (Buffer<double> RefinedPatch<double>::*array :
       {&RefinedPatch<double>::points, &RefinedPatch<double>::limit_points, &RefinedPatch<double>::normals}) {
    Answers wrong = right;
    (wrong.ours.*array).resize((wrong.ours.*array).size() - 3);
    EXPECT_EQ(wrong.compared().verdict(), Verdict::failed);
  }
}

TEST(CompareSurfaces, finds_what_is_not_a_number) {
  Answers answers = answers_to(hill(CurveWrap::pinned, 4, CurveWrap::pinned, 4));
  answers.ours.points[7] = answers.ours.normals[7] = std::nan("");
  EXPECT_EQ(missed(answers.compared()), "points normals");
}

}  // namespace
}  // namespace subdivd::oracle::testing

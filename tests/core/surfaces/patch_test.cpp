#include "core/surfaces/patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "core/curves/subdivision.h"
#include "tests/shapes/random.h"

namespace subdivd::testing {
namespace {

constexpr CurveWrap kWraps[] = {CurveWrap::nonperiodic, CurveWrap::periodic, CurveWrap::pinned};
constexpr PatchOptions kAll = {2, true, true, true, PatchFaces::quads};

struct Kind {
  Index degree;
  CurveWrap wrap;
};

std::vector<Kind> all_kinds() {
  std::vector<Kind> kinds;
  for (const Index degree : {2u, 3u})
    for (const CurveWrap wrap : kWraps) kinds.push_back({degree, wrap});
  return kinds;
}

Index fewest(Kind kind) {
  if (kind.degree == 3 && kind.wrap == CurveWrap::nonperiodic) return 4;
  return kind.degree == 3 && kind.wrap == CurveWrap::pinned ? 2 : 3;
}

ControlPatch random_patch(Kind u, Index u_count, Kind v, Index v_count, Index width = 3, unsigned seed = 1) {
  shapes::Random random(seed + 31 * u_count + v_count);
  ControlPatch patch{"patch", u_count, v_count, u.degree, v.degree, u.wrap, v.wrap, width, {}};
  for (Index k = 0; k < u_count * v_count * width; ++k) patch.points.push_back(random.centred());
  return patch;
}

// Every pair of kinds, with the fewest points and with a few more.
std::vector<ControlPatch> all_patches(Index width = 3) {
  std::vector<ControlPatch> patches;
  for (const Kind u : all_kinds())
    for (const Kind v : all_kinds())
      for (const Index more : {0u, 3u})
        patches.push_back(random_patch(u, fewest(u) + more, v, fewest(v) + more / 2, width));
  return patches;
}

template <class Real = double>
RefinedPatch<Real> refined(const ControlPatch& patch, PatchOptions options = kAll) {
  if (patch.width != 3) options.normals = false;
  EXPECT_TRUE(patch.check().ok());
  auto result = refine<Real>(patch, options, Budget{});
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return std::move(result).value();
}

std::string kind_of(const ControlPatch& p) {
  return std::to_string(p.u_degree) + "/" + std::to_string(int(p.u_wrap)) + " x " +
         std::to_string(p.v_degree) + "/" + std::to_string(int(p.v_wrap)) + ", " + std::to_string(p.u_count) +
         " x " + std::to_string(p.v_count);
}

double parameter_u(const ControlPatch& p, Index level, Index i) {
  return patch_parameter(p.u_wrap, p.u_degree, p.u_count, level, i);
}
double parameter_v(const ControlPatch& p, Index level, Index j) {
  return patch_parameter(p.v_wrap, p.v_degree, p.v_count, level, j);
}

// The ends of a nonperiodic direction are no points of the surface.
bool on_surface(const RefinedPatch<double>& fine, Index i, Index j) {
  const bool u_end = i == 0 || i + 1 == fine.u_count, v_end = j == 0 || j + 1 == fine.v_count;
  return !(u_end && fine.u_wrap == CurveWrap::nonperiodic) &&
         !(v_end && fine.v_wrap == CurveWrap::nonperiodic);
}

// --- A second way: B-spline bases by their recursive definition --------------------------------------------

// N_i,p and its derivative of order `order` at t, on any knots; half-open spans, closed at `end`. [Cox72]
long double basis(const std::vector<double>& knots, Index i, int p, int order, long double t, double end) {
  const long double a = knots[i], b = knots[i + p + 1];
  if (p == 0) return t == end ? a < b && b == end : a <= t && t < b;
  const long double left = knots[i + p] - a, right = b - knots[i + 1];
  long double sum = 0;
  if (order > 0) {
    if (left > 0) sum += p / left * basis(knots, i, p - 1, order - 1, t, end);
    if (right > 0) sum -= p / right * basis(knots, i + 1, p - 1, order - 1, t, end);
    return sum;
  }
  if (left > 0) sum += (t - a) / left * basis(knots, i, p - 1, 0, t, end);
  if (right > 0) sum += (b - t) / right * basis(knots, i + 1, p - 1, 0, t, end);
  return sum;
}

// Weights of the n control points at t, for the derivative of that order. Pinned quadratics stand on clamped
// knots, pinned cubics on uniform ones with the phantom points written out, periodic ones are unrolled.
std::vector<long double> naive_weights(Kind kind, Index n, double t, int order) {
  std::vector<std::map<Index, double>> extended;  // what a point of the unrolled curve is made of
  std::vector<double> knots;
  double end = std::numeric_limits<double>::infinity();
  int first = 0;  // number of the first extended point
  if (kind.wrap == CurveWrap::periodic) {
    first = -2;
    for (int i = first; i < static_cast<int>(n) + 3; ++i) extended.push_back({{(i + n) % n, 1.0}});
  } else {
    for (Index i = 0; i < n; ++i) extended.push_back({{i, 1.0}});
    if (kind.degree == 3 && kind.wrap == CurveWrap::pinned) {
      first = -1;
      extended.insert(extended.begin(), std::map<Index, double>{{0, 2.0}, {1, -1.0}});
      extended.push_back(std::map<Index, double>{{n - 1, 2.0}, {n - 2, -1.0}});
    }
  }
  const int p = static_cast<int>(kind.degree);
  for (int k = 0; k < static_cast<int>(extended.size()) + p + 1; ++k) {
    double knot = first + k - (p + 1) / 2.0;
    if (kind.degree == 2 && kind.wrap == CurveWrap::pinned)
      knot = std::clamp(knot - 0.5, 0.0, static_cast<double>(n) - 2);
    knots.push_back(knot);
  }
  if (kind.wrap != CurveWrap::periodic) end = knots[extended.size()];
  std::vector<long double> weights(n, 0);
  for (Index e = 0; e < extended.size(); ++e)
    for (const auto& [i, weight] : extended[e]) weights[i] += weight * basis(knots, e, p, order, t, end);
  return weights;
}

double naive(const ControlPatch& patch, double u, double v, int u_order, int v_order, Index k) {
  const auto a = naive_weights({patch.u_degree, patch.u_wrap}, patch.u_count, u, u_order);
  const auto b = naive_weights({patch.v_degree, patch.v_wrap}, patch.v_count, v, v_order);
  long double sum = 0;
  for (Index j = 0; j < patch.v_count; ++j)
    for (Index i = 0; i < patch.u_count; ++i)
      sum += a[i] * b[j] * patch.points[(j * patch.u_count + i) * patch.width + k];
  return static_cast<double>(sum);
}

// --- Evaluation
// ---------------------------------------------------------------------------------------------

std::vector<double> parameters(Kind kind, Index n) {
  const bool nonperiodic = kind.wrap == CurveWrap::nonperiodic;
  const double low = !nonperiodic ? 0 : kind.degree == 2 ? 0.5 : 1;
  const double high = kind.wrap == CurveWrap::periodic   ? n - 0.0009765625
                      : kind.degree == 2 && !nonperiodic ? n - 2.0
                                                         : n - 1 - low;
  std::vector<double> ts = {low, high};
  for (const double f : {0.07, 0.31, 0.5, 0.77, 0.93}) ts.push_back(low + f * (high - low));
  return ts;
}

TEST(PatchEvaluate, agrees_with_the_recursive_definition_of_b_splines) {
  for (const ControlPatch& patch : all_patches(2))
    for (const double u : parameters({patch.u_degree, patch.u_wrap}, patch.u_count))
      for (const double v : parameters({patch.v_degree, patch.v_wrap}, patch.v_count)) {
        const auto sample = evaluate<double>(patch, u, v);
        ASSERT_TRUE(sample.ok()) << sample.error().message;
        for (Index k = 0; k < 2; ++k) {
          EXPECT_NEAR(sample->point[k], naive(patch, u, v, 0, 0, k), 1e-14) << kind_of(patch);
          EXPECT_NEAR(sample->du[k], naive(patch, u, v, 1, 0, k), 3e-14) << kind_of(patch);
          EXPECT_NEAR(sample->dv[k], naive(patch, u, v, 0, 1, k), 3e-14) << kind_of(patch);
          EXPECT_NEAR(sample->duu[k], naive(patch, u, v, 2, 0, k), 1e-13) << kind_of(patch);
          EXPECT_NEAR(sample->duv[k], naive(patch, u, v, 1, 1, k), 1e-13) << kind_of(patch);
          EXPECT_NEAR(sample->dvv[k], naive(patch, u, v, 0, 2, k), 1e-13) << kind_of(patch);
        }
      }
}

TEST(PatchEvaluate, is_periodic) {
  const auto patch = random_patch({3, CurveWrap::periodic}, 5, {2, CurveWrap::periodic}, 4);
  for (const double u : {0.0, 0.25, 4.75})
    for (const double v : {0.0, 0.5, 3.75}) {
      const auto here = evaluate<double>(patch, u, v), there = evaluate<double>(patch, u - 15, v + 8);
      EXPECT_EQ(here->point, there->point);
      EXPECT_EQ(here->duv, there->duv);
    }
  EXPECT_TRUE(evaluate<double>(patch, -1e-300, 1e300).ok());
}

TEST(PatchEvaluate, refuses_parameters_outside_the_domain_and_says_which) {
  const auto patch = random_patch({3, CurveWrap::nonperiodic}, 5, {2, CurveWrap::pinned}, 5);
  for (const double u : {0.999, 3.001, -1e300}) {
    const auto refused = evaluate<double>(patch, u, 2);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::out_of_range);
    EXPECT_EQ(refused.error().where, (Path{"u"}));
  }
  EXPECT_EQ(evaluate<double>(patch, 2, -0.001).error().where, (Path{"v"}));
  EXPECT_EQ(evaluate<double>(patch, 2, 3.001).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(evaluate<double>(patch, NAN, 2).error().code, ErrorCode::not_finite);
  EXPECT_EQ(evaluate<double>(patch, 2, INFINITY).error().where, (Path{"v"}));
}

TEST(PatchEvaluate, and_refinement_refuse_what_single_precision_cannot_hold) {
  auto patch = random_patch({3, CurveWrap::pinned}, 4, {3, CurveWrap::pinned}, 4);
  for (double& x : patch.points) x *= 1e39;
  EXPECT_EQ(evaluate<float>(patch, 1.5, 1.5).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(refine<float>(patch, {}, Budget{}).error().code, ErrorCode::out_of_range);
  EXPECT_TRUE(refine<double>(patch, {}, Budget{}).ok());
  EXPECT_TRUE(evaluate<double>(patch, 1.5, 1.5).ok());
  for (double& x : patch.points) x = x < 0 ? -1.7e308 : 1.7e308;
  for (const double u : {0.0, 0.5, 1.0, 2.2}) {
    const auto sample = evaluate<double>(patch, u, 0.3);
    if (!sample) {
      EXPECT_EQ(sample.error().code, ErrorCode::out_of_range);
      continue;
    }
    for (const double x : sample->du) EXPECT_TRUE(std::isfinite(x));
  }
}

// --- Subdivision
// --------------------------------------------------------------------------------------------

TEST(PatchRefine, counts_follow_the_closed_forms) {
  for (const ControlPatch& patch : all_patches(1))
    for (Index level = 0; level <= 3; ++level) {
      auto expected = [&](Index degree, CurveWrap wrap, Index n) {
        for (Index l = 0; l < level; ++l) {
          if (wrap == CurveWrap::periodic) n = 2 * n;
          if (wrap == CurveWrap::nonperiodic) n = 2 * n - degree;
          if (wrap == CurveWrap::pinned) n = degree == 3 ? 2 * n - 1 : 2 * n - 2;
        }
        return n;
      };
      const auto fine = refined(patch, {.level = level});
      EXPECT_EQ(fine.u_count, expected(patch.u_degree, patch.u_wrap, patch.u_count));
      EXPECT_EQ(fine.v_count, expected(patch.v_degree, patch.v_wrap, patch.v_count));
      EXPECT_EQ(fine.points.size(), std::size_t{fine.u_count} * fine.v_count);
    }
}

TEST(PatchRefine, limits_and_frames_are_what_evaluation_gives) {
  for (const ControlPatch& patch : all_patches())
    for (const Index level : {0u, 1u, 3u}) {
      const auto fine = refined(patch, {level, true, true, true, PatchFaces::none});
      for (Index j = 0; j < fine.v_count; ++j)
        for (Index i = 0; i < fine.u_count; ++i) {
          if (!on_surface(fine, i, j)) continue;
          const auto sample =
              evaluate<double>(patch, parameter_u(patch, level, i), parameter_v(patch, level, j));
          ASSERT_TRUE(sample.ok()) << sample.error().message;
          for (Index k = 0; k < 3; ++k) {
            const std::size_t at = (j * fine.u_count + i) * 3 + k;
            EXPECT_NEAR(fine.limit_points[at], sample->point[k], 2e-15) << kind_of(patch);
            EXPECT_NEAR(fine.du[at], sample->du[k], 3e-14) << kind_of(patch);
            EXPECT_NEAR(fine.dv[at], sample->dv[k], 3e-14) << kind_of(patch);
            EXPECT_NEAR(fine.normals[at], sample->normal[k], 1e-10) << kind_of(patch);
          }
        }
    }
}

// Numbering, parameters and values: a surface that is constant along v is a curve, refined by other code.
TEST(PatchRefine, a_surface_that_is_constant_along_one_direction_is_a_curve) {
  for (const Kind kind : all_kinds()) {
    ControlCurves curve;
    curve.basis = UniformBSpline{kind.degree};
    curve.wrap = kind.wrap;
    ControlPatch patch = random_patch(kind, 6, {3, CurveWrap::pinned}, 3);
    curve.points.assign(patch.points.begin(), patch.points.begin() + 18);
    for (std::size_t k = 18; k < patch.points.size(); ++k) patch.points[k] = patch.points[k - 18];
    const auto fine = refined(patch, {3, true, true, false, PatchFaces::none});
    const auto expected = refine<double>(curve, {.level = 3, .limit = true, .tangents = true}, Budget{});
    ASSERT_TRUE(expected.ok());
    ASSERT_EQ(expected->points.size(), fine.u_count * 3u);
    for (Index i = 0; i < fine.u_count; ++i)
      EXPECT_EQ(parameter_u(patch, 3, i), point_parameter(curve, 6, 3, i)) << kind_of(patch);
    for (std::size_t k = 0; k < expected->points.size(); ++k) {
      EXPECT_NEAR(fine.points[k], expected->points[k], 1e-15) << kind_of(patch);
      EXPECT_NEAR(fine.limit_points[k], expected->limit_points[k], 1e-15) << kind_of(patch);
      EXPECT_NEAR(fine.du[k], expected->tangents[k], 2e-14) << kind_of(patch);
    }
  }
}

TEST(PatchRefine, two_single_steps_are_one_double_step_to_the_bit) {
  for (const ControlPatch& patch : all_patches()) {
    const auto once = refined(patch, {.level = 1});
    ControlPatch half = patch;
    half.u_count = once.u_count, half.v_count = once.v_count;
    half.points.assign(once.points.begin(), once.points.end());
    const auto twice = refined(half, {1, true, false, true, PatchFaces::none});
    const auto direct = refined(patch, {2, true, false, false, PatchFaces::none});
    EXPECT_EQ(twice.points, direct.points) << kind_of(patch);
    EXPECT_EQ(twice.limit_points, direct.limit_points) << kind_of(patch);
  }
}

TEST(PatchRefine, level_zero_returns_the_control_points) {
  for (const ControlPatch& patch : all_patches()) {
    const auto fine = refined(patch, {.level = 0});
    EXPECT_EQ(std::vector<double>(fine.points.begin(), fine.points.end()), patch.points);
  }
}

TEST(PatchRefine, constants_stay_to_the_bit_and_have_neither_tangents_nor_normals) {
  for (ControlPatch patch : all_patches()) {
    const double same[] = {0.1, -7.3e10, 1.0 / 3};
    for (std::size_t k = 0; k < patch.points.size(); ++k) patch.points[k] = same[k % 3];
    const auto fine = refined(patch, {4, true, true, true, PatchFaces::none});
    for (std::size_t k = 0; k < fine.points.size(); ++k) {
      ASSERT_EQ(fine.points[k], same[k % 3]) << kind_of(patch);
      ASSERT_NEAR(fine.limit_points[k], same[k % 3], std::abs(same[k % 3]) * 4e-16);
      ASSERT_EQ(fine.du[k], 0);
      ASSERT_EQ(fine.dv[k], 0);
      ASSERT_EQ(fine.normals[k], 0);
    }
  }
}

TEST(PatchRefine, exchanging_u_and_v_exchanges_the_answer) {
  for (const ControlPatch& patch : all_patches()) {
    ControlPatch turned = patch;
    std::swap(turned.u_count, turned.v_count);
    std::swap(turned.u_degree, turned.v_degree);
    std::swap(turned.u_wrap, turned.v_wrap);
    for (Index j = 0; j < patch.v_count; ++j)
      for (Index i = 0; i < patch.u_count; ++i)
        for (Index k = 0; k < 3; ++k)
          turned.points[(i * patch.v_count + j) * 3 + k] = patch.points[(j * patch.u_count + i) * 3 + k];
    const auto a = refined(patch), b = refined(turned);
    ASSERT_EQ(a.u_count, b.v_count);
    for (Index j = 0; j < a.v_count; ++j)
      for (Index i = 0; i < a.u_count; ++i)
        for (Index k = 0; k < 3; ++k) {
          const std::size_t x = (j * a.u_count + i) * 3 + k, y = (i * b.u_count + j) * 3 + k;
          EXPECT_NEAR(a.points[x], b.points[y], 1e-15);
          EXPECT_NEAR(a.limit_points[x], b.limit_points[y], 1e-15);
          EXPECT_NEAR(a.du[x], b.dv[y], 1e-14);
          EXPECT_NEAR(a.normals[x], -b.normals[y], 1e-10);
        }
  }
}

TEST(PatchRefine, commutes_with_affine_maps) {
  const double m[3][4] = {{1, 2, -1, 0.5}, {0, 1, 3, -2}, {-2, 0.25, 1, 4}};
  auto map = [&](const auto& points) {
    std::vector<double> out;
    for (std::size_t p = 0; p < points.size(); p += 3)
      for (const auto& row : m)
        out.push_back(row[0] * points[p] + row[1] * points[p + 1] + row[2] * points[p + 2] + row[3]);
    return out;
  };
  for (const ControlPatch& patch : all_patches()) {
    ControlPatch image = patch;
    image.points = map(patch.points);
    const auto a = refined(patch), b = refined(image);
    const auto expected = map(a.points), limits = map(a.limit_points);
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_NEAR(b.points[k], expected[k], 1e-14);
      EXPECT_NEAR(b.limit_points[k], limits[k], 1e-14);
    }
  }
}

TEST(PatchRefine, products_and_sums_of_two_curves_stay_such) {
  for (ControlPatch patch : all_patches(2)) {
    ControlPatch across = patch, along = patch;  // f alone, g alone
    for (Index j = 0; j < patch.v_count; ++j)
      for (Index i = 0; i < patch.u_count; ++i) {
        const std::size_t at = (j * patch.u_count + i) * 2;
        const double f = std::sin(1 + 2.3 * i), g = std::cos(0.4 + 1.7 * j);
        across.points[at] = across.points[at + 1] = f;
        along.points[at] = along.points[at + 1] = g;
        patch.points[at] = f * g, patch.points[at + 1] = f + g;
      }
    const auto both = refined(patch), f = refined(across), g = refined(along);
    for (std::size_t k = 0; k < both.points.size(); k += 2) {
      EXPECT_NEAR(both.points[k], f.points[k] * g.points[k], 1e-15);
      EXPECT_NEAR(both.points[k + 1], f.points[k] + g.points[k], 1e-15);
      EXPECT_NEAR(both.limit_points[k], f.limit_points[k] * g.limit_points[k], 1e-15);
      EXPECT_NEAR(both.du[k], f.du[k] * g.limit_points[k], 1e-14);
      EXPECT_NEAR(both.dv[k + 1], g.dv[k + 1], 1e-14);
    }
  }
}

TEST(PatchRefine, one_bicubic_step_has_the_points_of_catmull_and_clark) {
  ControlPatch patch{"", 4, 4, 3, 3, CurveWrap::nonperiodic, CurveWrap::nonperiodic, 1, {}};
  for (Index k = 0; k < 16; ++k) patch.points.push_back(64.0 * (k == 5));
  const auto fine = refined(patch, {.level = 1});  // 5 x 5; vertex points at odd columns and rows
  EXPECT_EQ(fine.points[1 * 5 + 1], 36);           // vertex point 36/64
  EXPECT_EQ(fine.points[1 * 5 + 2], 24);           // edge point 24/64
  EXPECT_EQ(fine.points[2 * 5 + 2], 16);           // face point 1/4
  EXPECT_EQ(fine.points[3 * 5 + 3], 1);
  EXPECT_EQ(fine.points[4 * 5 + 4], 0);
}

TEST(PatchRefine, one_biquadratic_step_has_the_points_of_doo_and_sabin) {
  ControlPatch patch{"", 3, 3, 2, 2, CurveWrap::nonperiodic, CurveWrap::nonperiodic, 1, {}};
  for (Index k = 0; k < 9; ++k) patch.points.push_back(16.0 * (k == 4));
  const auto fine = refined(patch, {.level = 1});
  EXPECT_EQ(std::vector<double>(fine.points.begin(), fine.points.end()),
            (std::vector<double>{1, 3, 3, 1, 3, 9, 9, 3, 3, 9, 9, 3, 1, 3, 3, 1}));
}

TEST(PatchRefine, pinned_directions_keep_their_corners_to_the_bit) {
  for (const Index u_degree : {2u, 3u})
    for (const Index v_degree : {2u, 3u}) {
      const auto patch = random_patch({u_degree, CurveWrap::pinned}, 5, {v_degree, CurveWrap::pinned}, 4);
      const auto fine = refined(patch, {5, true, false, false, PatchFaces::none});
      const std::size_t fine_corners[] = {0, fine.u_count - 1u, fine.u_count * (fine.v_count - 1u),
                                          fine.u_count * fine.v_count - 1u};
      const std::size_t corners[] = {0, 4, 15, 19};
      for (int c = 0; c < 4; ++c)
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_EQ(fine.points[fine_corners[c] * 3 + k], patch.points[corners[c] * 3 + k]);
          EXPECT_EQ(fine.limit_points[fine_corners[c] * 3 + k], patch.points[corners[c] * 3 + k]);
        }
    }
}

TEST(PatchRefine, a_pinned_border_depends_on_its_own_points_alone) {
  for (const Index degree : {2u, 3u}) {
    auto patch = random_patch({degree, CurveWrap::pinned}, 5, {degree, CurveWrap::pinned}, 5);
    const auto before = refined(patch, {3, true, false, false, PatchFaces::none});
    for (std::size_t k = 15; k < patch.points.size(); ++k) patch.points[k] += 1;  // all but the first row
    const auto after = refined(patch, {3, true, false, false, PatchFaces::none});
    for (std::size_t k = 0; k < before.u_count * 3; ++k) {
      EXPECT_EQ(before.limit_points[k], after.limit_points[k]);
      EXPECT_NE(before.limit_points[k + before.u_count * 3], after.limit_points[k + before.u_count * 3]);
    }
  }
}

TEST(PatchRefine, planar_grids_stay_planar_with_one_normal) {
  for (ControlPatch patch : all_patches()) {
    if (patch.u_wrap == CurveWrap::periodic || patch.v_wrap == CurveWrap::periodic) continue;
    for (Index j = 0; j < patch.v_count; ++j)
      for (Index i = 0; i < patch.u_count; ++i) {
        double* p = &patch.points[(j * patch.u_count + i) * 3];
        p[0] = i + 0.2 * p[0], p[1] = j + 0.2 * p[1];
        p[2] = 2 * p[0] - 3 * p[1] + 5;
      }
    const auto fine = refined(patch, {3, true, true, true, PatchFaces::none});
    for (std::size_t k = 0; k < fine.points.size(); k += 3) {
      EXPECT_NEAR(fine.points[k + 2], 2 * fine.points[k] - 3 * fine.points[k + 1] + 5, 1e-13);
      EXPECT_NEAR(fine.normals[k] * std::sqrt(14.0), -2, 1e-11);
      EXPECT_NEAR(fine.normals[k + 1] * std::sqrt(14.0), 3, 1e-11);
      EXPECT_NEAR(fine.normals[k + 2] * std::sqrt(14.0), 1, 1e-11);
    }
  }
}

TEST(PatchRefine, any_width_is_refined_component_by_component) {
  for (Index width = 1; width <= kMaxPatchWidth; ++width) {
    const auto patch = random_patch({3, CurveWrap::pinned}, 4, {2, CurveWrap::periodic}, 3, width);
    const auto whole = refined(patch);
    ControlPatch part = patch;
    part.width = 1;
    part.points.clear();
    for (std::size_t k = width - 1; k < patch.points.size(); k += width)
      part.points.push_back(patch.points[k]);
    const auto last = refined(part);
    for (std::size_t p = 0; p < last.points.size(); ++p) {
      EXPECT_EQ(whole.points[p * width + width - 1], last.points[p]);
      EXPECT_EQ(whole.dv[p * width + width - 1], last.dv[p]);
    }
  }
}

TEST(PatchRefine, single_precision_follows_double) {
  for (const ControlPatch& patch : all_patches()) {
    const auto fine = refined<double>(patch);
    const auto coarse = refined<float>(patch);
    for (std::size_t k = 0; k < fine.points.size(); ++k) {
      EXPECT_NEAR(fine.points[k], coarse.points[k], 1e-6);
      EXPECT_NEAR(fine.limit_points[k], coarse.limit_points[k], 1e-6);
      EXPECT_NEAR(fine.du[k], coarse.du[k], 2e-5);
    }
    EXPECT_EQ(refined<float>(patch).normals, coarse.normals);
  }
}

// --- Connectivity
// -------------------------------------------------------------------------------------------

ControlPatch torus(Index degree, Index u_count, Index v_count) {
  ControlPatch patch{"torus", u_count, v_count, degree, degree, CurveWrap::periodic, CurveWrap::periodic,
                     3,       {}};
  for (Index j = 0; j < v_count; ++j)
    for (Index i = 0; i < u_count; ++i) {
      const double a = 2 * std::numbers::pi * i / u_count, b = 2 * std::numbers::pi * j / v_count;
      for (const double x : {(3 + std::cos(b)) * std::cos(a), (3 + std::cos(b)) * std::sin(a), std::sin(b)})
        patch.points.push_back(x);
    }
  return patch;
}

// How often every directed edge stands among the faces.
template <class Real>
std::map<std::pair<Index, Index>, int> directed_edges(const RefinedPatch<Real>& patch) {
  std::map<std::pair<Index, Index>, int> edges;
  const Index n = patch.corners_per_face;
  for (std::size_t f = 0; f < patch.faces.size(); f += n)
    for (Index c = 0; c < n; ++c) ++edges[{patch.faces[f + c], patch.faces[f + (c + 1) % n]}];
  return edges;
}

TEST(PatchFaces, a_torus_is_closed_and_of_euler_characteristic_zero) {
  for (const Index degree : {2u, 3u})
    for (const PatchFaces faces : {PatchFaces::quads, PatchFaces::triangles})
      for (const Index level : {0u, 2u}) {
        const auto fine = refined(torus(degree, 5, 3), {level, false, false, false, faces});
        const auto edges = directed_edges(fine);
        for (const auto& [edge, times] : edges) {
          EXPECT_EQ(times, 1);
          EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
        }
        const long face_count = static_cast<long>(fine.faces.size() / fine.corners_per_face);
        const long vertex_count = static_cast<long>(fine.points.size() / 3);
        EXPECT_EQ(vertex_count - static_cast<long>(edges.size() / 2) + face_count, 0);
      }
}

TEST(PatchFaces, normals_of_a_torus_point_outwards) {
  for (const Index degree : {2u, 3u}) {
    const auto fine = refined(torus(degree, 9, 7), {2, true, false, true, PatchFaces::none});
    for (std::size_t k = 0; k < fine.points.size(); k += 3) {
      const double* p = &fine.limit_points[k];
      const double* n = &fine.normals[k];
      const double ring = 3 / std::hypot(p[0], p[1]);
      const double outwards = n[0] * p[0] * (1 - ring) + n[1] * p[1] * (1 - ring) + n[2] * p[2];
      EXPECT_GT(outwards, 0.5);
      EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 1, 1e-15);
    }
  }
}

TEST(PatchFaces, turn_counter_clockwise_about_du_cross_dv) {
  for (const PatchFaces faces : {PatchFaces::quads, PatchFaces::triangles}) {
    const auto fine = refined(torus(3, 9, 7), {2, true, false, true, faces});
    for (std::size_t f = 0; f < fine.faces.size(); f += fine.corners_per_face) {
      const double* a = &fine.limit_points[fine.faces[f] * 3];
      const double* b = &fine.limit_points[fine.faces[f + 1] * 3];
      const double* c = &fine.limit_points[fine.faces[f + 2] * 3];
      const double* n = &fine.normals[fine.faces[f] * 3];
      double volume = 0;
      for (int k = 0; k < 3; ++k) {
        const int x = (k + 1) % 3, y = (k + 2) % 3;
        volume += n[k] * ((b[x] - a[x]) * (c[y] - a[y]) - (b[y] - a[y]) * (c[x] - a[x]));
      }
      EXPECT_GT(volume, 0);
    }
  }
}

TEST(PatchFaces, an_open_sheet_has_one_border_and_a_tube_two) {
  for (const CurveWrap wrap : kWraps) {
    const auto fine = refined(random_patch({3, wrap}, 4, {2, CurveWrap::pinned}, 4));
    const auto edges = directed_edges(fine);
    std::size_t border = 0, sides = 0;
    for (const auto& [edge, times] : edges) {
      EXPECT_EQ(times, 1);
      ++sides;
      border += edges.count({edge.second, edge.first}) == 0;
    }
    const bool tube = wrap == CurveWrap::periodic;
    EXPECT_EQ(border, tube ? 2u * fine.u_count : 2u * (fine.u_count - 1) + 2u * (fine.v_count - 1));
    const long euler = static_cast<long>(fine.points.size() / 3) - static_cast<long>((sides + border) / 2) +
                       static_cast<long>(fine.faces.size() / 4);
    EXPECT_EQ(euler, tube ? 0 : 1);
  }
}

// --- Degenerate, huge and tiny
// ------------------------------------------------------------------------------

TEST(PatchNormals, are_zero_where_all_points_lie_on_a_line) {
  for (ControlPatch patch : all_patches()) {
    for (std::size_t k = 0; k < patch.points.size(); k += 3) {
      const double t = patch.points[k];
      patch.points[k] = 7000 + 0.1 * t, patch.points[k + 1] = -3 + 0.7 * t, patch.points[k + 2] = t / 3;
    }
    for (const double n : refined(patch, {5, false, false, true, PatchFaces::none}).normals) ASSERT_EQ(n, 0);
    for (const float n : refined<float>(patch, {3, false, false, true, PatchFaces::none}).normals)
      ASSERT_EQ(n, 0);
  }
}

TEST(PatchNormals, are_zero_at_a_pole_and_unit_vectors_beside_it) {
  ControlPatch patch = random_patch({3, CurveWrap::periodic}, 6, {3, CurveWrap::pinned}, 4);
  for (Index j = 0; j < 4; ++j)
    for (Index i = 0; i < 6; ++i) {
      double* p = &patch.points[(j * 6 + i) * 3];
      p[0] = j * std::cos(i * std::numbers::pi / 3), p[1] = j * std::sin(i * std::numbers::pi / 3),
      p[2] = 0.1;
    }
  const auto fine = refined(patch, {3, false, false, true, PatchFaces::none});
  for (std::size_t k = 0; k < fine.normals.size(); k += 3) {
    EXPECT_EQ(fine.normals[k], 0);
    EXPECT_NEAR(fine.normals[k + 2], k < fine.u_count * 3u ? 0 : -1, 1e-15);
  }
}

TEST(PatchNormals, do_not_depend_on_the_scale) {
  const auto patch = random_patch({3, CurveWrap::pinned}, 5, {2, CurveWrap::periodic}, 5);
  const auto expected = refined(patch).normals;
  for (const double scale : {0x1p-1000, 0x1p-500, 0x1p500, 0x1p1000}) {
    ControlPatch scaled = patch;
    for (double& x : scaled.points) x *= scale;
    EXPECT_EQ(refined(scaled).normals, expected) << scale;
  }
}

TEST(PatchNormals, exist_on_a_patch_that_is_thin_along_an_axis) {
  ControlPatch patch{"", 4, 4, 3, 3, CurveWrap::pinned, CurveWrap::pinned, 3, {}};
  for (Index j = 0; j < 4; ++j)
    for (Index i = 0; i < 4; ++i)
      for (const double x : {1e-40 * i, 0.0 + j, 0.0}) patch.points.push_back(x);
  const auto fine = refined(patch);
  for (std::size_t k = 0; k < fine.normals.size(); k += 3) EXPECT_EQ(fine.normals[k + 2], 1);
}

TEST(PatchRefine, never_answers_with_nan_or_infinity) {
  for (ControlPatch patch : all_patches()) {
    for (double& x : patch.points) x = x < 0 ? -1.7976931348623157e308 : 1.7976931348623157e308;
    const auto answer = refine<double>(patch, kAll, Budget{});
    if (!answer) {
      EXPECT_EQ(answer.error().code, ErrorCode::out_of_range);
      continue;
    }
    for (const double x : answer->du) EXPECT_TRUE(std::isfinite(x));
  }
}

// --- The door
// -----------------------------------------------------------------------------------------------

ErrorCode fault(const ControlPatch& patch) {
  const auto checked = patch.check();
  return checked ? ErrorCode::internal : checked.error().code;
}

TEST(ControlPatch, refuses_what_it_cannot_be) {
  const ControlPatch good = random_patch({3, CurveWrap::pinned}, 4, {2, CurveWrap::periodic}, 4);
  ASSERT_TRUE(good.check().ok());
  ControlPatch bad = good;
  bad.u_degree = 4;
  EXPECT_EQ(fault(bad), ErrorCode::out_of_range);
  EXPECT_EQ(bad.check().error().where, (Path{"uDegree"}));
  bad = good, bad.v_degree = 1;
  EXPECT_EQ(bad.check().error().where, (Path{"vDegree"}));
  for (const Index width : {0u, 17u, 0xffffffffu}) {
    bad = good, bad.width = width;
    EXPECT_EQ(fault(bad), ErrorCode::out_of_range);
  }
  bad = good, bad.points.pop_back();
  EXPECT_EQ(fault(bad), ErrorCode::wrong_length);
  bad = good, bad.points[7] = NAN;
  EXPECT_EQ(fault(bad), ErrorCode::not_finite);
  EXPECT_EQ(bad.check().error().where, (Path{"points", std::uint64_t{7}}));
  bad = good, bad.u_count = 0x10000, bad.v_count = 0x10000;  // their product is 0 in 32 bits
  EXPECT_EQ(fault(bad), ErrorCode::too_large);
  bad = good, bad.u_count = 0x80000001, bad.v_count = 0x80000001, bad.width = 16;
  EXPECT_EQ(fault(bad), ErrorCode::too_large);
}

TEST(ControlPatch, needs_the_fewest_points_of_its_degree_and_wrap) {
  for (const Kind u : all_kinds())
    for (const Kind v : all_kinds()) {
      EXPECT_TRUE(random_patch(u, fewest(u), v, fewest(v)).check().ok());
      EXPECT_EQ(random_patch(u, fewest(u) - 1, v, fewest(v)).check().error().where, (Path{"uVertexCount"}));
      EXPECT_EQ(fault(random_patch(u, fewest(u), v, fewest(v) - 1)), ErrorCode::too_few_points);
    }
  EXPECT_EQ(fault(ControlPatch{}), ErrorCode::too_few_points);
}

TEST(PatchRefine, predicted_bytes_are_the_bytes_of_the_arrays) {
  for (const ControlPatch& patch : all_patches())
    for (const PatchFaces faces : {PatchFaces::none, PatchFaces::triangles, PatchFaces::quads}) {
      const PatchOptions options{2, true, true, true, faces};
      const auto fine = refined<float>(patch, options);
      const auto bytes = predict_bytes<float>(patch, options);
      ASSERT_TRUE(bytes.ok());
      EXPECT_EQ(*bytes, 4 * (fine.points.size() + fine.limit_points.size() + fine.du.size() + fine.dv.size() +
                             fine.normals.size() + fine.faces.size()));
    }
}

TEST(PatchRefine, refuses_levels_and_sizes_beyond_the_maximum) {
  const auto patch = random_patch({3, CurveWrap::periodic}, 3, {3, CurveWrap::periodic}, 3, 1);
  EXPECT_EQ(refine<double>(patch, {.level = kMaxPatchLevel + 1}, Budget{}).error().code,
            ErrorCode::out_of_range);
  EXPECT_EQ(refine<double>(patch, {.level = 0xffffffff}, Budget{}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(predict_bytes<double>(patch, {.level = kMaxPatchLevel}).error().code, ErrorCode::too_large);
  const Count points = Count{3} * 3 << 2 * kMaxPatchLevel;
  EXPECT_EQ(predict_bytes<double>(patch, {.level = kMaxPatchLevel}).error().predicted, points);
  // Either count is past 32 bits, and their product past 64.
  ControlPatch vast;
  vast.u_wrap = vast.v_wrap = CurveWrap::periodic;
  vast.u_count = vast.v_count = 0x80000000;
  EXPECT_EQ(predict_bytes<double>(vast, {.level = kMaxPatchLevel}).error().code, ErrorCode::too_large);
  Budget small;
  small.max_bytes = 1000;
  const auto refused = refine<double>(patch, {.level = 5}, small);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::too_large);
  EXPECT_EQ(refused.error().predicted, 96u * 96 * 8);
}

TEST(PatchRefine, refuses_normals_of_points_that_are_not_of_width_three) {
  const auto patch = random_patch({3, CurveWrap::pinned}, 4, {3, CurveWrap::pinned}, 4, 2);
  EXPECT_EQ(refine<double>(patch, kAll, Budget{}).error().code, ErrorCode::unsupported);
}

TEST(PatchRefine, stops_when_nobody_waits_any_more) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  const auto patch = random_patch({3, CurveWrap::pinned}, 4, {3, CurveWrap::pinned}, 4);
  EXPECT_EQ(refine<double>(patch, kAll, budget).error().code, ErrorCode::cancelled);
}

// Without polling inside the steps this would run for many seconds.
TEST(PatchRefine, stops_in_the_middle_of_a_step) {
  Budget budget;
  budget.deadline = Budget::Clock::now() + std::chrono::milliseconds(20);
  const auto patch = random_patch({3, CurveWrap::pinned}, 2, {3, CurveWrap::pinned}, 2, 1);
  const auto refused = refine<float>(patch, {.level = 14}, budget);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::deadline_exceeded);
  EXPECT_LT(Budget::Clock::now() - budget.deadline, std::chrono::seconds(1));
}

TEST(PatchNormals, of_tangents_that_outgrow_their_type_are_refused) {
  ControlPatch patch;
  patch.u_count = patch.v_count = 3;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      patch.points.insert(patch.points.end(), {i == 1 ? -1.5e308 : 1.5e308, (j - 1) * 1.2e308, 0});
  for (const bool tangents : {false, true}) {
    const auto refined = refine<double>(patch, {.level = 1, .tangents = tangents, .normals = true}, Budget{});
    ASSERT_FALSE(refined);
    EXPECT_EQ(refined.error().code, ErrorCode::out_of_range);
  }
  EXPECT_TRUE(refine<double>(patch, {.level = 1}, Budget{}));
}

}  // namespace
}  // namespace subdivd::testing

#pragma once
// Bicubic surfaces for the comparison with Far.

#include <cmath>
#include <numbers>
#include <string>

#include "core/surfaces/patch.h"
#include "tests/core/oracle/fixtures.h"
#include "tests/shapes/random.h"

namespace subdivd::oracle::testing {

inline constexpr CurveWrap kWraps[] = {CurveWrap::nonperiodic, CurveWrap::periodic, CurveWrap::pinned};
inline constexpr unsigned kSeed = 20240611;

inline Index fewest(CurveWrap wrap) {
  return wrap == CurveWrap::pinned ? 2 : wrap == CurveWrap::periodic ? 3 : 4;
}

inline PatchOptions frames(Index level, PatchFaces faces = PatchFaces::quads) {
  return {.level = level, .limit = true, .normals = true, .faces = faces};
}

// Coordinates between -1 and 1.
inline ControlPatch random_patch(CurveWrap u, Index u_count, CurveWrap v, Index v_count, Index width = 3) {
  shapes::Random random(kSeed + 31 * u_count + 7 * v_count + width);
  ControlPatch patch{"patch", u_count, v_count, 3, 3, u, v, width, {}};
  for (Index k = 0; k < u_count * v_count * width; ++k) patch.points.push_back(random.centred());
  EXPECT_TRUE(patch.check().ok());
  return patch;
}

// A gentle hill above a grid of unit steps: no tangents are anywhere near parallel.
inline ControlPatch hill(CurveWrap u, Index u_count, CurveWrap v, Index v_count) {
  ControlPatch patch = random_patch(u, u_count, v, v_count);
  for (Index j = 0; j < v_count; ++j)
    for (Index i = 0; i < u_count; ++i) {
      double* at = &patch.points[std::size_t{3} * (j * u_count + i)];
      at[0] = i + at[0] / 4, at[1] = j + at[1] / 4;
    }
  return patch;
}

inline ControlPatch torus(Index u_count, Index v_count) {
  ControlPatch patch{"torus", u_count, v_count, 3, 3, CurveWrap::periodic, CurveWrap::periodic, 3, {}};
  for (Index j = 0; j < v_count; ++j)
    for (Index i = 0; i < u_count; ++i) {
      const double a = 2 * std::numbers::pi * i / u_count, b = 2 * std::numbers::pi * j / v_count;
      const double radius = 3 + std::cos(b);
      patch.points.insert(patch.points.end(), {radius * std::cos(a), radius * std::sin(a), std::sin(b)});
    }
  return patch;
}

inline std::string name_of(const ControlPatch& p) {
  return "wraps " + std::to_string(int(p.u_wrap)) + " " + std::to_string(int(p.v_wrap)) + ", " +
         std::to_string(p.u_count) + " x " + std::to_string(p.v_count) + ", width " + std::to_string(p.width);
}

template <class Visit>
void for_each_pair_of_wraps(Visit&& visit) {
  for (const CurveWrap u : kWraps)
    for (const CurveWrap v : kWraps) visit(u, v);
}

// Points beyond the ends of nonperiodic directions.
inline Count points_beyond(const ControlPatch& patch, Index level) {
  const Count u = refined_grid_count(patch.u_wrap, 3, patch.u_count, level);
  const Count v = refined_grid_count(patch.v_wrap, 3, patch.v_count, level);
  const Count u_inside = patch.u_wrap == CurveWrap::nonperiodic ? u - 2 : u;
  const Count v_inside = patch.v_wrap == CurveWrap::nonperiodic ? v - 2 : v;
  return u * v - u_inside * v_inside;
}

}  // namespace subdivd::oracle::testing

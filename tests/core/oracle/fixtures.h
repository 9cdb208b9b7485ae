#pragma once
// One mesh that has everything the comparison looks at, and both sides' answers to it.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/oracle/compare.h"
#include "core/oracle/far.h"
#include "core/refine/refine.h"
#include "tests/shapes/build.h"

namespace subdivd::oracle::testing {

inline constexpr Index kLevel = 2;

// Never stops anybody.
inline const Pace& patient() {
  static const Budget unlimited;
  static const Pace pace(unlimited);
  return pace;
}

inline RefineOptions everything(Index level) {
  RefineOptions options;
  options.level = level;
  options.limit = options.tangents = options.normals = true;
  return options;
}

// Valence 5 at both tips, one infinite crease, a hole, and a primvar of every interpolation.
inline ControlMesh rich_mesh() {
  ControlMesh mesh = shapes::double_pyramid(5);
  shapes::crease(mesh, {2, 3, 4, 5, 6, 2}, kInfiniteSharpness);
  mesh.hole_indices = {3};
  mesh.primvars = {shapes::plain_primvar(mesh, "constant", Interpolation::constant, 2),
                   shapes::plain_primvar(mesh, "uniform", Interpolation::uniform, 1),
                   shapes::plain_primvar(mesh, "varying", Interpolation::varying, 3),
                   shapes::plain_primvar(mesh, "vertex", Interpolation::vertex, 4),
                   shapes::seamed(mesh, "st", 2, {{0, 2}, {2, 1}})};
  return mesh;
}

template <class Real>
struct Both {
  ControlMesh mesh;
  RefinedMesh<Real> ours;
  FarLevel<Real> far;

  LevelReport compared() const { return compare(mesh, ours, far, patient()); }
};

template <class Real = double>
Both<Real> both_of(const ControlMesh& mesh, const RefineOptions& options = everything(kLevel)) {
  EXPECT_TRUE(mesh.check().ok());
  auto ours = refine<Real>(mesh, options, Budget{});
  auto far = far_refine<Real>(mesh, options, Budget{});
  EXPECT_TRUE(ours.ok() && far.ok());
  return {mesh, std::move(*ours), std::move(*far)};
}

inline const Deviation& find(const LevelReport& report, const std::string& quantity) {
  static const Deviation nothing;
  const auto found = std::find_if(report.deviations.begin(), report.deviations.end(),
                                  [&](const Deviation& d) { return d.quantity == quantity; });
  EXPECT_NE(found, report.deviations.end()) << quantity;
  return found == report.deviations.end() ? nothing : *found;
}

// Quantities that missed their tolerance, joined by blanks.
inline std::string missed(const LevelReport& report) {
  std::string names;
  for (const Deviation& deviation : report.deviations)
    if (deviation.verdict == Verdict::failed) names += (names.empty() ? "" : " ") + deviation.quantity;
  return names;
}

}  // namespace subdivd::oracle::testing

#pragma once
// What the tests of Doo and Sabin's scheme share: its meshes, and a mesh that is refined step by step.

#include <array>
#include <vector>

#include "core/engine/plain/corner_rows.h"
#include "core/engine/plain/corner_split.h"
#include "core/schemes/doo_sabin.h"
#include "tests/core/engine/levels.h"
#include "tests/shapes/shapes.h"

namespace subdivd::plain {

inline constexpr std::array kBothWeights = {DooSabin{DooSabinWeights::doo_sabin},
                                            DooSabin{DooSabinWeights::midpoint}};

// Polygons, borders of all modes, and what is not manifold, without semi-sharp tags.
std::vector<shapes::NamedShape> doo_sabin_meshes();

// Level 0; with interpolateBoundary none its borders are open.
Level first_of(const ControlMesh& mesh);

// A level with its points, and the step to the next.
struct DooSabinSurface {
  explicit DooSabinSurface(const ControlMesh& mesh, DooSabin of = {})
      : scheme(of), level(first_of(mesh)), points(mesh.points), split(split_corners(level)) {}

  void refine() {
    points = apply<double>(step_rows(scheme, level, split), std::span<const double>(points), 3);
    level = next_level(std::move(split));
    split = split_corners(level);
  }
  std::array<double, 3> at(Index v) const { return {points[3 * v], points[3 * v + 1], points[3 * v + 2]}; }
  std::array<double, 3> centroid(Index f) const {
    std::array<double, 3> sum{};
    const Index n = level.faces.face_size(f);
    for (Index k = 0; k < n; ++k)
      for (Index axis = 0; axis < 3; ++axis)
        sum[axis] += points[3 * level.faces.corner_vertex(level.faces.face_begin(f) + k) + axis] / n;
    return sum;
  }

  DooSabin scheme;
  Level level;
  std::vector<double> points;
  CornerSplit split;
};

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b);

}  // namespace subdivd::plain

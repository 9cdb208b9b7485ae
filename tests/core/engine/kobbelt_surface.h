#pragma once
// What the tests of Kobbelt's scheme share: its meshes, and a mesh that is refined step by step.

#include <vector>

#include "core/engine/plain/line_rows.h"
#include "core/schemes/kobbelt.h"
#include "tests/core/engine/levels.h"
#include "tests/shapes/shapes.h"

namespace subdivd::plain {

inline constexpr double kTension = Kobbelt::tension;

// Meshes of quads without semi-sharp tags; others after a split of every face.
std::vector<shapes::NamedShape> kobbelt_meshes();

// n quads around point 0 in the plane, like slices; points 1, 3, ... are its neighbours.
ControlMesh flat_disk(Index n);

struct KobbeltSurface {
  explicit KobbeltSurface(const ControlMesh& mesh) : level(base_level(mesh)), points(mesh.points) {}

  std::vector<double> applied(const StepRows& rows) const {
    return apply<double>(rows, std::span<const double>(points), 3);
  }
  void refine();
  double nearest(const double* point) const;  // its distance to the nearest point

  Level level;
  std::vector<double> points;
};

}  // namespace subdivd::plain

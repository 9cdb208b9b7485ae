#pragma once
// Lines on meshes that refine as cubic curves: borders, and creases of infinite sharpness. Both are pinned at
// corners and closed without one. Ends inside a surface without a corner (darts) are no such lines.

#include <string>
#include <vector>

#include "core/curves/subdivision.h"
#include "core/mesh/control_mesh.h"
#include "core/refine/refined_mesh.h"

namespace subdivd::testing {

struct MeshLine {
  std::string name;  // of a test
  ControlMesh mesh;  // with random points in [-1, 1)
  std::vector<Index> points;
  bool closed = false;
};

std::vector<MeshLine> border_lines();
std::vector<MeshLine> crease_lines();
std::vector<MeshLine> all_mesh_lines();  // both

// The cubic through the line's control points.
ControlCurves curve_of(const MeshLine& line);
// Longest diagonal of the box around them.
double extent(const MeshLine& line);

// On a base face, where every refined point of the line is, in the order of the refined curve's.
std::vector<Provenance> places_along(const MeshLine& line, Index level);

}  // namespace subdivd::testing

#pragma once
// Meshes of faces of any sizes, refined by OpenSubdiv's schemes that split into quads: the witness of ours. As
// plain data; includes no OpenSubdiv.

#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/mesh/control_mesh.h"

namespace subdivd::oracle {

struct FarPolygons {
  std::vector<double> points;  // x y z per vertex, in Far's order
  // Far's vertex at every corner. Faces stand in the order of the corners of the level before them, of which each
  // is the first of its child; those of the control mesh in its own.
  std::vector<Index> corners;
};

struct FarPolygonRules {
  CreaseMethod crease_method = CreaseMethod::uniform;
  bool bilinear = false;  // instead of Catmull-Clark
  TriangleRule triangles = TriangleRule::catmull_clark;
};

// Levels 0 to `level`, in double. The mesh's arrays must fit together and its faces repeat no vertex (assumed).
// Fails with unsupported for what Far refuses, and when the budget says stop.
Result<std::vector<FarPolygons>> far_refine_polygons(const ControlMesh& mesh, const FarPolygonRules& rules,
                                                     Index level, const Budget& budget = {});

}  // namespace subdivd::oracle

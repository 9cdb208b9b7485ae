#pragma once
// Makes a control mesh that check() would refuse acceptable, saying what was done.

#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/mesh/control_mesh.h"

namespace subdivd {

// Both say, for every face of the new mesh, from which face of the old one it came; empty when nothing was
// changed. Array lengths and indices are trusted no more than check() trusts them: a fault is returned as
// check() would report it, and the mesh is then unchanged. Stopped by the budget, they leave the mesh
// in any state.

// Removes faces that repeat a vertex: they have no inside. Their face-varying indices, uniform values and
// holes go with them, and so do creases along edges that no other face has.
Result<std::vector<Index>> drop_degenerate_faces(ControlMesh& mesh, const Budget& budget = {});

struct Triangulation {
  std::vector<Index> faces;    // the old face of every new one, ascending
  std::vector<Index> corners;  // the old corner of every new one, counted over the whole mesh
};

// Splits every face of k > 3 vertices into k - 2 triangles: the fan (0,1,2), (0,2,3), ... from its first
// vertex where that does not fold the face over, otherwise by clipping ears (core/mesh/ear_clipping.h);
// uniform values, face-varying indices, holes and render meshes follow. Refuses faces of fewer than 3 vertices. Faces
// of k vertices of which r are not convex take k times r steps.
Result<Triangulation> triangulate(ControlMesh& mesh, const Budget& budget = {});

// Bytes that it needs to cut a face of `corners` corners, beyond those of the arrays it makes.
Count triangulating_bytes(Count corners);

}  // namespace subdivd

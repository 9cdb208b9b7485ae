#pragma once
// Which of OpenSubdiv's schemes a mesh asks for, and what its faces are refined as. Includes no OpenSubdiv.

#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/mesh/control_mesh.h"
#include "core/oracle/grids.h"

namespace subdivd::oracle {

enum class FarScheme { loop, catmull_clark, bilinear };

// Fails as scheme_of() of core/refine/plan.h, and with unsupported for a scheme that OpenSubdiv does not
// have. The options of the scheme play no part: beyond_opensubdiv() of core/schemes/all.h judges them.
Result<FarScheme> far_scheme_of(const ControlMesh& mesh, const Pace& pace);

GridShape grid_shape_of(const ControlMesh& mesh, FarScheme scheme, const Pace& pace);

// The corners of the faces of the control mesh.
FaceRows base_rows_of(const ControlMesh& mesh, const Pace& pace);

// Whether the mesh's scheme makes triangles, as far as its names tell: for bounds on meshes that nobody has
// checked.
bool makes_triangles(const ControlMesh& mesh);

}  // namespace subdivd::oracle

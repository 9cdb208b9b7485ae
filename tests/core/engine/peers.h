#pragma once
// Other libraries' schemes as witnesses of ours, on meshes without a border: CGAL computes in double here, OpenMesh in
// double too.

#include <vector>

#include "core/mesh/control_mesh.h"

namespace subdivd::peers {

// The points after `steps` steps, x y z each, in an order of the library's own. Empty: it does not take the mesh.
std::vector<double> cgal_doo_sabin(const ControlMesh& mesh, int steps);
std::vector<double> cgal_sqrt3(const ControlMesh& mesh, int steps);  // borders too
std::vector<double> openmesh_sqrt3(const ControlMesh& mesh, int steps);
std::vector<double> openmesh_butterfly(const ControlMesh& mesh, int steps);

}  // namespace subdivd::peers

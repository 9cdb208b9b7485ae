#pragma once
// What the tests of the plain engine share: level 0 of a control mesh of any faces, and sums of rows.

#include <string>
#include <vector>

#include "core/engine/plain/level.h"
#include "core/engine/plain/step_rows.h"
#include "core/mesh/control_mesh.h"

namespace subdivd::plain {

Polygons faces_of(const ControlMesh& mesh);
Level base_level(const ControlMesh& mesh, CreaseMethod method = CreaseMethod::uniform);

// The length of the diagonal of the points' box.
double diagonal(const std::vector<double>& points);

// The rows of a step without sums: those are written out. Each row's columns ascend.
SparseRows written_out(const StepRows& step);
double sum_of_row(const SparseRows& rows, Count row);

// How the numbers of a mesh were changed: vertex_at[v] is where vertex v went; a face went to face_at[f], and
// begins `turned[f]` corners later.
struct Renumbered {
  ControlMesh mesh;
  std::vector<Index> vertex_at, face_at, turned;
};
// Points and faces in another order that the seed chooses, tags with them; primvars and holes are left out.
Renumbered renumbered(const ControlMesh& mesh, std::uint64_t seed);

// Whether no edge has more than two faces, and no two faces run along one in the same direction.
bool is_manifold(const Adjacency& faces);

}  // namespace subdivd::plain

#pragma once
// Quads and larger faces of refined meshes as triangles, for answers that are asked for them: a face (a, b, c, d, …)
// becomes (a, b, c) (a, c, d) …, as in glTF answers.

#include <vector>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/refine/refine.h"
#include "core/refine/refined_mesh.h"
#include "proto/wire.h"

namespace subdivd::proto {

// Whether the answer's meshes are to be cut. Those of glTF answers, which hold triangles always, cut themselves.
bool cuts_faces(const RefineRequest& request);

// What refine() would return, once it is cut: faces, corners and their kind. Call it where cuts_faces().
RefinedSize cut_size(RefinedSize size);

// Bytes of the arrays that cutting makes, at most, beside those of the refined mesh. `cut`: of cut_size(); `scalar`:
// of a value's number.
Count cutting_bytes(const ControlMesh& mesh, const RefinedSize& cut, Count scalar);

// Cuts all faces; face-varying indices, uniform values and base faces follow. Points and their values stay, and so do
// render meshes, whose ranges of faces no longer hold. Linear in the corners.
template <class Real>
Result<void> cut_faces(RefinedMesh<Real>& mesh, const Budget& budget);

extern template Result<void> cut_faces(RefinedMesh<float>&, const Budget&);
extern template Result<void> cut_faces(RefinedMesh<double>&, const Budget&);

}  // namespace subdivd::proto

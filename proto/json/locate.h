#pragma once
// From the core's places to the caller's: the core counts in flat arrays of the mesh it was given, the caller
// may have written nested ones, and faces may have been split or left out on the way.

#include <vector>

#include "core/base/index.h"
#include "core/base/result.h"
#include "core/curves/control_curve.h"
#include "core/mesh/control_mesh.h"
#include "core/surfaces/patch.h"
#include "proto/wire.h"

namespace subdivd::proto::json {

// What was done to a mesh between reading and checking; empty vectors: nothing.
struct FaceHistory {
  std::vector<Index> counts;        // faceVertexCounts as read, when faces were changed; empty: triangles
  std::vector<Index> triangulated;  // face as read of every face after triangulate()
  std::vector<Index> corners;       // corner as read of every corner after triangulate()
  std::vector<Index> kept;          // face after triangulate() of every face after drop_degenerate_faces()
  // Creases as read, when faces were dropped; some may have been cut.
  std::vector<Index> crease_indices, crease_lengths;
  bool sharp_edges = false;  // of those creases every edge has a sharpness, not every crease

  bool changed() const { return !triangulated.empty() || !kept.empty(); }
  // The face as read that a present face came from; all of them, or empty when they are the same.
  Index original_face(Index face) const;
  std::vector<Index> original_faces() const;
};

// `where` as the core gives it for the mesh as it is now, e.g. {"points", 17}, counted in the flat array;
// returns the path below the mesh in the body, e.g. {"points", 5, 2}.
Path locate(Path where, const ControlMesh& mesh, const JsonMeshForm& form, const FaceHistory& history = {});

// The same for curves and surfaces.
Path locate(Path where, const ControlCurves& curves, const JsonCurvesForm& form);
Path locate(Path where, const ControlPatch& surface, const JsonSurfaceForm& form);

}  // namespace subdivd::proto::json

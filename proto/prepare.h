#pragma once
// Between reading and refining: repairs what may be repaired, checks everything, and turns the core's places
// into the caller's.

#include <cstddef>
#include <string>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "proto/wire.h"

namespace subdivd::proto {

// Triangulates (when the options say so), drops degenerate faces with a warning, checks every mesh, curve and
// surface. Left-handed meshes become right-handed unless the answer is JSON.
// Fills face_origins.
Result<void> prepare(RefineRequest& request, const Budget& budget);

// `error` about mesh, curve or surface number `i` (`of`: "meshes", "curves" or "surfaces") with its place in
// the body: for JSON /meshes/i/… or, when a single mesh stands at the top, /…; for glTF, OBJ and
// OFF, which have no arrays of numbers to point into, the message names the mesh.
Error blame_input(const RefineRequest& request, Error error, const char* of, std::size_t i);

}  // namespace subdivd::proto

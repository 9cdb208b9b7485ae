#pragma once
// Two refined meshes over the same faces (a render mesh, and the mesh or a channel of it): which vertex of
// the one lies where a vertex of the other does.

#include <span>

#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/lattice/lattice.h"

namespace subdivd {

// For every refined vertex of `part` that of `whole` at the same place of the same face. Face f of `part` is
// face first_face + f of `whole`, corner for corner. `holes`: one flag per face of `part`; vertices that only
// holes have, and those without a face, get kNoIndex.
Buffer<Index> vertex_sources(const Lattice& part, const Lattice& whole, Index first_face, Index level,
                             std::span<const unsigned char> holes, const Pace& pace);

}  // namespace subdivd

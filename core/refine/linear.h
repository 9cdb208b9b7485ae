#pragma once
// Values that are linear over every control face: what a varying primvar is, and a channel whose mode says so.

#include <span>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/lattice/lattice.h"

namespace subdivd {

// The values of a level from those of the control vertices, `width` scalars each: barycentric over triangles, bilinear
// over quads; points of no face stay. Of a lattice whose grids start at level 0. `out` has room for
// lattice.vertex_count(level) * width. Instantiated for float and double.
template <class Real>
void interpolate_linearly(const Lattice& lattice, Index level, std::span<const Real> control, Index width,
                          Real* out, const Pace& pace);

}  // namespace subdivd

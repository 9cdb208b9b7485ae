#pragma once
// Values refined on a net: the engine's second half, and the door of both engines on grids. The first half, everything
// that does not depend on values, is core/engine/net.h.

#include <span>
#include <utility>

#include "core/base/budget.h"
#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/engine/grid/evaluated.h"
#include "core/engine/net.h"

namespace subdivd {

// Refines values on a net to `level` (at most net.max_level()): `control` holds width scalars per vertex of
// the net, in its order, and may be used up. It is copied if it has no room for kSpareControl more. What is written
// depends neither on `threads` (at least 1) nor on the processor. Working memory: `control` and a third of `values`, and
// all of it more when out.values is null. For float and double: Triangles by core/engine/tri_grid, Quads by
// core/engine/quad_grid.
template <class Real, class Faces>
Result<void> evaluate(const Net<Faces>& net, Index level, Buffer<Real>&& control, Index width,
                      Smoothing smoothing, const Evaluated<Real>& out, Index threads, const Budget& budget);

#define SUBDIVD_DECLARE(Real, Faces)                                                                        \
  template <>                                                                                               \
  Result<void> evaluate(const Net<Faces>&, Index, Buffer<Real>&&, Index, Smoothing, const Evaluated<Real>&, \
                        Index, const Budget&);
SUBDIVD_DECLARE(float, Triangles)
SUBDIVD_DECLARE(double, Triangles)
SUBDIVD_DECLARE(float, Quads)
SUBDIVD_DECLARE(double, Quads)
#undef SUBDIVD_DECLARE

// With room for what steps read past the end.
template <class Real>
Buffer<Real> copy_of_control(std::span<const Real> control) {
  Buffer<Real> copy;
  copy.reserve(control.size() + kSpareControl);
  copy.assign(control.begin(), control.end());
  return copy;
}

// The same for values that are to be kept.
template <class Real, class Faces>
Result<void> evaluate(const Net<Faces>& net, Index level, std::span<const Real> control, Index width,
                      Smoothing smoothing, const Evaluated<Real>& out, Index threads, const Budget& budget) {
  return evaluate<Real>(net, level, copy_of_control(control), width, smoothing, out, threads, budget);
}

}  // namespace subdivd

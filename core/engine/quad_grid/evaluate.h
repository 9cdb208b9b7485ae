#pragma once
// Values refined on a net: the engine's second half. The first, everything that does not depend on values, is
// core/engine/net.h.

#include <span>

#include "core/base/budget.h"
#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/engine/grid/evaluated.h"
#include "core/engine/net.h"

namespace subdivd {

// Refines values on a net to `level` (at most net.max_level()): `control` holds width scalars per vertex of
// the net, in its order. What is written depends neither on `threads` (at least 1) nor on the processor.
// Instantiated for float and double. Working memory: `control` and a third of `values`, and all of it more
// when out.values is null.
template <class Real>
Result<void> evaluate(const Net<Quads>& net, Index level, std::span<const Real> control, Index width,
                      Smoothing smoothing, const Evaluated<Real>& out, Index threads, const Budget& budget);

// The same for an array that may be used up. It is copied if it has no room for kSpareControl more.
template <class Real>
Result<void> evaluate(const Net<Quads>& net, Index level, Buffer<Real>&& control, Index width,
                      Smoothing smoothing, const Evaluated<Real>& out, Index threads, const Budget& budget);

}  // namespace subdivd

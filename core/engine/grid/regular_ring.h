#pragma once
// The rings of points that are regular, inside a base face or an edge of two faces, as core/limit takes them: for what
// inner loops cannot do the short way.

#include "core/base/index.h"
#include "core/engine/net.h"
#include "core/limit/limit.h"

namespace subdivd {

// Of refined vertex number `vertex`; `values`: `width` scalars per vertex of that level. All is smooth.
template <class Faces, class Real>
Ring<Real> regular_ring(const Connectivity<Faces>& connectivity, Index level, const Real* values, Index width,
                        Index vertex);

// The frame there.
template <class Scheme, class Real>
Frame<Real> regular_frame(const Scheme& scheme, const Connectivity<FacesOf<Scheme>>& connectivity,
                          Index level, const Real* points, Index vertex) {
  return LimitRing<Scheme, Real>(scheme, CreaseMethod::uniform,
                                 regular_ring(connectivity, level, points, 3, vertex))
      .frames()[0];
}

}  // namespace subdivd

#pragma once
// Limits of the last level that a refiner has, by Far. Internal to core/oracle: includes OpenSubdiv.

#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/oracle/far_refiner.h"
#include "core/oracle/far_scheme.h"

namespace subdivd::oracle {

// Of values of any width, one per vertex.
template <class Real>
Buffer<Real> far_limits(const OpenSubdiv::Far::TopologyRefiner& refiner, Buffer<Real>& values, Index width,
                        const Pace& pace);

template <class Real>
struct FarFrames {
  Buffer<Real> points, tangents_u, tangents_v;  // x y z per vertex
};

// Of points. Tangents of non-manifold vertices mean nothing, and may be 0.
template <class Real>
FarFrames<Real> far_frames(const OpenSubdiv::Far::TopologyRefiner& refiner, FarScheme scheme,
                           Buffer<Real>& points, const Pace& pace);

}  // namespace subdivd::oracle

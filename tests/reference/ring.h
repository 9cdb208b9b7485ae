#pragma once
// Rings as the limit masks take them, gathered the plain way: from the topology of a level.

#include <span>

#include "core/base/index.h"
#include "core/limit/limit.h"
#include "core/mesh/sharpness.h"
#include "core/mesh/topology.h"

namespace subdivd::plain {

// A mesh or channel at some level.
struct SharpTopology {
  const Topology<Triangles>& topology;
  const Sharpness& sharpness;
};

// The ring of vertex v. `values`: width scalars per vertex of the topology. For a channel, `mesh` is the mesh
// over the same faces at the same level, whose edges decide how sharpness decays; for the mesh itself the two
// are the same. Instantiated for float and double.
template <class Real>
Ring<Real> ring_of(CreaseMethod method, const SharpTopology& own, const SharpTopology& mesh, Index v,
                   std::span<const Real> values, Index width);

}  // namespace subdivd::plain

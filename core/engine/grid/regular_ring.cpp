#include "core/engine/grid/regular_ring.h"

#include <algorithm>

#include "core/lattice/numbering.h"
#include "core/lattice/quads.h"

namespace subdivd {

template <class Faces, class Real>
Ring<Real> regular_ring(const Connectivity<Faces>& connectivity, Index level, const Real* values, Index width,
                        Index vertex) {
  const auto around = Numbering(connectivity, level).regular_ring(vertex);
  Ring<Real> ring;
  ring.width = width;
  ring.center.resize(width);
  ring.neighbors.resize(around.edges.size() * width);
  ring.opposite.resize(around.opposite.size() * width);
  const auto copy = [&](Index from, Real* to) { std::copy_n(values + Count{from} * width, width, to); };
  copy(vertex, ring.center.data());
  for (std::size_t k = 0; k < around.edges.size(); ++k)
    copy(around.edges[k], ring.neighbors.data() + k * width);
  for (std::size_t k = 0; k < around.opposite.size(); ++k)
    copy(around.opposite[k], ring.opposite.data() + k * width);
  ring.edge_sharpness.assign(around.edges.size(), 0.0f);
  ring.far_child.assign(around.edges.size(), 0.0f);
  ring.set_fan(static_cast<Index>(around.edges.size()), true);
  return ring;
}

#define SUBDIVD_INSTANTIATE(Faces)                                                                  \
  template Ring<float> regular_ring(const Connectivity<Faces>&, Index, const float*, Index, Index); \
  template Ring<double> regular_ring(const Connectivity<Faces>&, Index, const double*, Index, Index);
SUBDIVD_INSTANTIATE(Triangles)
SUBDIVD_INSTANTIATE(Quads)
#undef SUBDIVD_INSTANTIATE

}  // namespace subdivd

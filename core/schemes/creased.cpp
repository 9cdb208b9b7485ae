#include "core/schemes/creased.h"

namespace subdivd {

EdgeMask creased_edge(const EdgeMask& smooth, const EdgeRing& ring) {
  const EdgeMask crease{1.0 / 2, 0};
  if (!is_sharp(ring.sharpness)) return smooth;
  if (is_sharp(ring.child_sharpness[0]) && is_sharp(ring.child_sharpness[1])) return crease;
  // Under Chaikin's rule an edge of sharpness above 1 may have a half that runs out at once: the blend is
  // then beyond the crease, 1.2 crease - 0.2 smooth. So does Far 3.5, the reference everybody has, though its
  // comment says that it clamps; under the uniform method this cannot happen.
  const double s = ring.sharpness;
  return {s * crease.end + (1 - s) * smooth.end, (1 - s) * smooth.opposite, (1 - s) * smooth.face};
}

VertexMask crease_vertex_mask(std::span<const float> edge_sharpness) {
  VertexMask mask{3.0 / 4, 0, 1.0 / 8, {0, 0}};
  bool first = true;
  for (std::size_t k = 0; k < edge_sharpness.size(); ++k)
    if (is_sharp(edge_sharpness[k])) {
      if (first) mask.crease_ends[0] = static_cast<Index>(k);
      mask.crease_ends[1] = static_cast<Index>(k);
      first = false;
    }
  return mask;
}

}  // namespace subdivd

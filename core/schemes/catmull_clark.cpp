#include "core/schemes/catmull_clark.h"

#include <algorithm>

#include "core/schemes/creased.h"

namespace subdivd {

EdgeMask CatmullClark::edge_mask(const EdgeRing& ring) const {
  EdgeMask smooth{1.0 / 4, 0, 1.0 / 2 / std::max<Index>(ring.face_count, 1)};
  if (triangles == TriangleRule::smooth && ring.face_count == 2 && ring.triangle_count > 0) {
    constexpr double kOfTriangle = 0.470, kOfOther = 1.0 / 4;
    smooth.face = ring.triangle_count == 2 ? kOfTriangle : (kOfTriangle + kOfOther) / 2;
    smooth.end = (1 - 2 * smooth.face) / 2;
  }
  return creased_edge(smooth, ring);
}

VertexMask CatmullClark::vertex_mask(const VertexRing& ring) const {
  return creased_vertex(ring, [&] {
    const double n = ring.face_count;
    return VertexMask{(n - 2) / n, 1 / (n * n), 0, {0, 0}, 1 / (n * n)};
  });
}

}  // namespace subdivd

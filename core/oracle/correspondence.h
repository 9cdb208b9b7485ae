#pragma once
// Which of our vertices and triangles is which of Far's. Two independent ways must agree: the place on the
// control mesh that each side gives for its vertices, and the closed-form order of our triangles. Positions
// play no part.

#include <span>

#include "core/base/buffer.h"
#include "core/base/pace.h"
#include "core/oracle/far.h"
#include "core/refine/refined_mesh.h"

namespace subdivd::oracle {

// What the comparison needs of our side, independent of Real.
struct OurConnectivity {
  Index level = 0;
  std::span<const Index> faces, base_faces;
  std::span<const Provenance> provenance;
};

struct Correspondence {
  Buffer<Index> vertices;   // per Far vertex: ours, kNoIndex when there is none
  Buffer<Index> triangles;  // per Far face: ours, kNoIndex for holes and where none fits
  // Per Far face corner: our corner 3 t + k; kNoIndex where the triangle is missing or another.
  Buffer<Index> corners;
  // Every vertex has exactly one partner and every triangle that is no hole, on either side; triangles have
  // the same corners in the same order up to rotation, and the same base face.
  bool identical = false;
};

// Throws Stopped.
template <class Real>
Correspondence match(const OurConnectivity& ours, const FarLevel<Real>& far, const Pace& pace);

}  // namespace subdivd::oracle

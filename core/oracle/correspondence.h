#pragma once
// Which of our vertices and faces is which of Far's. Two independent ways must agree: the place on the
// control mesh that each side gives for its vertices, and the closed-form order of our faces. Positions play
// no part.

#include <span>

#include "core/base/buffer.h"
#include "core/base/pace.h"
#include "core/oracle/far.h"
#include "core/refine/refined_mesh.h"

namespace subdivd::oracle {

// What the comparison needs of our side, independent of Real.
struct OurConnectivity {
  Index level = 0;
  FaceRows rows;  // the corners of each face
  std::span<const Index> faces, base_faces;
  std::span<const Provenance> provenance;
};
template <class Real>
OurConnectivity connectivity_of(const RefinedMesh<Real>& ours, const Pace& pace);

struct Correspondence {
  Buffer<Index> vertices;  // per Far vertex: ours, kNoIndex when there is none
  Buffer<Index> faces;     // per Far face: ours, kNoIndex for holes and where none fits
  // Per Far face corner: ours, of all face corners; kNoIndex where the face is missing or another.
  Buffer<Index> corners;
  // Every vertex has exactly one partner, and every face that is no hole and not left out where Far gives it
  // all the same, on either side; faces have the same corners in the same order up to rotation, and the same
  // base face.
  bool identical = false;
};

// Throws Stopped.
template <class Real>
Correspondence match(const OurConnectivity& ours, const FarLevel<Real>& far, const Pace& pace);

}  // namespace subdivd::oracle

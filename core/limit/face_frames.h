#pragma once
// How a surface lies at its vertices as far as the faces around them tell: for schemes that have no masks of tangents
// there. Comes closer to the limit surface's own tangent plane with every level.

#include <span>
#include <vector>

#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/limit/limit.h"

namespace subdivd {

// Of every vertex: the normal is the mean of its corners' normals, each weighted by the sine of its corner; u lies along
// the edge that the first of these corners leaves by, as far as that is in the plane, v across. All three are unit
// vectors; all are zero where there is no face, or normals cancel.
template <class Real>
class FaceFrames {
 public:
  // `points`: x y z per vertex. `corners`: of faces of `face_size` corners, face after face.
  FaceFrames(std::span<const Real> points, Index face_size, std::span<const Index> corners, const Pace& pace);

  Frame<Real> at(Index vertex) const;

  // What it takes.
  static Count bytes(Count vertices) { return 6 * vertices * sizeof(Real); }

 private:
  Buffer<Real> normals_, edges_;  // x y z per vertex
};

}  // namespace subdivd

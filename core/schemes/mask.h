#pragma once
// Weights in a neighbourhood, in double whatever the mesh is computed in.

#include <vector>

#include "core/base/index.h"

namespace subdivd {

// Edge point = end (a + b) + opposite (o0 + o1 + ...) + face (f0 + f1 + ...), f_k being the points of its faces
// where the split makes such.
struct EdgeMask {
  double end = 0.5, opposite = 0, face = 0;
};

// Vertex point or limit point = self v + each (e_0 + ... + e_{n-1}) + crease (e_a + e_b), a and b being the
// crease's edges in the ring's order, + face (f_0 + f_1 + ...) as above. The crease pair is (0, 0) where crease
// is 0.
struct VertexMask {
  double self = 1, each = 0, crease = 0;
  Index crease_ends[2] = {0, 0};
  double face = 0;
};

// One weight per ring edge, for masks that tell the edges apart.
struct RingMask {
  double self = 0;
  std::vector<double> edges;
};

// Point of corner k of a face of n corners, where every corner gets one: self v_k + beside (v_{k-1} + v_{k+1}) +
// mean (v_0 + ... + v_{n-1}) / n + wave (cos(2 pi (i - k) / n) v_i summed over i) / n. In this form, and not as n
// weights, because all corners of a face together then take time in n and not in n^2.
struct CornerMask {
  double self = 1, beside = 0, mean = 0, wave = 0;
};

}  // namespace subdivd

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
// crease's edges in the ring's order, + face (f_0 + f_1 + ...): of a vertex point f_k is as above, of a limit point
// the vertex that lies opposite to v in a quad. The crease pair is (0, 0) where crease is 0.
struct VertexMask {
  double self = 1, each = 0, crease = 0;
  Index crease_ends[2] = {0, 0};
  double face = 0;
};

// One weight per ring edge, for masks that tell the edges apart; and where faces are quads one for the vertex
// opposite to v in each face, face k lying between the edges k and k + 1.
struct RingMask {
  double self = 0;
  std::vector<double> edges, faces = {};
};

inline double sum_of(const RingMask& mask) {
  double sum = mask.self;
  for (const double weight : mask.edges) sum += weight;
  for (const double weight : mask.faces) sum += weight;
  return sum;
}

}  // namespace subdivd

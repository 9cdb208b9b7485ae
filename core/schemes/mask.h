#pragma once
// Weights in a neighbourhood, in double whatever the mesh is computed in.

#include <complex>
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

// Point of corner k of a face of n corners, where every corner gets one: self v_k + beside (v_{k-1} + v_{k+1}) +
// mean (v_0 + ... + v_{n-1}) / n + wave (cos(2 pi (i - k) / n) v_i summed over i) / n. In this form, and not as n
// weights, because all corners of a face together then take time in n and not in n^2.
struct CornerMask {
  double self = 1, beside = 0, mean = 0, wave = 0;
};

// --- Of interpolating schemes ---------------------------------------------------------------------------------

// Between a vertex v and the end e_i of edge i, from all edges around v: self v + the sum over all j of
// (wave[0] + wave[1] cos(2 pi (j - i) / n) + wave[2] cos(4 pi (j - i) / n)) e_j / n. As waves, and not as n weights,
// because all edges of a ring together then take time in n and not in n^2.
struct WaveMask {
  double self = 1, wave[3] = {0, 0, 0};
};

// The same in a sector of k faces between two creases, edges 0 and k: self v + first e_0 + last e_k + the sum over
// 0 < j < k of (sine[0] sin(pi j / k) + sine[1] sin(2 pi j / k)) e_j.
struct SectorMask {
  double self = 1, first = 0, last = 0, sine[2] = {0, 0};
};

// Where the line from l_i through a vertex v inside goes on behind v, of whose edges and faces l are the other ends and
// k the opposite corners (k_j between l_j and l_{j+1}): all_ends times the sum of l + near_ends (l_{i-1} + l_i +
// l_{i+1}) + near_faces (k_{i-2} + k_{i-1} + k_i + k_{i+1}) + all_faces times the sum of k.
struct ExtensionMask {
  double all_ends = 0, near_ends = 0, near_faces = 0, all_faces = 0;
};

// Two tangents at a vertex v inside, of n edges, from two rings around it: real and minus imaginary part of the sum over all
// j of exp(-2 pi i j / n) (end l_j + face k_j + behind m_j + beside a_j + beyond c_j + across b_j). Sector j has the corners
// l_j and k_j of its face at v; m_j lies behind l_j, c_j behind k_j opposite to v, a_j between m_j and c_j, b_j between c_j
// and m_{j+1}.
struct TwoRingMask {
  std::complex<double> end, face, behind, beside, beyond, across;
};

// On an edge (a, b) whose surroundings are regular: end (a + b) + opposite (o_0 + o_1) + wing (w_0 + ... + w_3), o being
// opposite to it in its faces, w across the other edges of those.
struct WingMask {
  double end = 0.5, opposite = 0, wing = 0;
};

}  // namespace subdivd

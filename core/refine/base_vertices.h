#pragma once
// The base vertices through the levels: each needs itself and the points beside it on its edges.

#include <array>
#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/limit/limit.h"
#include "core/refine/evaluate.h"
#include "core/refine/net.h"

namespace subdivd {

template <class Scheme, class Real>
class BaseVertices {
 public:
  BaseVertices(const Net& net, const Scheme& scheme, Index width, Smoothing smoothing);

  // The values at level + 1, from those of `level`, of those of the base vertices [begin, end) that inner loops
  // (core/refine/kernels) leave alone; overwrites what they write of unsettled ones. Both arrays in the
  // closed-form numbering. Not for linear smoothing.
  void refine(Index level, const Real* from, Real* to, Index begin, Index end) const;
  // Per valence of the net that is listed: weight of the vertex, of each neighbour.
  std::vector<Real> smooth_masks() const;

  // Limits and frames at base vertices [begin, end).
  void limit(Index level, const Real* values, const Evaluated<Real>& out, Index begin, Index end) const;

  // Tables of what `limit` needs beside `refine`. Call once before it.
  void prepare_limits(bool frames);

 private:
  struct Valence {
    VertexMask vertex, limit;
    std::vector<Real> tangent_u, tangent_v;
  };

  // Number of the point of edge e next to its end v.
  Count beside(Count n, Index e, Index v) const {
    const auto& ends = net_.topology().edge_vertices()[e];
    if (n == 1) return ends[0] == v ? ends[1] : ends[0];
    return net_.topology().vertex_count() + e * (n - 1) + (ends[0] == v ? 0 : n - 2);
  }
  VertexMask smooth_mask(Index valence) const;
  void refine_special(Count n, const Real* from, Real* to, Index v) const;
  void refine_unsettled(Index level, const Real* from, Real* to, Index v) const;
  template <class Width>
  [[gnu::always_inline]] inline void weigh(Count n, const Real* from, Index v, const VertexMask& mask,
                                           Real* out, Width width) const;
  std::array<Index, 2> crease_edges(Index v) const;
  template <class Width>
  void limit_settled(Count n, const Real* values, Index v, Real* out, Width width) const;
  void smooth_frame(Count n, const Real* values, Index v, Frame<Real>& frame) const;
  void limit_by_ring(Index level, const Real* values, const Evaluated<Real>& out, Index v,
                     bool frames_only) const;
  Ring<Real> ring(Index level, const Real* values, Index v) const;

  const Net& net_;
  Scheme scheme_;
  Index width_;
  bool linear_;
  VertexMask crease_;
  std::array<Valence, Net::kListedValence + 1> table_;  // of the net's valences
};

// Writes what `out` asks for of one vertex's frames.
template <class Real>
void write_frames(std::span<const Frame<Real>> frames, const Evaluated<Real>& out, Count vertex);

}  // namespace subdivd

#pragma once
// The base vertices through the levels: each needs itself and the points beside it on its edges.

#include <array>
#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/engine/grid/evaluated.h"
#include "core/engine/net.h"
#include "core/limit/limit.h"

namespace subdivd {

template <class Scheme, class Real>
class BaseVertices {
 public:
  using Faces = FacesOf<Scheme>;

  BaseVertices(const Net<Faces>& net, const Scheme& scheme, Index width, Smoothing smoothing);

  // The values at level + 1, from those of `level`, of those of the base vertices [begin, end) that inner
  // loops (the kernels of the engine) leave alone; overwrites what they write of unsettled ones. Both
  // arrays in the closed-form numbering. Not for linear smoothing.
  void refine(Index level, const Real* from, Real* to, Index begin, Index end, const Pace& pace) const;
  // Per valence up to kListedValence, of those that the net has: weight of the vertex, of each neighbour on an edge,
  // and where faces are quads of each vertex opposite to it in one.
  std::vector<Real> smooth_masks() const;

  // The same for limits and frames. Not for linear smoothing either. prepare_limits comes first, once.
  void prepare_limits(Index level, const Pace& pace);
  void limit(Index level, const Real* values, const Evaluated<Real>& out, Index begin, Index end,
             const Pace& pace) const;
  std::vector<Real> limit_masks() const;
  // Per valence up to kListedValence, as many pairs of weights of the neighbours in the two tangents; where faces are
  // quads each pair is followed by that of the vertex opposite in the face behind the edge.
  std::vector<Real> tangent_masks() const;

  // The frame of a smooth vertex, the long way.
  Frame<Real> frame(Index level, const Real* values, Index v, const Pace& pace) const {
    return LimitRing<Scheme, Real>(scheme_, net_.crease_method(), ring(level, values, v, pace), pace)
        .frames()[0];
  }

 private:
  // Number of the point of edge e next to its end v.
  Count beside(Count n, Index e, Index v) const {
    const auto& ends = net_.topology().edge_vertices()[e];
    if (n == 1) return ends[0] == v ? ends[1] : ends[0];
    return net_.topology().vertex_count() + e * (n - 1) + (ends[0] == v ? 0 : n - 2);
  }
  VertexMask smooth_mask(Index valence) const;
  void refine_unsettled(Index level, const Real* from, Real* to, Index v, const Pace& pace) const;
  // What a vertex mask's faces are: their points, or the vertices opposite to v in them.
  enum class FaceTerm { points, opposite };
  void weigh(Index level, const Real* from, Index v, const VertexMask& mask, FaceTerm term, Real* out,
             const Pace& pace) const;
  void refine_special(Index level, const Real* from, Real* to, Index v, const Pace& pace) const;
  // Calls f(v) for those in [begin, end) of ascending vertices.
  template <class F>
  static void for_each_in(std::span<const Index> vertices, Index begin, Index end, F&& f) {
    for (auto at = std::ranges::lower_bound(vertices, begin); at != vertices.end() && *at < end; ++at) f(*at);
  }
  std::array<Index, 2> crease_edges(Index v) const;
  void limit_special(Index level, const Real* values, const Evaluated<Real>& out, Index v,
                     const Pace& pace) const;
  void limit_by_ring(Index level, const Real* values, const Evaluated<Real>& out, Index v, bool frames_only,
                     const Pace& pace) const;
  Ring<Real> ring(Index level, const Real* values, Index v, const Pace& pace) const;

  static constexpr bool kHasFacePoints = Scheme::split == Split::quads;
  static constexpr Index kWeights = kHasFacePoints ? 3 : 2;
  static void put_weights(const VertexMask& mask, FaceTerm term, Index n, Real* out);

  const Net<Faces>& net_;
  Scheme scheme_;
  Index width_;
  bool linear_;
  VertexMask crease_;
  std::array<VertexMask, kListedValence + 1> smooth_;  // of the net's valences
  // Under Chaikin's rule, per unsettled vertex of the mesh: how its edges decay. For limits.
  std::vector<std::vector<DecaySum>> decay_sums_;
};

}  // namespace subdivd

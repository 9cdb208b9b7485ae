#pragma once
// What is not plain along base edges: the points of semi-sharp ones, and limits where the surface is creased.
// All else about edges are inner loops (the kernels of the engine).

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/engine/grid/evaluated.h"
#include "core/engine/net.h"
#include "core/limit/limit.h"

namespace subdivd {

template <class Scheme, class Real>
class BaseEdges {
 public:
  using Faces = FacesOf<Scheme>;

  BaseEdges(const Net<Faces>& net, const Scheme& scheme, Index width)
      : net_(net), scheme_(scheme), width_(width) {}

  // Overwrites, at level + 1, the points inside those of the base edges [begin, end) that are semi-sharp at
  // `level`.
  void refine_semi_sharp(Index level, const Real* from, Real* to, Index begin, Index end) const;

  // Limits and frames inside those of the base edges [begin, end) that are not both smooth and settled.
  void limit(Index level, const Real* values, const Evaluated<Real>& out, Index begin, Index end,
             const Pace& pace) const;

 private:
  void refine_strip(Index level, std::size_t position, const Real* from, Real* to) const;
  void limit_crease(Index level, const Real* values, const Evaluated<Real>& out, Index e,
                    const Pace& pace) const;
  void limit_semi_sharp(Index level, std::size_t position, const Real* values,
                        const Evaluated<Real>& out) const;

  static constexpr bool kHasFacePoints = Scheme::split == Split::quads;

  const Net<Faces>& net_;
  Scheme scheme_;
  Index width_;
};

}  // namespace subdivd

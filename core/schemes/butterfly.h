#pragma once
// The modified butterfly scheme of triangle meshes, which interpolates: every mask, its formula, its source.
//
// [DynLevinGregory90]  N. Dyn, D. Levin, J. Gregory, A Butterfly Subdivision Scheme for Surface Interpolation with
//                      Tension Control, ACM Transactions on Graphics 9(2), 1990
// [Zorin96]            D. Zorin, P. Schroeder, W. Sweldens, Interpolating Subdivision for Meshes with Arbitrary
//                      Topology, SIGGRAPH 96
// [Zorin00]            D. Zorin, P. Schroeder, Subdivision for Modeling and Animation, SIGGRAPH 2000 course notes

#include <span>
#include <string_view>

#include "core/schemes/scheme.h"

namespace subdivd {

// Old points never move. Which mask an edge point takes by what its ends are  [Zorin00]:
//   both regular                  the wing mask
//   one extraordinary             that one's, whether it lies inside or on a crease
//   both extraordinary            the mean of theirs
// On borders and infinitely sharp edges the four-point rule.
struct Butterfly {
  static constexpr std::string_view name = "butterfly";
  static constexpr Split split = Split::triangles;
  static constexpr FaceSizes face_sizes{3, 3};
  static constexpr Index regular_valence = 6;
  static constexpr bool takes_semi_sharp = false;

  static constexpr double tension = 1.0 / 16;

  static std::span<const SchemeOption<Butterfly>> options() { return {}; }
  // See beyond_opensubdiv() of all.h.
  std::string_view beyond_opensubdiv() const { return "does not know this scheme: leave out verify"; }

  // 1/2 (a + b) + 1/8 (o_0 + o_1) - 1/16 (w_0 + ... + w_3)                            [DynLevinGregory90]
  WingMask wing_mask() const { return {1.0 / 2, 1.0 / 8, -1.0 / 16}; }
  bool is_regular(Index n) const { return n == 6; }
  // n >= 5: 3/4 v + the sum of (1/4 + cos(2 pi j / n) + 1/2 cos(4 pi j / n)) / n e_j;
  // n = 4: 3/4 v, 3/8, 0, -1/8, 0;  n = 3: 3/4 v, 5/12, -1/12, -1/12                          [Zorin96]
  // n = 2, which has no source: the middle.
  WaveMask ring_mask(Index n) const;
  bool is_regular_sector(Index k) const { return k == 3; }
  // With theta = pi / k                                                                       [Zorin00]
  //   v    1 - sin(theta) sin(i theta) / (k (1 - cos(theta)))
  //   e_0, -e_k    1/4 cos(i theta) - sin(2 theta) sin(2 i theta) / (4 k (cos(theta) - cos(2 theta)))
  //   e_j  (sin(i theta) sin(j theta) + 1/2 sin(2 i theta) sin(2 j theta)) / k
  SectorMask sector_mask(Index k, Index i) const;
};

}  // namespace subdivd

#pragma once
// Doo and Sabin's subdivision of polygon meshes, the dual scheme: faces shrink, and new ones stand in the place of
// edges and vertices. The generalisation of biquadratic B-splines.
//
// [DooSabin78]  D. Doo, M. Sabin, Behaviour of Recursive Division Surfaces near Extraordinary Points,
//               Computer-Aided Design 10, 1978
// [Zorin00]     D. Zorin, P. Schroeder, Subdivision for Modeling and Animation, SIGGRAPH 2000 course notes

#include <span>
#include <string_view>

#include "core/schemes/scheme.h"

namespace subdivd {

// The weights within a face. The two agree at faces of four corners only.
enum class DooSabinWeights { doo_sabin, midpoint };

// Borders and infinitely sharp edges are Chaikin's curves of their own points: the engine's matter
// (core/engine/plain/corner_split.h), as there is nothing to choose.
struct DooSabin {
  static constexpr std::string_view name = "dooSabin";
  static constexpr Split split = Split::corners;
  static constexpr FaceSizes face_sizes{3, kNoIndex};
  static constexpr Index regular_valence = 4;
  static constexpr bool takes_semi_sharp = false;

  DooSabinWeights weights = DooSabinWeights::doo_sabin;

  static std::span<const SchemeOption<DooSabin>> options();
  // See beyond_opensubdiv() of all.h.
  std::string_view beyond_opensubdiv() const { return "does not know this scheme: leave out verify"; }

  // Of a face of n corners, w_i being the weight of the corner i steps on:
  //   doo_sabin  w_0 = 1/4 + 5/(4n), w_i = (3 + 2 cos(2 pi i / n)) / (4n); that is v/4, 3/4 of the centroid and half
  //              of the first wave                                                        [DooSabin78]
  //   midpoint   the mean of the centroid, the middles of both edges and v: w_0 = 1/2 + 1/(4n), neighbours
  //              1/8 + 1/(4n), others 1/(4n)      [Zorin00]
  CornerMask corner_mask(Index n) const;
};

}  // namespace subdivd

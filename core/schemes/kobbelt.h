#pragma once
// Kobbelt's interpolating subdivision of meshes of quads: every mask, its formula, its source.
//
// [Kobbelt96]          L. Kobbelt, Interpolatory Subdivision on Open Quadrilateral Nets with Arbitrary Topology,
//                      Eurographics 96, Computer Graphics Forum 15(3)
// [DynGregoryLevin87]  N. Dyn, D. Levin, J. Gregory, A 4-point Interpolatory Subdivision Scheme for Curve Design,
//                      Computer Aided Geometric Design 4, 1987

#include <span>
#include <string_view>

#include "core/schemes/scheme.h"

namespace subdivd {

// The tensor product of the four-point rule: (1/2 + w)(a + b) - w (the points before a and behind b), along the lines of
// the net for edges, and across the edges of a face for its point. Old points never move; borders and infinitely sharp
// edges are four-point curves.
//
// The point of a face can be had in two directions. On a regular net they agree, and so they do in the faces at an
// extraordinary vertex by the mask below; in the faces behind those they differ by terms of w^2, and the mean is
// taken. It is symmetric, and the choice does not touch the local matrix: around a vertex of valence n that has the
// subdominant eigenvalues 0.4263 (3), 0.5379 (5), 0.5597 (6), 0.5821 (8), 0.5987 (12), each double, of the first wave. The
// characteristic map was computed for n = 3 to 12 with either direction and with their mean, on 1,152 quads a
// sector: none is turned over, and no corner's sine is below 0.71.
struct Kobbelt {
  static constexpr std::string_view name = "kobbelt";
  static constexpr Split split = Split::quads;
  static constexpr FaceSizes face_sizes{4, 4};
  static constexpr Index regular_valence = 4;
  static constexpr bool takes_semi_sharp = false;

  static constexpr double tension = 1.0 / 16;

  static std::span<const SchemeOption<Kobbelt>> options() { return {}; }
  // See beyond_opensubdiv() of all.h.
  std::string_view beyond_opensubdiv() const { return "does not know this scheme: leave out verify"; }

  // (4/n) sum l - (l_{i-1} + l_i + l_{i+1}) + c (k_{i-2} + k_{i-1} + k_i + k_{i+1}) - (4c/n) sum k, c = w/(1/2 + w).
  // For two neighbours it differs by l_{i-1} - l_{i+2} - c (k_{i-2} - k_{i+2}), so that both directions make one point of
  // the face between them; the sums make it l_{i+2} at n = 4.     [Kobbelt96, in another form]
  ExtensionMask extension_mask(Index n) const {
    constexpr double c = tension / (1.0 / 2 + tension);
    return {4.0 / n, -1, c, -4 * c / n};
  }
  // The left eigenvector of the subdominant eigenvalue, of the first wave around a smooth vertex whose two rings are
  // otherwise regular, scaled to end = 1. n >= 3.
  TwoRingMask tangent_mask(Index n) const;
};

}  // namespace subdivd

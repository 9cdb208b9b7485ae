#pragma once
// What a subdivision scheme must offer.

#include <concepts>
#include <string_view>

#include "core/mesh/rings.h"
#include "core/schemes/mask.h"

namespace subdivd {

// How a face splits: each split has one engine in core/refine.
enum class Split { triangles };  // a triangle into four

// A scheme is a small value (its options) with pure functions of rings. Limit and tangent masks belong to a
// ring without semi-sharpness; limits refine to themselves: applying a limit mask before or after one step
// gives the same point, and tangent masks are left eigenvectors of the local subdivision matrix.
template <class S>
concept SubdivisionScheme = requires(const S& scheme, EdgeRing e, VertexRing v, Index n) {
  { S::name } -> std::convertible_to<std::string_view>;
  { S::split } -> std::convertible_to<Split>;
  { scheme.edge_mask(e) } -> std::same_as<EdgeMask>;
  { scheme.vertex_mask(v) } -> std::same_as<VertexMask>;
  // Smooth vertex of valence n; a crease; a dart whose crease runs along edge 0 of a ring in cyclic order.
  { scheme.smooth_limit_mask(n) } -> std::same_as<VertexMask>;
  { scheme.crease_limit_mask(n, n) } -> std::same_as<VertexMask>;
  { scheme.dart_limit_mask(n) } -> std::same_as<RingMask>;
};

}  // namespace subdivd

#pragma once
// What a subdivision scheme must offer.

#include <concepts>
#include <cstddef>
#include <span>
#include <string_view>

#include "core/mesh/rings.h"
#include "core/schemes/mask.h"

namespace subdivd {

// How a face splits: each split has its numbering in core/lattice and an engine in core/engine.
enum class Split { triangles };  // a triangle into four

// A choice that a scheme leaves to the caller.
template <class S>
struct SchemeOption {
  std::string_view name;                    // among all options of a request: "loopWeights"
  std::string_view short_name;              // among this scheme's own: "weights"
  std::span<const std::string_view> words;  // the first is the standard
  std::string_view help;                    // sentences
  void (*set)(S& scheme, std::size_t word) = nullptr;
  std::size_t (*get)(const S& scheme) = nullptr;
};

// A scheme is a small value (its options) with pure functions of rings. Limit and tangent masks belong to a
// ring without semi-sharpness; limits refine to themselves: applying a limit mask before or after one step
// gives the same point, and tangent masks are left eigenvectors of the local subdivision matrix.
template <class S>
concept SubdivisionScheme = requires(const S& scheme, EdgeRing e, VertexRing v, Index n) {
  { S::name } -> std::convertible_to<std::string_view>;
  { S::split } -> std::convertible_to<Split>;
  { S::options() } -> std::convertible_to<std::span<const SchemeOption<S>>>;
  { scheme.beyond_opensubdiv() } -> std::convertible_to<std::string_view>;
  { scheme.edge_mask(e) } -> std::same_as<EdgeMask>;
  { scheme.vertex_mask(v) } -> std::same_as<VertexMask>;
  // Smooth vertex of valence n; a crease; a dart whose crease runs along edge 0 of a ring in cyclic order.
  { scheme.smooth_limit_mask(n) } -> std::same_as<VertexMask>;
  { scheme.crease_limit_mask(n, n) } -> std::same_as<VertexMask>;
  { scheme.dart_limit_mask(n) } -> std::same_as<RingMask>;
};

}  // namespace subdivd

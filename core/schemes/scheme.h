#pragma once
// What a subdivision scheme must offer.

#include <concepts>
#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>

#include "core/base/pace.h"
#include "core/mesh/rings.h"
#include "core/schemes/mask.h"

namespace subdivd {

// How a face splits: each split has its numbering in core/lattice and an engine in core/engine.
enum class Split {
  triangles,  // a triangle into four
  quads,      // a face of n corners into n quads that meet at a point of its own
  corners,    // a vertex for every corner of a face; faces come from faces, edges and vertices
  centroids,  // a triangle into three about its centroid, old edges flipped; borders every second step
};

// The numbers of vertices that a face of a control mesh may have, both ends included.
struct FaceSizes {
  Index least = 3, most = 3;
  friend constexpr bool operator==(const FaceSizes&, const FaceSizes&) = default;
};

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
// gives the same point, and tangent masks are left eigenvectors of the local subdivision matrix. What follows
// asks for all that any part of the program uses of a scheme: one that has it compiles everywhere.

// A small value: requests hold one of each scheme, with the options that they set.
template <class S>
concept HasOptions = std::semiregular<S> && requires {
  { S::name } -> std::convertible_to<std::string_view>;
  { S::options() } -> std::convertible_to<std::span<const SchemeOption<S>>>;
};

// Constants of the type: how its faces split, which faces it takes, and the valence of the vertices that come
// to lie inside a face or on an edge of two faces (on a border half of that and one more).
template <class S>
concept HasSplit = requires {
  typename std::integral_constant<Split, S::split>;
  typename std::integral_constant<Index, S::regular_valence>;
  requires std::same_as<decltype(S::face_sizes), const FaceSizes>;
  typename std::integral_constant<Index, S::face_sizes.least>;
};

template <class S>
concept HasMasks = requires(const S& scheme, EdgeRing e, VertexRing v) {
  { scheme.edge_mask(e) } -> std::same_as<EdgeMask>;
  { scheme.vertex_mask(v) } -> std::same_as<VertexMask>;
};

// Of Split::corners: the points of a face of n corners.
template <class S>
concept HasCornerMasks = requires(const S& scheme, Index n) {
  { scheme.corner_mask(n) } -> std::same_as<CornerMask>;
};

// Of Split::centroids: the vertex point of a smooth vertex of valence n, and its limit.
template <class S>
concept HasCentroidMasks = requires(const S& scheme, Index n) {
  { scheme.vertex_mask(n) } -> std::same_as<VertexMask>;
  { scheme.limit_mask(n) } -> std::same_as<VertexMask>;
};

// Of Split::triangles where vertices stay, and edge points see more than their own faces: by the ring of a smooth
// vertex of n edges (is_regular(n): it asks for no rule of its own, and the wing mask holds), by edge i of a sector of
// k faces between creases (likewise), and along creases by the four-point rule of that tension.
template <class S>
concept HasRingMasks = requires(const S& scheme, Index n, Index k, Index i) {
  { S::tension } -> std::convertible_to<double>;
  { scheme.wing_mask() } -> std::same_as<WingMask>;
  { scheme.is_regular(n) } -> std::same_as<bool>;
  { scheme.ring_mask(n) } -> std::same_as<WaveMask>;
  { scheme.is_regular_sector(k) } -> std::same_as<bool>;
  { scheme.sector_mask(k, i) } -> std::same_as<SectorMask>;
};

// Of Split::quads where vertices stay, and points follow the four-point rule of that tension along the lines of a net of
// quads: how a line goes on behind a smooth vertex of n edges, n other than 2 and 4, and its tangents.
template <class S>
concept HasLineMasks = requires(const S& scheme, Index n) {
  { S::tension } -> std::convertible_to<double>;
  { scheme.extension_mask(n) } -> std::same_as<ExtensionMask>;
  { scheme.tangent_mask(n) } -> std::same_as<TwoRingMask>;
};

// Smooth vertex of valence n; a crease along edges a and b; a dart whose crease runs along edge 0 of a ring
// in cyclic order. Where the split makes quads, of a ring of quads.
template <class S>
concept HasLimitMasks = requires(const S& scheme, Index n, Index a, Index b, Pace pace) {
  { scheme.smooth_limit_mask(n) } -> std::same_as<VertexMask>;
  { scheme.crease_limit_mask(a, b) } -> std::same_as<VertexMask>;
  { scheme.dart_limit_mask(n) } -> std::same_as<RingMask>;
  { scheme.dart_limit_mask(n, pace) } -> std::same_as<RingMask>;
};

// Of n edges: two tangents at a smooth vertex, u x v outwards on a ring that runs counter-clockwise, and
// what takes the place of u at a dart, where v is the same. Of m + 1 edges: across a sector of m faces
// between the crease edges 0 and m; along the crease it is e_0 - e_m. A sharp corner of up to flat_corner_faces
// has the plane of its two border edges as tangent plane, one of more faces in general none: the border edges shrink
// by 1/2 a level, and what lies between them must shrink faster.
template <class S>
concept HasTangentMasks = requires(const S& scheme, Index n, Index m, Pace pace) {
  typename std::integral_constant<Index, S::flat_corner_faces>;
  { scheme.smooth_tangent_u(n) } -> std::same_as<RingMask>;
  { scheme.smooth_tangent_u(n, pace) } -> std::same_as<RingMask>;
  { scheme.smooth_tangent_v(n) } -> std::same_as<RingMask>;
  { scheme.smooth_tangent_v(n, pace) } -> std::same_as<RingMask>;
  { scheme.dart_tangent_u(n) } -> std::same_as<RingMask>;
  { scheme.dart_tangent_u(n, pace) } -> std::same_as<RingMask>;
  { scheme.crease_tangent_across(m) } -> std::same_as<RingMask>;
  { scheme.crease_tangent_across(m, pace) } -> std::same_as<RingMask>;
};

template <class S>
concept AnswersForOpenSubdiv = requires(const S& scheme) {
  { scheme.beyond_opensubdiv() } -> std::convertible_to<std::string_view>;
};

// What any scheme of the list has, whichever engine runs it.
template <class S>
concept SubdivisionScheme = HasOptions<S> && HasSplit<S> && AnswersForOpenSubdiv<S>;

// What the engines on grids ask for: masks that see the ring of a vertex or edge and no more.
template <class S>
concept RunsOnGrids = SubdivisionScheme<S> && HasMasks<S> && HasLimitMasks<S> && HasTangentMasks<S>;

// What `plain` runs level by level where vertices stay.
template <class S>
concept Interpolates = SubdivisionScheme<S> &&
    ((HasRingMasks<S> && S::split == Split::triangles) || (HasLineMasks<S> && S::split == Split::quads));

// Says in a sentence what a scheme lacks; all.h asks it of every scheme of the list.
template <class S>
struct RequireScheme {
  static_assert(HasOptions<S>, "a scheme needs a default, copies, a name and options(): see HasOptions");
  static_assert(HasSplit<S>, "a scheme needs constants split, face_sizes and regular_valence: see HasSplit");
  static_assert(AnswersForOpenSubdiv<S>,
                "a scheme needs beyond_opensubdiv(): see beyond_opensubdiv() of all.h");
};

template <class S>
struct RequireGridScheme {
  static_assert(HasMasks<S>, "a scheme needs edge_mask and vertex_mask: see HasMasks");
  static_assert(
      HasLimitMasks<S>,
      "a scheme needs smooth_, crease_ and dart_limit_mask, the last with a pace too: see HasLimitMasks");
  static_assert(HasTangentMasks<S>,
                "a scheme needs flat_corner_faces, smooth_tangent_u and _v, dart_tangent_u and "
                "crease_tangent_across, with a "
                "pace and without: see HasTangentMasks");
};

template <class S>
struct RequireInterpolatingScheme {
  static_assert(Interpolates<S>,
                "an interpolating scheme splits triangles by HasRingMasks or quads by HasLineMasks");
};

}  // namespace subdivd

#pragma once
// The edges of a mesh: which half-edges (faces.h) run along the same one.

#include <array>
#include <span>
#include <vector>

#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/mesh/faces.h"

namespace subdivd {

enum class EdgeKind : unsigned char {
  manifold,      // two faces, of one winding: they run along the edge in opposite directions
  border,        // one face
  non_manifold,  // more, or two that run along the edge in the same direction
};

struct Edges {
  Buffer<Index> of_half_edges;
  Buffer<std::array<Index, 2>> vertices;  // ends, the lower-numbered first
  // The lowest half-edge that runs from the lower end, and the lowest from the higher; kNoIndex: none.
  Buffer<std::array<Index, 2>> sides;
  Buffer<EdgeKind> kinds;
  std::vector<Index> non_manifold;  // the edges of that kind, ascending

  Index count() const { return static_cast<Index>(vertices.size()); }
  // Half-edge h, the highest so far, leaves vertex `from` along edge e, whose sides were kNoIndex in the
  // beginning.
  void attach(Index h, Index from, Index e);
  // When all are attached.
  void set_kinds(const Pace& pace = {});
};

// Edges are numbered in the order in which the faces, corner by corner, first run along them. Row v of
// `corner_offsets` is as long as v has corners. Linear time. Instantiated for Triangles, Quads and Polygons.
template <class Faces>
Edges find_edges(Index vertex_count, const Faces& faces, std::span<const Index> corner_offsets,
                 const Pace& pace);

}  // namespace subdivd

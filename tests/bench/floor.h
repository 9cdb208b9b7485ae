#pragma once
// What no implementation goes below: a level is read where its indices say and the next is written, without any
// arithmetic between.

#include <array>
#include <vector>

#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/mesh/topology.h"

namespace subdivd::bench {

// Per base vertex, edge and face the points that its new points need are read once, 16 bytes each: of a vertex
// its ring, of an edge its own, its ends and the rows on both sides, of a face its grid. Where they stand is in
// lists that are made before; written are 12 bytes a point, in their order. Values are x y z in the closed-form
// numbering; every array has room for kSpare more floats behind its end.
class Floor {
 public:
  static constexpr std::size_t kSpare = 4;
  // `level` >= 1. What is sharp is read as if it were smooth.
  Floor(const Topology<Triangles>& topology, Index level);

  // From level 0 to `level`; `points` is written, and means nothing.
  void refine(const std::vector<float>& control, float* points);
  // Limits and normals at the points of `level`.
  void limit(const Buffer<float>& points, float* limits, float* normals);

 private:
  // Where the points that base vertices and edges have around them stand at a level.
  struct Around {
    std::vector<Index> vertices;              // beside every vertex, row after row
    std::vector<std::array<Index, 4>> edges;  // at level 0 opposite (2), else next to the ends on both sides
  };
  static Around around(const Topology<Triangles>& topology, Index level);
  template <class Put>
  void gather(Index level, const float* from, const std::array<Count, 3>& written, Put&& put) const;

  const Topology<Triangles>& topology_;
  Index level_;
  std::vector<std::array<Index, 2>> faces_;  // at every edge
  std::vector<Around> around_;               // per level
  std::array<Buffer<float>, 2> scratch_;     // levels below the last, by turns
};

}  // namespace subdivd::bench

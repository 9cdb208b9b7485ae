#pragma once
// The index buffer of a refined mesh, by formula alone.

#include <memory>
#include <span>
#include <vector>

#include "core/base/budget.h"
#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/mesh/connectivity.h"

namespace subdivd {

// Refined triangles of the faces whose `holes` flag is 0, in the order of split.h: 3 indices each, 3 * n^2
// per face, into `out`. `holes`: one flag per face of the connectivity. Independent of the number of threads.
Result<void> write_triangles(const Connectivity<Triangles>& connectivity, Index level,
                             std::span<const unsigned char> holes, Index* out, Index threads,
                             const Budget& budget);

// The same piece by piece, for whoever passes it on and keeps none of it.
class TriangleStream {
 public:
  TriangleStream() = default;  // of no faces
  TriangleStream(std::shared_ptr<const Connectivity<Triangles>> connectivity, Index level,
                 std::span<const unsigned char> holes);

  Count index_count() const { return index_count_; }  // of all triangles
  Count least_room() const;                           // that next() needs, in indices
  Count held_bytes() const;  // of what it keeps in memory, at most; the connectivity may be shared
  // Writes the triangles that follow, as many as there is room for; returns the number of their indices, 0
  // behind the last.
  Count next(std::span<Index> out);
  // All of them at once, wherever next() is.
  Result<Buffer<Index>> all(Index threads, const Budget& budget) const;

 private:
  std::shared_ptr<const Connectivity<Triangles>> connectivity_;
  Index level_ = 0;
  std::vector<unsigned char> holes_;
  Count index_count_ = 0;
  Index face_ = 0;
  Count row_ = 0;  // of the face, where rows are written one by one
};

}  // namespace subdivd

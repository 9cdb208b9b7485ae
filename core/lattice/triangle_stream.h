#pragma once
// The triangles of a refined mesh for renderers, piece by piece, for whoever passes them on and keeps none.

#include <memory>
#include <span>
#include <vector>

#include "core/base/budget.h"
#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/base/result.h"
#include "core/lattice/lattice.h"

namespace subdivd {

// Refined faces follow one another as in Lattice::write_faces. A quad (a, b, c, d) is cut into (a, b, c) (a, c, d),
// a polygon likewise from its first corner on.
class TriangleStream {
 public:
  TriangleStream() = default;  // of no faces
  // `holes`: one flag per face of the lattice, those with 0 are written.
  TriangleStream(std::shared_ptr<const Lattice> lattice, Index level, std::span<const unsigned char> holes,
                 const Pace& pace = {});

  // Asked for before the first next(): of two neighbours in the order of faces the second does not begin at the
  // vertex that the first begins at, so that faces can be told apart by the first corners of their triangles. A face
  // that would is cut from its second corner on. False, and nothing changes: all faces are triangles, or there is none.
  bool tell_faces_apart();

  Count index_count() const { return index_count_; }  // of all triangles
  Count least_room() const;                           // that next() needs, in indices
  Count held_bytes() const;  // of what it keeps in memory, at most; the lattice may be shared
  // Writes the triangles that follow, as many as there is room for; returns the number of their indices, 0
  // behind the last.
  Count next(std::span<Index> out);
  // All of them at once, wherever next() is.
  Result<Buffer<Index>> all(Index threads, const Budget& budget) const;

 private:
  template <class Writer>
  Count next_of_grids(const Writer& writer, std::span<Index> out);
  template <class Faces>
  Count next_of_faces(const Connectivity<Faces>& faces, std::span<Index> out);
  bool cuts_whole_faces() const;

  std::shared_ptr<const Lattice> lattice_;
  Index level_ = 0;
  std::vector<unsigned char>
      holes_;  // of the faces that the grids start from; of polygons where they are the faces
  Count index_count_ = 0, least_room_ = 0;
  Index face_ = 0;
  Count row_ =
      0;  // of the face, where rows are written one by one; of a face that is cut as a whole, the triangle
  bool told_apart_ = false;
  Index start_ = 0;              // the corner that the current face is cut from
  Index last_start_ = kNoIndex;  // the vertex that the face before it began at
};

}  // namespace subdivd

#pragma once
// Places on the faces of a control mesh, and refined faces there, by number: the one view that the comparison
// has of triangles, of quads and of faces of any sizes.

#include <span>

#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/lattice/provenance.h"
#include "core/lattice/split.h"

namespace subdivd::oracle {

// Corners of faces that follow one another: as many of each, or each its own number.
class FaceRows {
 public:
  FaceRows() = default;
  FaceRows(Index size, Count faces) : size_(size), faces_(faces) {}
  // `sizes`: of each face in turn.
  FaceRows(std::span<const Index> sizes, const Pace& pace);

  Count count() const { return faces_; }
  Count begin(Count face) const { return begins_.empty() ? size_ * face : begins_[face]; }
  Count end(Count face) const { return begin(face + 1); }
  Count size(Count face) const { return end(face) - begin(face); }
  Count corner_count() const { return begin(faces_); }

 private:
  Index size_ = 0;
  Count faces_ = 0;
  Buffer<Count> begins_;  // empty where all have one size
};

// What the faces of a control mesh are refined as: grids of triangles; grids of quads; or, where a scheme
// makes quads of faces some of which are none, the quads at the corners of each, which begin at level 1.
enum class GridShape { triangles, quads, corners };

// Places are written as in provenance.h. A face of four corners is one grid, also among others.
class Grids {
 public:
  static constexpr Count kNowhere = ~Count{0};

  // `base`: the faces of the control mesh, which outlive this.
  Grids(GridShape shape, Index level, const FaceRows& base, const Pace& pace);

  // Every place on every face has a number below place_count(): one for each face that holds it. kNowhere:
  // there is no such place.
  Count place_count() const { return place_count_; }
  Count place_number(const Provenance& place) const;

  // Refined faces of a base face, and the number among them of the one with these corners, of which any may
  // be the first: in the order that core/lattice gives them. `base_corner`: whose quad they lie on, in grids
  // of that shape. Points that are no such face's get any number.
  Count face_count(Count base_face) const;
  Count face_number(Count base_face, Index base_corner, std::span<const GridPoint> corners) const;

 private:
  bool is_whole(Count base_face) const { return shape_ != GridShape::corners || base_->size(base_face) == 4; }
  Count places_on(Count base_face) const;

  GridShape shape_;
  Index level_;
  Count n_;     // segments of an edge of a base face
  Count half_;  // and of one of a corner's quad; 0 at level 0, where that quad is its corner
  const FaceRows* base_;
  Buffer<Count> begins_;  // of the places of each face; empty where all have as many
  Count place_count_ = 0;
};

}  // namespace subdivd::oracle

#pragma once
// How the corners of a mesh's faces are numbered: all triangles, all quads, or polygons of any sizes.
// Adjacency (connectivity.h, topology.h) is compiled for each of them, so that one size costs no look-up.
//
// A half-edge h runs from a corner of a face to the next corner of that face, counter-clockwise; the same
// number names the corner that it leaves. Faces follow one another, those of face f are begin(f) to
// begin(f + 1) - 1.
//
//          v2          next(h): the following half-edge of the face
//         /  ^         prev(h): the one before
//     h+2/    \h+1
//       v  h   \       Around v0 counter-clockwise: the face lies between the edge of h and the edge of
//     v0 -----> v1     prev(h); the next face around v0 lies across the edge of prev(h).

#include <span>
#include <utility>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"

namespace subdivd {

// Faces of kSize corners each.
template <Index kSize>
class FacesOfSize {
 public:
  static constexpr Index size = kSize;

  FacesOfSize() = default;
  // `corners`: vertices, kSize per face, no face repeating one (assumed, as everywhere here).
  explicit FacesOfSize(std::vector<Index> corners) : corners_(std::move(corners)) {}

  std::span<const Index> corners() const { return corners_; }
  Index count() const { return static_cast<Index>(corners_.size() / kSize); }

  static Index begin(Index f) { return kSize * f; }
  static Index face_of(Index h) { return h / kSize; }
  // Branch-free: which corner of its face it is cannot be predicted.
  static Index next(Index h) { return h + 1 - kSize * static_cast<Index>(h % kSize == kSize - 1); }
  static Index prev(Index h) { return h - 1 + kSize * static_cast<Index>(h % kSize == 0); }

  // The same faces over other vertices.
  FacesOfSize with_corners(std::vector<Index> corners) const { return FacesOfSize(std::move(corners)); }

 private:
  std::vector<Index> corners_;
};

using Triangles = FacesOfSize<3>;
using Quads = FacesOfSize<4>;

// Faces of any size from 3 corners on.
class Polygons {
 public:
  Polygons() = default;
  // `begins`: where the corners of each face begin in `corners`, ascending from 0, and behind them the number
  // of all.
  Polygons(std::vector<Index> begins, std::vector<Index> corners, const Pace& pace = {});

  std::span<const Index> corners() const { return corners_; }
  Index count() const { return static_cast<Index>(begins_.size() - 1); }

  Index begin(Index f) const { return begins_[f]; }
  Index face_of(Index h) const { return faces_[h]; }
  Index next(Index h) const { return h + 1 == begins_[faces_[h] + 1] ? begins_[faces_[h]] : h + 1; }
  Index prev(Index h) const { return h == begins_[faces_[h]] ? begins_[faces_[h] + 1] - 1 : h - 1; }

  Polygons with_corners(std::vector<Index> corners) const {
    Polygons other = *this;
    other.corners_ = std::move(corners);
    return other;
  }

 private:
  std::vector<Index> begins_ = {0}, corners_;
  std::vector<Index> faces_;  // of every half-edge
};

}  // namespace subdivd

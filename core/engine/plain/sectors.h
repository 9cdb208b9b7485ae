#pragma once
// The faces around each vertex in fans, between the edges that the surface is not smooth across.

#include <span>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/engine/plain/adjacency.h"
#include "core/mesh/sharpness.h"

namespace subdivd::plain {

// An edge that two faces share in agreement and that is not infinitely sharp is crossed.
std::vector<unsigned char> crossed_edges(const Adjacency& faces, const Sharpness& sharpness,
                                         const Pace& pace = {});

// Sectors are numbered by their vertex, then by their lowest corner. Their corners follow one another
// counter-clockwise across crossed edges: corner k lies between edge k, which its half-edge runs along, and edge k + 1.
// A sector that closes on itself begins at its lowest corner.
class Sectors {
 public:
  Sectors() = default;
  // `crossed`: 1 for every edge that a sector goes on across. Linear time.
  Sectors(const Adjacency& faces, std::span<const unsigned char> crossed, const Pace& pace = {});

  Index count() const { return static_cast<Index>(closed_.size()); }
  std::span<const Index> corners(Index s) const {
    return std::span(corners_).subspan(begins_[s], begins_[s + 1] - begins_[s]);
  }
  Index size(Index s) const { return begins_[s + 1] - begins_[s]; }
  bool is_closed(Index s) const { return closed_[s] != 0; }
  Index of_corner(Index h) const { return of_corner_[h]; }
  // Its place in its sector.
  Index position(Index h) const { return place_[h] - begins_[of_corner_[h]]; }

 private:
  std::vector<Index> corners_, begins_ = {0};
  std::vector<unsigned char> closed_;
  std::vector<Index> of_corner_, place_;
};

}  // namespace subdivd::plain
